// What is seen from one point in all directions, painted with measured points: six faces of a cube, nearest first.
#pragma once
#include <vector>

#include "host/audit/score/truth_view.h"

namespace sphc::host {

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
