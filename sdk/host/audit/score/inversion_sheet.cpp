#include "host/audit/score/inversion_sheet.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace sphc::host {
namespace {

constexpr size_t kPictured = 6;  // views
constexpr int kLabel = 190, kBorder = 2;

// Brought to one brightness and contrast, since networks paint in no unit.
cv::Mat shown(const cv::Mat &grey, const cv::Mat &mask) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(grey, mean, deviation, mask);
  const double gain = 55 / std::max(deviation[0], 1e-6);
  cv::Mat bytes, framed;
  grey.convertTo(bytes, CV_8U, gain, 120 - gain * mean[0]);
  if (!mask.empty()) bytes.setTo(90, mask == 0);
  cv::copyMakeBorder(bytes, framed, kBorder, kBorder, kBorder, kBorder, cv::BORDER_CONSTANT, cv::Scalar(255));
  return framed;
}

// A label and some pictures.
cv::Mat strip(const std::string &name, const std::vector<cv::Mat> &pictures) {
  cv::Mat row(pictures.front().rows, kLabel, CV_8U, cv::Scalar(255));
  cv::putText(row, name, {6, row.rows / 2}, cv::FONT_HERSHEY_SIMPLEX, 0.42, cv::Scalar(0), 1, cv::LINE_AA);
  for (const cv::Mat &picture : pictures) cv::hconcat(row, picture, row);
  return row;
}

}  // namespace

cv::Mat inversionSheet(const std::vector<InversionView> &views, const std::vector<InversionResult> &results) {
  std::vector<size_t> chosen;
  for (size_t k = 0; k < std::min(kPictured, views.size()); ++k)
    chosen.push_back(k * views.size() / std::min(kPictured, views.size()));
  if (chosen.empty()) return {};
  std::vector<cv::Mat> truth;
  for (size_t i : chosen) truth.push_back(shown(views[i].truth.grey, views[i].truth.seen));
  cv::Mat sheet = strip("truth", truth);
  for (const InversionResult &result : results) {
    std::vector<cv::Mat> pictures;
    for (size_t i : chosen) pictures.push_back(shown(result.pictures[i], {}));
    cv::vconcat(sheet, strip(result.name, pictures), sheet);
  }
  return sheet;
}

}  // namespace sphc::host
