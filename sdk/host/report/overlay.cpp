#include "host/report/overlay.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <regex>
#include <stdexcept>

#include "host/report/statistics.h"

namespace sphc::host {
namespace {

constexpr int kEnlarge = 2, kLegendHeight = 56;
constexpr double kUsualWidth = 1280;
constexpr double kLeastShrink = 0.75;  // of letters, before a second row
const cv::Scalar kGrey(190, 190, 190), kOrange(40, 150, 255), kGreen(90, 220, 60), kDark(38, 30, 27),
    kWhite(245, 245, 245);

bool isJudged(const Run &run) {
  return std::any_of(run.frames.begin(), run.frames.end(),
                     [](const FrameRecord &frame) { return frame.localized && frame.has_truth; });
}

// Places in run.frames of the localized frames, best first.
std::vector<size_t> ranked(const Run &run) {
  const bool truth = isJudged(run);
  std::vector<size_t> order;
  for (size_t i = 0; i < run.frames.size(); ++i) {
    if (run.frames[i].localized && (!truth || run.frames[i].has_truth)) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&run, truth](size_t a, size_t b) {
    const FrameRecord &fa = run.frames[a], &fb = run.frames[b];
    return truth ? fa.translation_error_m < fb.translation_error_m : fa.inliers > fb.inliers;
  });
  return order;
}

cv::Mat muted(const cv::Mat &color) {
  cv::Mat large, gray, mixed;
  cv::resize(color, large, cv::Size(), kEnlarge, kEnlarge, cv::INTER_LINEAR);
  cv::cvtColor(large, gray, cv::COLOR_BGR2GRAY);
  cv::cvtColor(gray, gray, cv::COLOR_GRAY2BGR);
  cv::addWeighted(large, 0.6, gray, 0.3, 6, mixed);
  return mixed;
}

void drawMark(cv::Mat *picture, const sphc_localizer_observation &seen, const cv::Scalar &color, int thickness) {
  constexpr int kShift = 4;  // OpenCV draws with 4 fractional bits
  const auto at = [](float px) { return cvRound((px - 0.5f) * kEnlarge * (1 << kShift)); };
  const float radius = std::clamp(1.8f * seen.scale_px, 2.5f, 9.0f) * kEnlarge;
  cv::circle(*picture, {at(seen.x_px), at(seen.y_px)}, cvRound(radius * (1 << kShift)), color, thickness,
             cv::LINE_AA, kShift);
}

// Three layers, the telling one on top.
void drawMarks(cv::Mat *picture, const std::vector<sphc_localizer_observation> &observations) {
  for (sphc_localizer_observation seen : observations) {
    if (seen.flags & SPHC_OBSERVATION_MATCHED) continue;
    seen.scale_px = 1;  // small: there are many of them, and they tell the least
    drawMark(picture, seen, kGrey, 1);
  }
  for (const auto &seen : observations) {
    const bool outlier = (seen.flags & SPHC_OBSERVATION_MATCHED) && !(seen.flags & SPHC_OBSERVATION_INLIER);
    if (outlier) drawMark(picture, seen, kOrange, 2);
  }
  for (const auto &seen : observations) {
    if (seen.flags & SPHC_OBSERVATION_INLIER) drawMark(picture, seen, kGreen, 2);
  }
}

std::string verdict(const FrameRecord &frame) {
  if (!frame.localized) return outcomeName(frame.outcome);
  if (!frame.has_truth) return "localized";
  return fixed(100 * frame.translation_error_m, 2) + " cm, " + fixed(frame.rotation_error_deg, 2) + " deg off";
}

// Letters of a size; all lengths of the legend go with it.
struct Letters {
  double size;  // 1: of a picture of usual width

  int px(int usual) const { return cvRound(size * usual); }
  int width(const std::string &text) const {
    return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kFont * size, 1, nullptr).width;
  }
  int entryWidth(const std::string &text) const { return px(18) + width(text) + px(28); }
  void write(const std::string &text, int x, int y, cv::Mat *picture) const {
    cv::putText(*picture, text, {x, y + px(7)}, cv::FONT_HERSHEY_SIMPLEX, kFont * size, kWhite, std::max(1, px(1)),
                cv::LINE_AA);
  }

 private:
  static constexpr double kFont = 0.62;
};

struct Entry {
  cv::Scalar ring;
  std::string text;
};

int legendHeight(int width) { return cvRound(kLegendHeight * std::max(1.0, width / kUsualWidth)); }

