// bvh.h - a tree of bounding boxes over the shapes, for rays that come from anywhere (light and clearance).
#pragma once

#include <vector>

#include "drivers/simulated/shape.h"

namespace sphc::simulated {

class Bvh {
 public:
  // Borrows `shapes` for its lifetime; the one of kRoom is left out: nothing inside is hidden by it.
  explicit Bvh(const std::vector<Shape> &shapes);
  // Whether anything lies on the ray origin + t direction, t in (0, t_max).
  bool blocked(const Vec3f &origin, const Vec3f &direction, float t_max) const;

 private:
  struct Node {
    Vec3f low, high;
    uint32_t first, count;  // leaf: shapes order_[first ...]; count 0: children at first and first + 1
  };
  void split(uint32_t node, uint32_t first, uint32_t count);

  const std::vector<Shape> &shapes_;
  std::vector<Vec3f> low_, high_;  // of each shape
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace sphc::simulated
