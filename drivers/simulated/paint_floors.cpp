// paint_floors.cpp - floors that repeat: each part of them is found again, exactly, a hand's breadth on.
#include "drivers/simulated/paint.h"

namespace sphc::simulated {
namespace {

// Where (x, y) lies within its repetition, in [0, period).
struct Repeated {
  float x, y;
};
Repeated repeated(float x, float y, float period) {
  return {x - period * static_cast<float>(floorInt(x / period)),
          y - period * static_cast<float>(floorInt(y / period))};
}

// What feet and years leave, the only thing that does not repeat.
float wear(float x, float y, float strength, uint32_t seed) {
  return 1 + strength * fbm(x * 1.2f, y * 1.2f, 3, seed);
}

}  // namespace

void paintFittedCarpet(Canvas &canvas, Rng &rng) {
  constexpr float kPeriod = 0.09f, kLoop = 0.0075f;
  const auto seed = static_cast<uint32_t>(rng.next());
  const Ink base = tasteful(rng) * 0.95f;
  const Ink inks[3] = {base, mix(base, tasteful(rng), 0.6f), mix(base, {0.8f, 0.78f, 0.7f, 0.6f}, 0.5f)};
  canvas.fill([&](float x, float y) {
    const Repeated at = repeated(x, y, kPeriod);
    const int32_t column = floorInt(at.x / kLoop), row = floorInt(at.y / kLoop);
    const float lx = at.x / kLoop - static_cast<float>(column) - 0.5f;
    const float ly = at.y / kLoop - static_cast<float>(row) - 0.5f;
    // Loops of three colours, drawn once for all repetitions; each is brightest in its middle.
    const uint32_t loop = hash32(column, row, seed);
    const float height = 1.1f - 0.7f * (lx * lx + ly * ly) + 0.25f * (unitFloat(hash32(row, column, seed)) - 0.5f);
    return inks[loop % 3] * (height * wear(x, y, 0.05f, seed));
  });
}

void paintTiles(Canvas &canvas, Rng &rng) {
  constexpr float kTileSide = 0.25f, kJoint = 0.0035f, kHalf = 0.5f * kTileSide;
  const auto seed = static_cast<uint32_t>(rng.next());
  const Ink base = mix(tasteful(rng), {0.85f, 0.83f, 0.78f, 0.6f}, 0.6f), ornament = tasteful(rng) * 0.8f;
  const Ink joint{0.42f, 0.4f, 0.38f, 0.4f};
  const float arc = rng.uniform(0.05f, 0.08f), star = rng.uniform(0.03f, 0.05f);
  canvas.fill([&](float x, float y) {
    const Repeated at = repeated(x, y, kTileSide);
    const float ex = std::fabs(at.x - kHalf), ey = std::fabs(at.y - kHalf);  // from the middle
    const float to_corner = std::sqrt((kHalf - ex) * (kHalf - ex) + (kHalf - ey) * (kHalf - ey));
    const float ring = std::fabs(to_corner - arc) - 0.009f;
    const float pointed = std::sqrt(ex) + std::sqrt(ey) - std::sqrt(star);
    const float drawn = smooth(0.001f, -0.001f, ring) + smooth(0.01f, -0.01f, pointed);
    const float glaze = 1 + 0.1f * fbm(at.x * 60, at.y * 60, 3, seed);
    const float edge = kHalf - std::max(ex, ey);
    const Ink tile = mix(base, ornament, std::min(drawn, 1.0f)) * glaze;
    return mix(joint, tile, smooth(0.5f * kJoint, 0.5f * kJoint + 0.0015f, edge)) * wear(x, y, 0.04f, seed);
  });
}

}  // namespace sphc::simulated
