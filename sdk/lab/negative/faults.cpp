#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "lab/common/normal.h"
#include "lab/negative/fault.h"

namespace sphc::host {
namespace {

// Of each measurement by itself.
void addNoiseOfDepth(Sequence *sequence) {
  constexpr double kShare = 0.025;
  Random random(1);
  for (Shot &shot : sequence->shots)
    for (uint16_t &value : shot.depth)
      if (value) value = static_cast<uint16_t>(std::clamp(value * (1 + kShare * normalOf(&random)), 1.0, 65535.0));
}

// As a filter does: the mean of what is measured around.
void smooth(bool fills_holes, Sequence *sequence) {
  const auto width = static_cast<int>(sequence->depthWidth()), height = static_cast<int>(sequence->depthHeight());
  const int across = 2 * std::max(1, (width + 50) / 100) + 1;
  const auto sumAround = [across](const cv::Mat &image) {
    cv::Mat sum;
    cv::boxFilter(image, sum, CV_64F, {across, across}, {-1, -1}, false, cv::BORDER_CONSTANT);
    return sum;
  };
  for (Shot &shot : sequence->shots) {
    const cv::Mat depth(height, width, CV_16UC1, shot.depth.data()), is_measured = (depth != 0) / 255;
    const cv::Mat sum = sumAround(depth), count = sumAround(is_measured);
    for (size_t i = 0; i < shot.depth.size(); ++i)
      if (shot.depth[i] || fills_holes)
        shot.depth[i] = static_cast<uint16_t>(sum.ptr<double>()[i] / std::max(1.0, count.ptr<double>()[i]));
  }
}

void smoothDepth(Sequence *sequence) { smooth(false, sequence); }
void smoothAndFillDepth(Sequence *sequence) { smooth(true, sequence); }

// In the values of the image: what was bright is white.
void doubleTheLight(Sequence *sequence) {
  for (Shot &shot : sequence->shots)
    for (uint8_t &value : shot.color) value = static_cast<uint8_t>(std::min(22 * value / 10 + 20, 255));
}

// Poses may be lost in these, but no fault is to be named.
std::vector<SensorFault> soundFrames() {
  return {{"healthy", [](Sequence *) {}, 0, false, false},
          {"healthy, odometry", [](Sequence *) {}, 0, true, false},
          {"healthy, depth noise 2.5 %", addNoiseOfDepth, 0, false, false},
          {"healthy, depth smoothed", smoothDepth, 0, false, false},
          {"healthy, depth smoothed, holes filled", smoothAndFillDepth, 0, false, false},
          {"healthy, twice the light", doubleTheLight, 0, false, false}};
}

}  // namespace

std::vector<SensorFault> allFaults() {
  std::vector<SensorFault> all = soundFrames();
  for (const auto &kind : {depthFaults(), colorFaults(), calibrationFaults(), odometryFaults(), priorFaults()})
    all.insert(all.end(), kind.begin(), kind.end());
  return all;
}

}  // namespace sphc::host
