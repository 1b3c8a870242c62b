#include "lab/align/depth_edges.h"

#include <algorithm>

#include "host/frames/image_edges.h"

namespace sphc::host {
namespace {

constexpr double kFarther = 1.1;

// The next depth along a line of pixels, within `gap_px` beyond the neighbour; 0: none.
uint16_t nextDepth(const std::vector<uint16_t> &depth, int64_t at, int64_t step, int64_t pixels) {
  for (int64_t i = 1; i <= pixels; ++i)
    if (depth[static_cast<size_t>(at + i * step)]) return depth[static_cast<size_t>(at + i * step)];
  return 0;
}

}  // namespace

std::vector<uint8_t> depthEdges(const std::vector<uint16_t> &depth, uint32_t width, uint32_t height,
                                uint32_t gap_px) {
  std::vector<uint8_t> edges(depth.size());
  const int64_t w = width, h = height, reach = int64_t{gap_px} + 1;
  for (int64_t y = 0; y < h; ++y) {
    for (int64_t x = 0; x < w; ++x) {
      const int64_t at = y * w + x;
      const double z = depth[static_cast<size_t>(at)];
      if (!(z > 0)) continue;
      const uint16_t beside[] = {
          nextDepth(depth, at, 1, std::min(reach, w - 1 - x)), nextDepth(depth, at, -1, std::min(reach, x)),
          nextDepth(depth, at, w, std::min(reach, h - 1 - y)), nextDepth(depth, at, -w, std::min(reach, y))};
      for (const uint16_t other : beside)
        if (other > kFarther * z) edges[static_cast<size_t>(at)] = 1;
    }
  }
  return edges;
}

void edgeDistances(const std::vector<uint8_t> &from, const std::vector<uint8_t> &to, uint32_t width,
                   uint32_t height, std::vector<double> *distances) {
  const std::vector<float> distance = distancesToEdges(to, width, height);
  for (size_t i = 0; i < from.size(); ++i)
    if (from[i]) distances->push_back(static_cast<double>(distance[i]));
}

}  // namespace sphc::host
