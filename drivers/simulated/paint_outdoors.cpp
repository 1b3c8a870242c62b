// paint_outdoors.cpp - what a window shows: houses across the street, a lawn, the sky.
#include "drivers/simulated/paint.h"

namespace sphc::simulated {
namespace {

constexpr Ink kZenith{0.55f, 0.7f, 0.92f, 0}, kHorizon{0.86f, 0.91f, 0.96f, 0};

void house(Canvas &canvas, Rng &rng, float left, float width, float top) {
  const float bottom = canvas.height();
  const Ink wall = mix(tasteful(rng), {0.85f, 0.8f, 0.72f, 0.3f}, rng.uniform(0.3f, 0.8f));
  const Ink frame{0.92f, 0.92f, 0.9f, 0.3f}, roof = hsv(0.03f, 0.5f, rng.uniform(0.3f, 0.5f), 0.3f);
  canvas.rectangle(left, top, left + width, bottom, wall);
  const float eaves[6] = {left - 0.4f, top, left + width + 0.4f, top, left + 0.5f * width, top - 2.2f};
  canvas.triangle(eaves, roof);
  const float pitch = rng.uniform(1.7f, 2.3f);
  for (float y = top + 0.8f; y < bottom - 1.5f; y += 2.8f) {
    for (float x = left + 0.6f; x < left + width - 1.2f; x += pitch) {
      canvas.rectangle(x - 0.1f, y - 0.1f, x + 1.0f, y + 1.5f, frame);
      canvas.rectangle(x, y, x + 0.9f, y + 1.4f, hsv(0.58f, 0.25f, rng.uniform(0.15f, 0.6f), 0.2f));
      canvas.rectangle(x + 0.42f, y, x + 0.48f, y + 1.4f, frame);
    }
  }
}

}  // namespace

void paintStreet(Canvas &canvas, Rng &rng) {
  const float w = canvas.width(), h = canvas.height();
  canvas.fill([&](float, float y) { return mix(kZenith, kHorizon, smooth(0, 0.7f * h, y)); });
  for (float x = rng.uniform(-3, 0); x < w;) {
    const float width = rng.uniform(7, 13);
    house(canvas, rng, x, width, h - rng.uniform(8, 14));
    x += width + (rng.chance(0.5f) ? 0 : rng.uniform(1, 5));
  }
  for (int i = 0; i < 12; ++i) {
    const float x = rng.uniform(0, w), y = h - rng.uniform(2, 6);
    for (int leaf = 0; leaf < 60; ++leaf) {
      canvas.disc(x + rng.uniform(-1.8f, 1.8f), y + rng.uniform(-2, 2), rng.uniform(0.15f, 0.6f),
                  hsv(rng.uniform(0.22f, 0.36f), 0.6f, rng.uniform(0.2f, 0.55f), 0.5f));
    }
    canvas.rectangle(x - 0.15f, y + 1, x + 0.15f, h, {0.3f, 0.24f, 0.18f, 0.3f});
  }
}

void paintLawn(Canvas &canvas, Rng &rng) {
  const auto seed = static_cast<uint32_t>(rng.next());
  canvas.fill([&](float x, float y) {
    return Ink{0.4f, 0.55f, 0.25f, 0.6f} *
           (1 + 0.25f * fbm(x * 2, y * 2, 4, seed) + 0.15f * fbm(x, y, 3, seed + 1));
  });
}

void paintSky(Canvas &canvas) {
  canvas.fill([](float, float) { return kZenith; });
}

}  // namespace sphc::simulated
