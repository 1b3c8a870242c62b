// paint_wood.cpp - planks, furniture wood, cabinet doors, the door.
#include "drivers/simulated/paint.h"

namespace sphc::simulated {
namespace {

struct Grain {
  uint32_t seed;
  Ink ink;
};

Grain randomGrain(Rng &style, Rng &rng) {
  const float hue = style.uniform(0.05f, 0.1f), saturation = style.uniform(0.3f, 0.65f);
  return {static_cast<uint32_t>(rng.next()), hsv(hue, saturation, style.uniform(0.36f, 0.8f), 0.45f)};
}

// exp(-x) for x >= 0, near enough for a bend in the grain.
inline float fallOff(float x) {
  const float root = 1 / (1 + 0.25f * x);
  return root * root * root * root;
}

// Wood at `along` and `across` the grain, with a knot every third of a metre or so.
Ink wood(const Grain &grain, float along, float across) {
  const int32_t cell = floorInt(along * (1 / 0.35f));
  const uint32_t id = hash32(cell, 0, grain.seed + 9);
  const float kx = along - (static_cast<float>(cell) + 0.2f + 0.6f * unitFloat(id)) * 0.35f;
  const float ky = across - 0.1f * unitFloat(hash32(static_cast<int32_t>(id), 1, 5));
  const float knot_sq = kx * kx * 0.3f + ky * ky;
  const float bent = across + 0.035f * fallOff(knot_sq / 0.0012f);
  const float warp = fbm(along * 1.7f, across * 7, 2, grain.seed);
  // A saw-like wave whose teeth are the year rings.
  const float phase = bent * 41 + 1.4f * warp;
  const float ring = std::fabs(2 * (phase - static_cast<float>(floorInt(phase))) - 1);
  const float streak = fbm(along * 9, bent * 240, 3, grain.seed + 3, 0.7f);
  const float eye = unitFloat(id) > 0.45f && knot_sq < 2e-4f ? smooth(2e-4f, 4e-5f, knot_sq) : 0.0f;
  return grain.ink * (0.92f + 0.16f * ring + 0.2f * streak - 0.5f * eye);
}

void handle(Canvas &canvas, float x, float y, float length) {
  canvas.line(x, y + 0.006f, x, y + length + 0.006f, 0.016f, {0.12f, 0.1f, 0.08f, 0.2f}, 0.6f);
  canvas.line(x, y, x, y + length, 0.012f, {0.72f, 0.68f, 0.55f, 0.6f});
}

}  // namespace

void paintPlanks(Canvas &canvas, Rng &rng, float plank_width_m, float plank_length_m, bool upright) {
  const Grain grain = randomGrain(rng, rng);
  canvas.fill([&](float x, float y) {
    const float along_all = upright ? y : x, across_all = upright ? x : y;
    const float row = static_cast<float>(floorInt(across_all / plank_width_m));
    const auto r = static_cast<int32_t>(row);
    const float shifted = along_all + plank_length_m * unitFloat(hash32(r, 3, grain.seed));
    const float column = static_cast<float>(floorInt(shifted / plank_length_m));
    const uint32_t id = hash32(static_cast<int32_t>(column), r, grain.seed + 1);
    const float along = shifted - column * plank_length_m, across = across_all - row * plank_width_m;
    Grain own = grain;
    own.seed = id;
    own.ink = own.ink * (0.78f + 0.4f * unitFloat(id));
    own.ink.b *= 0.85f + 0.3f * unitFloat(hash32(static_cast<int32_t>(id), 4, 1));
    const float edge = std::min(std::min(along, plank_length_m - along), std::min(across, plank_width_m - across));
    return wood(own, along, across) * (0.35f + 0.65f * smooth(0.0005f, 0.0035f, edge)) *
           (1 + 0.14f * fbm(x * 1.6f, y * 1.6f, 3, grain.seed + 8));
  });
  canvas.speckle(rng, 500, 0.003f, 0.025f, 0.35f);
  for (int i = 0; i < static_cast<int>(canvas.width() * canvas.height() * 6); ++i) {
    const float x = rng.uniform(0, canvas.width()), y = rng.uniform(0, canvas.height());
    canvas.line(x, y, x + rng.uniform(-0.12f, 0.12f), y + rng.uniform(-0.12f, 0.12f), 0.0025f,
                {0.75f, 0.68f, 0.6f, 0.5f}, rng.uniform(0.1f, 0.4f));
  }
}

void paintParquet(Canvas &canvas, Rng &rng) {
  constexpr float kBlock = 0.3f, kStrips = 6, kStrip = kBlock / kStrips;
  const Grain grain = randomGrain(rng, rng);
  canvas.fill([&](float x, float y) {
    const int32_t column = floorInt(x / kBlock), row = floorInt(y / kBlock);
    const float bx = x - static_cast<float>(column) * kBlock, by = y - static_cast<float>(row) * kBlock;
    const bool turned = ((column + row) & 1) != 0;
    const float along = turned ? by : bx, across_all = turned ? bx : by;
    const int32_t strip = floorInt(across_all / kStrip);
    const float across = across_all - static_cast<float>(strip) * kStrip;
    // Blocks are equal: a strip's wood follows from its place in the block alone.
    const uint32_t id = hash32(strip, turned ? 1 : 0, grain.seed);
    Grain own = grain;
    own.seed = id;
    own.ink = own.ink * (0.8f + 0.35f * unitFloat(id));
    const float gap = std::min(std::min(across, kStrip - across), std::min(along, kBlock - along));
    const float wear = 1 + 0.05f * fbm(x * 1.1f, y * 1.1f, 3, grain.seed + 7);
    return wood(own, along, across) * (wear * (0.35f + 0.65f * smooth(0.0f, 0.002f, gap)));
  });
}

void paintWood(Canvas &canvas, Rng &style, Rng &rng) {
  const Grain grain = randomGrain(style, rng);
  const bool upright = canvas.height() > canvas.width();
  const float shift = rng.uniform(0, 10);
  canvas.fill([&](float x, float y) { return upright ? wood(grain, y + shift, x) : wood(grain, x + shift, y); });
  canvas.speckle(rng, 900, 0.002f, 0.015f, 0.35f);
}

void paintCabinetDoor(Canvas &canvas, Rng &style, Rng &rng) {
  paintWood(canvas, style, rng);
  const float w = canvas.width(), h = canvas.height(), rim = std::min(0.06f, 0.15f * std::min(w, h));
  const Ink dark{0.1f, 0.07f, 0.05f, 0.3f}, light{0.85f, 0.75f, 0.6f, 0.5f};
  canvas.line(0, 0, w, 0, 0.012f, dark, 0.8f);
  canvas.line(0, h, w, h, 0.012f, dark, 0.8f);
  canvas.line(0, 0, 0, h, 0.012f, dark, 0.8f);
  canvas.line(w, 0, w, h, 0.012f, dark, 0.8f);
  canvas.line(rim, rim, w - rim, rim, 0.008f, dark, 0.6f);
  canvas.line(rim, rim, rim, h - rim, 0.008f, dark, 0.6f);
  canvas.line(rim, h - rim, w - rim, h - rim, 0.008f, light, 0.4f);
  canvas.line(w - rim, rim, w - rim, h - rim, 0.008f, light, 0.4f);
  if (h > w) {
    handle(canvas, w - 0.5f * rim, 0.45f * h, 0.1f);
  } else {
    canvas.disc(0.5f * w, 0.5f * h + 0.004f, 0.018f, dark, 0.6f);
    canvas.disc(0.5f * w, 0.5f * h, 0.015f, {0.75f, 0.7f, 0.55f, 0.6f});
  }
  canvas.speckle(rng, 600, 0.003f, 0.02f, 0.3f);
}

void paintDoor(Canvas &canvas, Rng &style, Rng &rng) {
  paintWood(canvas, style, rng);
  const float w = canvas.width(), h = canvas.height();
  const Ink dark{0.12f, 0.09f, 0.06f, 0.3f}, light{0.85f, 0.75f, 0.6f, 0.5f};
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 2; ++i) {
      const float x0 = w * (0.1f + 0.43f * static_cast<float>(i)), x1 = x0 + 0.36f * w;
      const float y0 = h * (0.06f + 0.31f * static_cast<float>(j)), y1 = y0 + 0.26f * h;
      canvas.line(x0, y0, x1, y0, 0.014f, dark, 0.7f);
      canvas.line(x0, y0, x0, y1, 0.014f, dark, 0.7f);
      canvas.line(x0, y1, x1, y1, 0.012f, light, 0.5f);
      canvas.line(x1, y0, x1, y1, 0.012f, light, 0.5f);
    }
  }
  canvas.disc(0.92f * w, 0.52f * h, 0.03f, {0.75f, 0.68f, 0.45f, 0.6f});
  canvas.disc(0.92f * w, 0.52f * h, 0.018f, {0.95f, 0.9f, 0.7f, 0.6f});
  canvas.speckle(rng, 700, 0.003f, 0.03f, 0.3f);
}

}  // namespace sphc::simulated
