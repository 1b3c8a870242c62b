#include "host/live/depth_edge_points.h"

#include <algorithm>

namespace sphc::host {
namespace {

constexpr double kFarther = 1.1;
// From pixel to pixel, at least.  A floor rises by cot(angle below the horizon) / focal length: one 16 degrees
// below.
constexpr double kLeastRise = 0.04, kRiseOfFloor = 3.5;
constexpr uint32_t kHoleShare = 64;  // of the width, which a hole of an edge may have

// A row or a column, forwards or backwards.
struct DepthLine {
  const uint16_t *first;
  int64_t step, count, hole;
  double steep;  // far over near, from pixel to pixel

  uint16_t at(int64_t i) const { return first[i * step]; }
  // The next pixel with depth, beyond a hole at most; `count`: none.
  int64_t next(int64_t i) const {
    const int64_t end = std::min(i + hole + 2, count);
    while (++i < end)
      if (at(i) > 0) return i;
    return count;
  }
};

// Calls found(place, near) for each edge of the line; a pixel's centre is at half past its number.
template <typename Found>
void forEdges(const DepthLine &line, const Found &found) {
  for (int64_t i = 0; i < line.count; ++i) {
    if (line.at(i) == 0) continue;
    const int64_t begin = i;
    for (int64_t j = line.next(i); j < line.count && line.at(j) > line.steep * line.at(i); j = line.next(i)) i = j;
    const double near = line.at(begin), far = line.at(i);
    if (far <= kFarther * near) continue;
    int64_t before = begin, behind = line.next(begin);
    while (line.at(behind) < 0.5 * (near + far)) {
      before = behind;
      behind = line.next(before);
    }
    found(0.5 * static_cast<double>(before + behind + 1), line.at(begin));
  }
}

}  // namespace

std::vector<DepthEdgePoint> depthEdgePoints(const std::vector<uint16_t> &depth, uint32_t width, uint32_t height,
                                            double focal_px) {
  std::vector<DepthEdgePoint> edges;
  const double steep = 1 + std::max(kLeastRise, kRiseOfFloor / focal_px);
  const int64_t w = width, h = height, hole = width / kHoleShare;
  for (int64_t y = 0; y < h; ++y) {
    const uint16_t *row = &depth[static_cast<size_t>(y * w)];
    const double y_px = static_cast<double>(y) + 0.5;
    forEdges({row, 1, w, hole, steep}, [&](double at, uint16_t near) { edges.push_back({at, y_px, near}); });
    forEdges({row + w - 1, -1, w, hole, steep}, [&](double at, uint16_t near) {
      edges.push_back({width - at, y_px, near});
    });
  }
  for (int64_t x = 0; x < w; ++x) {
    const uint16_t *column = &depth[static_cast<size_t>(x)];
    const double x_px = static_cast<double>(x) + 0.5;
    forEdges({column, w, h, hole, steep}, [&](double at, uint16_t near) { edges.push_back({x_px, at, near}); });
    forEdges({column + (h - 1) * w, -w, h, hole, steep}, [&](double at, uint16_t near) {
      edges.push_back({x_px, height - at, near});
    });
  }
  return edges;
}

}  // namespace sphc::host
