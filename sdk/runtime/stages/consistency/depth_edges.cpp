#include "runtime/stages/consistency/depth_edges.h"

#include <algorithm>

namespace sphc {
namespace {

constexpr int32_t kLinesOfACell = 3;
constexpr int32_t kFinePx = 400;           // a wider image is walked in steps of two pixels
constexpr int32_t kGapShare = 64;          // of the image's width: holes up to this wide lie beside edges
constexpr uint32_t kNear = 10, kFar = 11;  // the far side is at least 11 / 10 as far as the near one

}  // namespace

// A line of the image, as an index into it.
struct DepthEdges::Walk {
  ImageView<uint16_t> depth;
  int32_t line = 0, length = 0, step = 1, gap = 0;
  uint16_t low = 0, high = 0;  // measurements in range
  bool along_y = false;

  uint16_t at(int32_t i) const { return along_y ? depth.row(i)[line] : depth.row(line)[i]; }
  bool inRange(uint16_t value) const { return value >= low && value <= high; }
  // `toward_far`: 1 or -1 along the line.
  DepthEdge edge(int32_t i, int32_t toward_far, uint16_t near) const {
    const int32_t x = along_y ? line : i, y = along_y ? i : line;
    const int32_t cell = y * kRows / depth.height * kColumns + x * kColumns / depth.width;
    const float beyond = 0.5f * static_cast<float>(toward_far * step);
    return {static_cast<float>(x) + 0.5f + (along_y ? 0 : beyond),
            static_cast<float>(y) + 0.5f + (along_y ? beyond : 0), near, static_cast<uint16_t>(cell), along_y};
  }
};

void DepthEdges::layout(Arena &scratch, DepthEdges *edges) {
  DepthEdges discarded;
  DepthEdges &e = edges ? *edges : discarded;
  e.edges_ = scratch.take<DepthEdge>("consistency.edges", kCapacity);
  e.taken_ = scratch.take<uint8_t>("consistency.edges", size_t{kColumns} * kRows);
}

void DepthEdges::find(ImageView<uint16_t> depth, const DepthSensor &sensor) {
  count_ = 0;
  std::fill(taken_.begin(), taken_.end(), uint8_t{0});
  Walk walk;
  walk.depth = depth;
  walk.step = depth.width > kFinePx ? 2 : 1;
  walk.gap = depth.width / kGapShare + walk.step;
  walk.low = static_cast<uint16_t>(std::min(65535.0, std::max(1.0, sensor.min_m / sensor.unit_m)));
  walk.high = static_cast<uint16_t>(std::min(65535.0, sensor.max_m / sensor.unit_m));
  for (const bool along_y : {false, true}) {
    walk.along_y = along_y;
    walk.length = along_y ? depth.height : depth.width;
    const int32_t lines = along_y ? depth.width : depth.height, cells = along_y ? kColumns : kRows;
    const int32_t every = std::max(int32_t{1}, lines / (cells * kLinesOfACell));
    for (walk.line = every / 2; walk.line < lines; walk.line += every) this->walk(walk);
  }
}

void DepthEdges::walk(const Walk &walk) {
  uint32_t last = 0;
  int32_t last_at = -walk.gap - 1;
  for (int32_t i = 0; i < walk.length; i += walk.step) {
    const uint16_t value = walk.at(i);
    if (!walk.inRange(value)) continue;
    if (i - last_at <= walk.gap) {
      if (kNear * value > kFar * last) keep(walk.edge(last_at, 1, static_cast<uint16_t>(last)));
      if (kNear * last > kFar * value) keep(walk.edge(i, -1, value));
    }
    last = value;
    last_at = i;
  }
}

void DepthEdges::keep(const DepthEdge &edge) {
  const auto bit = static_cast<uint8_t>(edge.along_y ? 2 : 1);
  uint8_t &taken = taken_[edge.cell];
  if (taken & bit) return;
  taken = static_cast<uint8_t>(taken | bit);
  edges_[count_++] = edge;
}

}  // namespace sphc
