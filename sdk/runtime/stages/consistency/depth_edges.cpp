#include "runtime/stages/consistency/depth_edges.h"

#include <algorithm>

namespace sphc {
namespace {

constexpr int32_t kLinesOfACell = 3;
constexpr int32_t kFinePx = 400;           // a wider image is walked in steps of two pixels
constexpr int32_t kGapShare = 64;          // of the image's width: holes up to this wide lie beside edges
constexpr size_t kMostAlone = 48;          // of one measurement, in any sound image
constexpr uint32_t kNear = 10, kFar = 11;  // the far side is at least 11 / 10 as far as the near one
// A sensor or filter that smooths makes a ramp of an edge: measurements side by side that go on in its sense, each
// by an eighth of the first step and more.
constexpr uint32_t kRampSteps = 8;
constexpr int32_t kRampShare = 16;  // of the image's width: the most to either side

bool isBeyond(uint32_t far, uint32_t near) { return kNear * far > kFar * near; }

}  // namespace

struct DepthEdges::Measurement {
  uint32_t depth;
  int32_t at;
};

// A line of the image, as an index into it.
struct DepthEdges::Walk {
  ImageView<uint16_t> depth;
  int32_t line = 0, length = 0, step = 1, gap = 0;
  bool needs_two = false;      // of each side, as a noisy sensor does
  uint16_t low = 0, high = 0;  // measurements in range
  bool along_y = false;

  uint16_t at(int32_t i) const { return along_y ? depth.row(i)[line] : depth.row(line)[i]; }
  bool inRange(uint16_t value) const { return value >= low && value <= high; }
  // At the last place before the middle of a ramp between its ends, which may be next to each other.
  DepthEdge edge(const Measurement &near, const Measurement &far) const;
  // Where the ramp of an edge ends that leads from `begin` on, in steps of `least` and more: `toward` 1 or -1 along
  // the line, to far or near.
  Measurement rampEnd(const Measurement &begin, int32_t toward, bool to_far, uint32_t least) const;
  // The neighbour of i further on; 0: it has none.
  uint32_t after(int32_t i) const {
    for (int32_t j = i + step; j < length && j - i <= gap; j += step)
      if (inRange(at(j))) return at(j);
    return 0;
  }
};

DepthEdge DepthEdges::Walk::edge(const Measurement &near, const Measurement &far) const {
  const int32_t toward_far = far.at > near.at ? 1 : -1;
  int32_t last = near.at;
  for (int32_t i = near.at; i != far.at; i += toward_far * step)
    if (inRange(at(i)) && 2u * at(i) <= near.depth + far.depth) last = i;
  const int32_t x = along_y ? line : last, y = along_y ? last : line;
  const int32_t cell = y * kRows / depth.height * kColumns + x * kColumns / depth.width;
  const float beyond = 0.5f * static_cast<float>(toward_far * step);
  return {static_cast<float>(x) + 0.5f + (along_y ? 0 : beyond),
          static_cast<float>(y) + 0.5f + (along_y ? beyond : 0), static_cast<uint16_t>(near.depth),
          static_cast<uint16_t>(cell), along_y};
}

DepthEdges::Measurement DepthEdges::Walk::rampEnd(const Measurement &begin, int32_t toward, bool to_far,
                                                  uint32_t least) const {
  const int32_t on = toward * step, most = depth.width / kRampShare / step;
  Measurement end = begin;
  for (int32_t i = begin.at + on, k = 0; k < most && i >= 0 && i < length; i += on, ++k) {
    const uint32_t here = at(i), near = to_far ? end.depth : here, far = to_far ? here : end.depth;
    if (!inRange(at(i)) || far < near + least) break;
    end = {here, i};
  }
  return end;
}

void DepthEdges::layout(Arena &scratch, DepthEdges *edges) {
  DepthEdges discarded;
  DepthEdges &e = edges ? *edges : discarded;
  e.edges_ = scratch.take<DepthEdge>("consistency.edges", kCapacity);
  e.taken_ = scratch.take<uint8_t>("consistency.edges", size_t{kColumns} * kRows);
}

// A sound sensor has few edges of one measurement alone: thin things, and what lies beside holes.  Where most are
// such, they are noise.
void DepthEdges::find(ImageView<uint16_t> depth, const DepthSensor &sensor) {
  Walk walk;
  walk.depth = depth;
  walk.step = depth.width > kFinePx ? 2 : 1;
  walk.gap = depth.width / kGapShare + walk.step;
  walk.low = static_cast<uint16_t>(std::min(65535.0, std::max(1.0, sensor.min_m / sensor.unit_m)));
  walk.high = static_cast<uint16_t>(std::min(65535.0, sensor.max_m / sensor.unit_m));
  findBy(walk);
  if (count_ < kMostAlone + of_two_ || count_ <= 2 * of_two_) return;
  walk.needs_two = true;
  findBy(walk);
}

void DepthEdges::findBy(Walk &walk) {
  count_ = of_two_ = 0;
  std::fill(taken_.begin(), taken_.end(), uint8_t{0});
  for (const bool along_y : {false, true}) {
    walk.along_y = along_y;
    walk.length = along_y ? walk.depth.height : walk.depth.width;
    const int32_t lines = along_y ? walk.depth.width : walk.depth.height, cells = along_y ? kColumns : kRows;
    const int32_t every = std::max(int32_t{1}, lines / (cells * kLinesOfACell));
    for (walk.line = every / 2; walk.line < lines; walk.line += every) this->walk(walk);
  }
}

void DepthEdges::walk(const Walk &walk) {
  Measurement before = {}, last = {0, -walk.gap - 1};
  for (int32_t i = 0; i < walk.length; i += walk.step) {
    const uint16_t value = walk.at(i);
    if (!walk.inRange(value)) continue;
    if (i - last.at > walk.gap)
      last.depth = 0;  // what came before is no neighbour
    else if (isBeyond(value, last.depth) || isBeyond(last.depth, value))
      meet(walk, before, last, {value, i});
    before = last;
    last = {value, i};
  }
}

// Between `last` and `here`, with the measurements on either side of the two.
void DepthEdges::meet(const Walk &walk, const Measurement &before, const Measurement &last,
                      const Measurement &here) {
  const uint32_t after = walk.after(here.at);
  const bool farther = here.depth > last.depth;
  const bool of_two = before.depth && after &&
                      (farther ? isBeyond(std::min(here.depth, after), std::max(before.depth, last.depth))
                               : isBeyond(std::min(before.depth, last.depth), std::max(here.depth, after)));
  if (!of_two && walk.needs_two) return;
  const Measurement &near = farther ? last : here, &far = farther ? here : last;
  const int32_t toward_far = farther ? 1 : -1;
  const uint32_t least = std::max(uint32_t{1}, (far.depth - near.depth) / kRampSteps);
  keep(walk.edge(walk.rampEnd(near, -toward_far, false, least), walk.rampEnd(far, toward_far, true, least)),
       of_two);
}

void DepthEdges::keep(const DepthEdge &edge, bool of_two) {
  const auto bit = static_cast<uint8_t>(edge.along_y ? 2 : 1);
  uint8_t &taken = taken_[edge.cell];
  if (taken & bit) return;
  taken = static_cast<uint8_t>(taken | bit);
  edges_[count_++] = edge;
  of_two_ += of_two;
}

}  // namespace sphc
