#include "runtime/stages/match/sector_cones.h"

#include <algorithm>

namespace sphc {
namespace {

constexpr float kMargin = 1e-3f;  // of the cones' half angles, radians: rounding, and a sector's last half step

float sineOf(float cosine) { return sqrtOf(std::max(0.0f, 1.0f - cosine * cosine)); }

Direction cornerOf(uint32_t row, uint32_t column, uint32_t side) {
  const auto place = [side](uint32_t k) { return static_cast<uint16_t>(1u + 65534u * k / side); };
  return unpackDirection({place(column), place(row)});
}

float dot(const Direction &a, const Direction &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace

void SectorCones::layout(Arena &scratch, SectorCones *cones) {
  SectorCones discarded;
  SectorCones &c = cones ? *cones : discarded;
  for (Span<float> *part : {&c.x_, &c.y_, &c.z_, &c.cosine_, &c.sine_})
    *part = scratch.take<float>("match.sectors", kMaxSectors);
}

void SectorCones::prepare(uint32_t side) {
  count_ = side * side;
  for (uint32_t s = 0; s < count_; ++s) {
    const uint32_t row = s / side, column = s % side;
    const Direction middle = cornerOf(2 * row + 1, 2 * column + 1, 2 * side);
    x_[s] = middle.x;
    y_[s] = middle.y;
    z_[s] = middle.z;
    cosine_[s] = -1.0f;  // of one sector, the whole sphere
    sine_[s] = 0.0f;
    if (side == 1) continue;
    // A sector is one or two spherical triangles between its corners, so its farthest point is a corner.
    float cosine = 1.0f;
    for (uint32_t corner = 0; corner < 4; ++corner)
      cosine = std::min(cosine, dot(middle, cornerOf(row + corner / 2, column + corner % 2, side)));
    const float sine = sineOf(cosine);
    cosine_[s] = cosine - kMargin * sine - kMargin * kMargin;
    sine_[s] = sineOf(cosine_[s]);
  }
}

uint32_t SectorCones::touched(const Cap &cap, Span<SectorRun> runs) const {
  const float cap_sine = sineOf(cap.cosine);
  uint32_t count = 0;
  bool open = false;
  for (uint32_t s = 0; s < count_; ++s) {
    const float between = x_[s] * cap.axis.x + y_[s] * cap.axis.y + z_[s] * cap.axis.z;
    // cos(a + b); beyond 180 degrees the two meet wherever they are
    const bool touches =
        cosine_[s] <= -cap.cosine || between >= cosine_[s] * cap.cosine - sine_[s] * cap_sine - 1e-6f;
    if (touches && !open) runs[count++] = {s, s};
    if (touches) runs[count - 1].last = s;
    open = touches;
  }
  return count;
}

}  // namespace sphc
