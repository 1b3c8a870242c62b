#include "host/report/direction_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace sphc::host {
namespace {

constexpr int kWidth = 1024, kHeight = 512;
constexpr double kSmoothingRad = 0.02;  // about a degree: finer than the structure, coarser than single points

double latitudeOfRow(int row) { return M_PI / 2 - (row + 0.5) * M_PI / kHeight; }

cv::Mat countDirections(const std::vector<std::array<double, 3>> &directions) {
  cv::Mat counts = cv::Mat::zeros(kHeight, kWidth, CV_32F);
  for (const auto &d : directions) {
    // Minus: seen from the centre, y (left of x) must come out on the left.
    const double x = (0.5 - std::atan2(d[1], d[0]) / (2 * M_PI)) * kWidth;
    const double y = (0.5 - std::asin(std::clamp(d[2], -1.0, 1.0)) / M_PI) * kHeight;
    const int column = std::clamp(static_cast<int>(x), 0, kWidth - 1),
              row = std::clamp(static_cast<int>(y), 0, kHeight - 1);
    counts.at<float>(row, column) += 1;
  }
  return counts;
}

// Rows near the poles cover less sky a pixel: blur them wider, around the seam, and divide by the area.
cv::Mat density(const cv::Mat &counts, double total) {
  cv::Mat tall, result(kHeight, kWidth, CV_32F);
  const double sigma = kSmoothingRad * kHeight / M_PI;
  cv::GaussianBlur(counts, tall, {1, 0}, 0.01, sigma, cv::BORDER_REFLECT);
  for (int row = 0; row < kHeight; ++row) {
    const double shrink = std::max(0.02, std::cos(latitudeOfRow(row)));
    cv::Mat wrapped, blurred;
    cv::hconcat(std::vector<cv::Mat>{tall.row(row), tall.row(row), tall.row(row)}, wrapped);
    const int reach = std::min(2 * static_cast<int>(3 * sigma / shrink) + 1, kWidth - 1) | 1;
    cv::GaussianBlur(wrapped, blurred, {reach, 1}, sigma / shrink, 0, cv::BORDER_REFLECT);
    const double even = total / (kWidth * static_cast<double>(kHeight)) * M_PI / 2 * shrink;
    blurred.colRange(kWidth, 2 * kWidth).convertTo(result.row(row), CV_32F, 1 / std::max(even, 1e-12));
  }
  return result;
}

void drawGrid(Longitudes longitudes, cv::Mat *picture) {
  const cv::Scalar line(120, 110, 105), word(215, 210, 205);
  for (int degrees = -120; degrees <= 120; degrees += 60) {
    const int x = kWidth / 2 - degrees * kWidth / 360;
    cv::line(*picture, {x, 0}, {x, kHeight}, line, 1, cv::LINE_AA);
    if (longitudes == Longitudes::kBare) continue;
    cv::putText(*picture, std::to_string(degrees), {x + 5, kHeight - 8}, cv::FONT_HERSHEY_SIMPLEX, 0.45, word, 1,
                cv::LINE_AA);
  }
  for (int degrees = -60; degrees <= 60; degrees += 30) {
    const int y = kHeight / 2 - degrees * kHeight / 180;
    cv::line(*picture, {0, y}, {kWidth, y}, line, 1, cv::LINE_AA);
    cv::putText(*picture, std::to_string(degrees), {6, y - 5}, cv::FONT_HERSHEY_SIMPLEX, 0.45, word, 1,
                cv::LINE_AA);
  }
}

}  // namespace

cv::Mat drawDirections(const std::vector<std::array<double, 3>> &directions, double *peak, Longitudes longitudes) {
  const cv::Mat relative = density(countDirections(directions), static_cast<double>(directions.size()));
  cv::minMaxLoc(relative, nullptr, peak);
  cv::Mat tone, picture;
  // Square root: sparse regions stay visible beside a dense one.
  cv::sqrt(relative / std::max(*peak, 1e-12), tone);
  tone.convertTo(tone, CV_8U, 255);
  cv::applyColorMap(tone, picture, cv::COLORMAP_INFERNO);
  cv::Mat grid = picture.clone();
  drawGrid(longitudes, &grid);
  cv::addWeighted(grid, 0.7, picture, 0.3, 0, picture);
  return picture;
}

}  // namespace sphc::host
