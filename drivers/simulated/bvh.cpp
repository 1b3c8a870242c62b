#include "drivers/simulated/bvh.h"

#include <algorithm>

namespace sphc::simulated {
namespace {

Vec3f low(const Vec3f &a, const Vec3f &b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3f high(const Vec3f &a, const Vec3f &b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
float axisOf(const Vec3f &v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// Half the extent of the shape's oriented box along each world axis.
Vec3f reach(const Shape &shape) {
  const Mat3f m = transposed(shape.local_from_world);
  const auto along = [&](const Vec3f &row) {
    return std::fabs(row.x) * shape.half.x + std::fabs(row.y) * shape.half.y + std::fabs(row.z) * shape.half.z;
  };
  return {along(m.row[0]), along(m.row[1]), along(m.row[2])};
}

bool crosses(const Vec3f &lo, const Vec3f &hi, const Vec3f &origin, const Vec3f &inverse, float t_max) {
  const Vec3f a{(lo.x - origin.x) * inverse.x, (lo.y - origin.y) * inverse.y, (lo.z - origin.z) * inverse.z};
  const Vec3f b{(hi.x - origin.x) * inverse.x, (hi.y - origin.y) * inverse.y, (hi.z - origin.z) * inverse.z};
  const Vec3f enter = low(a, b), leave = high(a, b);
  return std::max({enter.x, enter.y, enter.z, 0.0f}) <= std::min({leave.x, leave.y, leave.z, t_max});
}

}  // namespace

Bvh::Bvh(const std::vector<Shape> &shapes) : shapes_(shapes) {
  for (uint32_t i = 0; i < shapes.size(); ++i) {
    const Vec3f r = reach(shapes[i]);
    low_.push_back(shapes[i].center - r);
    high_.push_back(shapes[i].center + r);
    if (shapes[i].kind != Kind::kRoom) order_.push_back(i);
  }
  nodes_.push_back({});
  if (!order_.empty()) split(0, 0, static_cast<uint32_t>(order_.size()));
}

void Bvh::split(uint32_t node, uint32_t first, uint32_t count) {
  constexpr uint32_t kLeaf = 3;
  Vec3f lo{kFar, kFar, kFar}, hi{-kFar, -kFar, -kFar};
  for (uint32_t i = first; i < first + count; ++i) {
    lo = low(lo, low_[order_[i]]);
    hi = high(hi, high_[order_[i]]);
  }
  nodes_[node] = {lo, hi, first, count};
  if (count <= kLeaf) return;
  const Vec3f extent = hi - lo;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](uint32_t a, uint32_t b) {
    const float ca = axisOf(shapes_[a].center, axis), cb = axisOf(shapes_[b].center, axis);
    return ca != cb ? ca < cb : a < b;
  });
  const auto children = static_cast<uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children;
  nodes_[node].count = 0;
  split(children, first, count / 2);
  split(children + 1, first + count / 2, count - count / 2);
}

bool Bvh::blocked(const Vec3f &origin, const Vec3f &direction, float t_max) const {
  if (order_.empty()) return false;
  const auto invert = [](float d) { return 1.0f / (std::fabs(d) < 1e-9f ? 1e-9f : d); };
  const Vec3f inverse{invert(direction.x), invert(direction.y), invert(direction.z)};
  uint32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node &node = nodes_[stack[--depth]];
    if (!crosses(node.low, node.high, origin, inverse, t_max)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = node.first + 1;
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Shape &shape = shapes_[order_[i]];
      if (intersect(shape.kind, localRay(shape, origin, direction), 0, t_max) < kFar) return true;
    }
  }
  return false;
}

}  // namespace sphc::simulated
