// paint_people.cpp - skin, heads and shoes.
#include "drivers/simulated/paint.h"

namespace sphc::simulated {
namespace {

Ink complexion(Rng &rng) {
  return hsv(rng.uniform(0.045f, 0.075f), rng.uniform(0.3f, 0.55f), rng.uniform(0.5f, 0.88f), 0.6f);
}

}  // namespace

void paintSkin(Canvas &canvas, Rng &rng) {
  const auto seed = static_cast<uint32_t>(rng.next());
  // Both hands and all fingers are one person's: the tone is not drawn.
  const Ink skin{0.8f, 0.62f, 0.52f, 0.6f};
  canvas.fill([&](float x, float y) {
    const float fold = fbm(x * 40, y * 160, 3, seed), pores = fbm(x * 400, y * 400, 2, seed + 1);
    return skin * (1 + 0.1f * fold + 0.08f * pores + 0.1f * fbm(x * 18, y * 18, 2, seed + 2));
  });
  canvas.speckle(rng, 3000, 0.0012f, 0.004f, 0.25f);
}

// u runs around the head; the face is at u = 0.75.
void paintHead(Canvas &canvas, Rng &rng) {
  const auto seed = static_cast<uint32_t>(rng.next());
  const float w = canvas.width(), h = canvas.height(), middle = 0.75f * w;
  const Ink skin = complexion(rng), hair = hsv(rng.uniform(0.04f, 0.12f), 0.5f, rng.uniform(0.1f, 0.55f), 0.4f);
  canvas.fill([&](float x, float y) {
    const float side = std::fabs(x - middle) / w;
    const float hairline = 0.34f * h + 0.9f * h * smooth(0.13f, 0.2f, side) + 0.02f * h * noise(x * 90, 0, seed);
    const Ink strands = hair * (1 + 0.5f * fbm(x * 300, y * 20, 3, seed));
    return y < std::min(hairline, 0.8f * h) ? strands : skin * (1 + 0.06f * fbm(x * 60, y * 60, 3, seed + 1));
  });
  for (const float side : {-1.0f, 1.0f}) {
    const float x = middle + side * 0.055f * w;
    canvas.disc(x, 0.46f * h, 0.013f, {0.92f, 0.92f, 0.9f, 0.5f});
    canvas.disc(x, 0.46f * h, 0.007f, {0.12f, 0.1f, 0.1f, 0.3f});
    canvas.line(x - 0.018f, 0.41f * h, x + 0.018f, 0.4f * h, 0.006f, hair);
  }
  canvas.line(middle, 0.48f * h, middle - 0.006f, 0.58f * h, 0.006f, skin * 0.8f);
  canvas.line(middle - 0.025f, 0.67f * h, middle + 0.025f, 0.67f * h, 0.009f, {0.6f, 0.3f, 0.3f, 0.5f});
}

void paintShoe(Canvas &canvas, Rng &rng) {
  const auto seed = static_cast<uint32_t>(rng.next());
  const float w = canvas.width(), h = canvas.height();
  const Ink leather{0.32f, 0.22f, 0.17f, 0.4f}, lace{0.9f, 0.88f, 0.82f, 0.6f};
  canvas.fill([&](float x, float y) { return leather * (1 + 0.25f * fbm(x * 70, y * 70, 4, seed, 0.7f)); });
  canvas.rectangle(0, 0.88f * h, w, h, {0.85f, 0.83f, 0.78f, 0.6f});
  const float seam = 0.0025f;
  canvas.line(0.1f * w, 0.12f * h, 0.9f * w, 0.12f * h, seam, lace * 0.8f);
  for (float y = 0.4f * h; y < 0.8f * h; y += 0.018f) {
    canvas.line(0.25f * w, y, 0.75f * w, y + 0.01f, 0.005f, lace);
    canvas.line(0.75f * w, y, 0.25f * w, y + 0.01f, 0.005f, lace * 0.85f);
  }
  canvas.speckle(rng, 2000, 0.002f, 0.008f, 0.3f);
}

}  // namespace sphc::simulated
