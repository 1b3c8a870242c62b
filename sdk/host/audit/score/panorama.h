// What is seen from one point in all directions, painted with measured points: six faces of a cube, nearest first.
#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "runtime/geometry/rotation.h"

namespace sphc::host {

struct TruthView {
  cv::Mat grey;  // VirtualCamera's side, CV_32F, 0 to 255
  cv::Mat seen;  // CV_8U: 255 where the truth is known
  double seenShare() const {
    return static_cast<double>(cv::countNonZero(seen)) / static_cast<double>(seen.total());
  }
};

class Panorama {
 public:
  Panorama() : cells_(6 * kSide * kSide) {}
  // A patch around `offset_m` from the centre, `radius_m` across the line of sight.
  void add(const Vector3 &offset_m, double radius_m, float grey);
  TruthView view(const Matrix3 &camera_from_map) const;

 private:
  static constexpr int kSide = 512;
  struct Cell {
    float range_m = 0, sum = 0, weight = 0;
  };
  // 0 to 5, and the place on it in cells.
  static int faceOf(const Vector3 &direction, Vector2 *place);
  static size_t indexOf(int face, int x, int y) { return (static_cast<size_t>(face) * kSide + y) * kSide + x; }

  std::vector<Cell> cells_;
};

}  // namespace sphc::host
