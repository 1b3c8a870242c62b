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
  for (Span<float> *part : {&c.x_, &c.y_, &c.z_, &c.least_})
    *part = scratch.take<float>("match.sectors", kMaxSectors);
}

void SectorCones::prepare(uint32_t side, float cone_cosine) {
  count_ = side * side;
  const float cone_sine = sineOf(cone_cosine);
  for (uint32_t s = 0; s < count_; ++s) {
    const uint32_t row = s / side, column = s % side;
    const Direction middle = cornerOf(2 * row + 1, 2 * column + 1, 2 * side);
    x_[s] = middle.x;
    y_[s] = middle.y;
    z_[s] = middle.z;
    // A sector is one or two spherical triangles between its corners, so its farthest point is a corner.
    float cosine = side == 1 ? -1.0f : 1.0f;
    for (uint32_t corner = 0; side > 1 && corner < 4; ++corner)
      cosine = std::min(cosine, dot(middle, cornerOf(row + corner / 2, column + corner % 2, side)));
    cosine -= kMargin * (sineOf(cosine) + kMargin);
    // cos(a + b); beyond 180 degrees the two meet wherever they are
    least_[s] = cosine <= -cone_cosine ? -2.0f : cosine * cone_cosine - sineOf(cosine) * cone_sine - 1e-6f;
  }
}

uint32_t SectorCones::touched(const Direction &axis, Span<SectorRun> runs) const {
  const float *x = x_.data(), *y = y_.data(), *z = z_.data(), *least = least_.data();
  uint8_t touches[kMaxSectors];
  for (uint32_t s = 0; s < count_; ++s) touches[s] = x[s] * axis.x + y[s] * axis.y + z[s] * axis.z >= least[s];
  uint32_t count = 0;
  for (uint32_t s = 0; s < count_; ++s) {
    if (!touches[s]) continue;
    if (s == 0 || !touches[s - 1]) runs[count++] = {s, s};
    runs[count - 1].last = s;
  }
  return count;
}

}  // namespace sphc