// Rings and their words on the left, the verdict on the right; in a narrow picture it has a row of its own.
void drawLegend(cv::Mat *picture, const FrameRecord &frame) {
  const std::array<Entry, 3> entries = {
      {{kGrey, std::to_string(frame.keypoints) + " keypoints"},
       {kOrange, std::to_string(frame.matches - std::min(frame.inliers, frame.matches)) + " matched, do not agree"},
       {kGreen, std::to_string(frame.inliers) + " agree with the pose"}}};
  const std::string last = "frame " + std::to_string(frame.sequence) + ": " + verdict(frame);
  const Letters full = {std::max(1.0, picture->cols / kUsualWidth)};
  int left = 2 * full.px(24);
  for (const Entry &entry : entries) left += full.entryWidth(entry.text);
  const double together = static_cast<double>(picture->cols) / (left + full.width(last));
  const bool is_narrow = together < kLeastShrink;
  const double widest = std::max(left, 2 * full.px(24) + full.width(last));
  const Letters letters = {full.size *
                           std::min(is_narrow ? kLeastShrink : 1.0, is_narrow ? picture->cols / widest : together)};
  const int height = legendHeight(picture->cols);
  const int y = picture->rows - (is_narrow ? 3 * height / 4 : height / 2);
  int x = letters.px(24);
  for (const Entry &entry : entries) {
    cv::circle(*picture, {x, y}, letters.px(9), entry.ring, 2, cv::LINE_AA);
    letters.write(entry.text, x + letters.px(18), y, picture);
    x += letters.entryWidth(entry.text);
  }
  letters.write(last, picture->cols - letters.width(last) - letters.px(24), is_narrow ? y + height / 2 : y,
                picture);
}

}  // namespace

std::vector<Highlight> chooseHighlights(const Run &run) {
  std::vector<Highlight> chosen;
  const std::vector<size_t> order = ranked(run);
  const bool truth = isJudged(run);
  const auto title = [truth](const char *judged, const char *other) { return truth ? judged : other; };
  if (!order.empty()) chosen.push_back({"best", title("Best pose", "Most matches agree"), order.front()});
  if (order.size() > 2)
    chosen.push_back(
        {"median", title("Median pose", "As many matches agree as in the median"), order[order.size() / 2]});
  if (order.size() > 1)
    chosen.push_back({"worst", title("Worst accepted pose", "Fewest matches agree"), order.back()});
  // Wrong ones that are not among these.
  constexpr size_t kMostWrong = 3;
  const auto is_shown = [&chosen](size_t i) {
    return std::any_of(chosen.begin(), chosen.end(), [i](const Highlight &shown) { return shown.frame == i; });
  };
  for (size_t i : worstFrames(run, kMostWrong))
    if (isWrong(run.frames[i]) && !is_shown(i))
      chosen.push_back({"wrong_" + std::to_string(run.frames[i].sequence), "Wrong pose", i});
  std::vector<size_t> lost;
  for (size_t i = 0; i < run.frames.size(); ++i) {
    if (!run.frames[i].localized) lost.push_back(i);
  }
  // One early and one late: neighbours look alike.
  for (size_t i = 0; i < std::min<size_t>(2, lost.size()); ++i) {
    chosen.push_back(
        {"not_localized_" + std::to_string(i + 1), "Not localized", i == 0 ? lost.front() : lost.back()});
  }
  return chosen;
}

bool isOverlayFile(const std::string &file) {
  static const std::regex names("overlay_(best|median|worst|wrong_[0-9]+|not_localized_[12])\\.jpg");
  return std::regex_match(file, names);
}

cv::Mat drawOverlay(const cv::Mat &color, const FrameRecord &frame) {
  cv::Mat picture;
  const cv::Mat seen = muted(color);
  cv::copyMakeBorder(seen, picture, 0, legendHeight(seen.cols), 0, 0, cv::BORDER_CONSTANT, kDark);
  cv::Mat image = picture.rowRange(0, seen.rows);
  drawMarks(&image, frame.observations);
  drawLegend(&picture, frame);
  return picture;
}

cv::Mat bgrFromImage(const sphc_image &image) {
  const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  // OpenCV has no view of constant memory; it is only read here.
  void *data = const_cast<void *>(image.data);
  cv::Mat bgr;
  switch (image.format) {
    case SPHC_FORMAT_BGR8:
      return cv::Mat(height, width, CV_8UC3, data, image.stride_bytes).clone();
    case SPHC_FORMAT_RGB8:
      cv::cvtColor(cv::Mat(height, width, CV_8UC3, data, image.stride_bytes), bgr, cv::COLOR_RGB2BGR);
      return bgr;
    case SPHC_FORMAT_GRAY8:
      cv::cvtColor(cv::Mat(height, width, CV_8UC1, data, image.stride_bytes), bgr, cv::COLOR_GRAY2BGR);
      return bgr;
    default:
      throw std::runtime_error("a depth image cannot be shown as colour");
  }
}

}  // namespace sphc::host
