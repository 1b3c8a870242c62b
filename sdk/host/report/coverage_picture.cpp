#include "host/report/coverage_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "host/report/direction_picture.h"
#include "host/report/directions.h"

namespace sphc::host {
namespace {

const cv::Scalar kRing(230, 200, 80), kCross(90, 90, 255);

// As in drawDirections.
cv::Point placeOf(const cv::Mat &picture, double yaw_rad, double pitch_rad) {
  const double x = (0.5 - yaw_rad / (2 * M_PI)) * picture.cols, y = (0.5 - pitch_rad / M_PI) * picture.rows;
  return {std::clamp(cvRound(x), 0, picture.cols - 1), std::clamp(cvRound(y), 0, picture.rows - 1)};
}

// The circle on the sphere, point by point: at the poles and the seam it is none on paper.
void drawRing(const Hole &hole, cv::Mat *picture) {
  const double yaw = hole.yaw_deg * kDegree, pitch = hole.pitch_deg * kDegree, radius = hole.radius_deg * kDegree;
  for (int i = 0; i < 720; ++i) {
    const double turn = i * M_PI / 360;
    const double sine = std::sin(pitch) * std::cos(radius) + std::cos(pitch) * std::sin(radius) * std::cos(turn);
    const double there = std::asin(std::clamp(sine, -1.0, 1.0));
    const double aside = std::atan2(std::sin(turn) * std::sin(radius) * std::cos(pitch),
                                    std::cos(radius) - std::sin(pitch) * std::sin(there));
    cv::circle(*picture, placeOf(*picture, std::remainder(yaw + aside, 2 * M_PI), there), 1, kRing, cv::FILLED);
  }
  const std::string words = std::to_string(cvRound(hole.yaw_deg)) + ", " + std::to_string(cvRound(hole.pitch_deg));
  const cv::Point middle = placeOf(*picture, yaw, pitch);
  cv::putText(*picture, words,
              {std::clamp(middle.x - 30, 4, picture->cols - 80), std::clamp(middle.y, 14, picture->rows - 8)},
              cv::FONT_HERSHEY_SIMPLEX, 0.45, kRing, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat drawCoverage(const std::vector<std::array<double, 3>> &directions, const std::vector<Hole> &holes,
                     const std::vector<std::array<double, 3>> &failed_views) {
  double peak = 0;
  cv::Mat picture = drawDirections(directions, &peak);
  for (const Hole &hole : holes) drawRing(hole, &picture);
  for (const auto &view : failed_views)
    cv::drawMarker(picture,
                   placeOf(picture, std::atan2(view[1], view[0]), std::asin(std::clamp(view[2], -1.0, 1.0))),
                   kCross, cv::MARKER_TILTED_CROSS, 12, 2, cv::LINE_AA);
  return picture;
}

}  // namespace sphc::host
