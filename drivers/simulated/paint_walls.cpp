// paint_walls.cpp - brick, wallpaper, plaster, ceiling.
#include "drivers/simulated/paint.h"
#include "drivers/simulated/vec.h"

namespace sphc::simulated {
namespace {

uint32_t noiseSeed(Rng &rng) { return static_cast<uint32_t>(rng.next()); }

// A crack: a line that wanders and thins out.
void crack(Canvas &canvas, Rng &rng, const Ink &ink) {
  float x = rng.uniform(0, canvas.width()), y = rng.uniform(0, canvas.height());
  float angle = rng.uniform(0, 2 * kFloatPi);
  const int steps = 12 + rng.index(30);
  for (int i = 0; i < steps; ++i) {
    angle += rng.uniform(-0.6f, 0.6f);
    const float length = rng.uniform(0.01f, 0.05f);
    const float nx = x + length * std::cos(angle), ny = y + length * std::sin(angle);
    const float fade = 1 - static_cast<float>(i) / static_cast<float>(steps);
    canvas.line(x, y, nx, ny, 0.001f + 0.004f * fade, ink, 0.75f);
    x = nx;
    y = ny;
  }
}

// One flower-like motif of the wallpaper; no two are quite alike.
void flower(Canvas &canvas, Rng &rng, float x, float y, float radius, const Ink &petal, const Ink &heart) {
  const auto petals = static_cast<float>(4 + rng.index(5));
  const float turn = rng.uniform(0, 2 * kFloatPi), depth = rng.uniform(0.2f, 0.5f);
  const float squash = rng.uniform(0.75f, 1.3f);
  const auto distance = [&](float px, float py) {
    const float ex = px - x, ey = (py - y) * squash;
    const float r = std::sqrt(ex * ex + ey * ey);
    return r - radius * (1 - depth + depth * std::cos(petals * std::atan2(ey, ex) + turn));
  };
  const float reach = 1.4f * radius;
  canvas.figure(x - reach, y - reach, x + reach, y + reach, distance, petal, 0.9f);
  canvas.disc(x, y, radius * rng.uniform(0.15f, 0.4f), heart);
  for (int i = rng.index(4); i > 0; --i) {
    const float a = rng.uniform(0, 2 * kFloatPi), l = radius * rng.uniform(1.1f, 2.0f);
    canvas.line(x + radius * std::cos(a), y + radius * std::sin(a), x + l * std::cos(a + 0.4f),
                y + l * std::sin(a + 0.4f), rng.uniform(0.003f, 0.008f), heart, 0.8f);
  }
}

}  // namespace

void paintBrick(Canvas &canvas, Rng &rng) {
  constexpr float kLength = 0.22f, kHeight = 0.072f, kJoint = 0.006f;
  const uint32_t seed = noiseSeed(rng);
  const float hue = rng.uniform(0.01f, 0.06f);
  const Ink mortar = hsv(0.1f, 0.1f, rng.uniform(0.6f, 0.75f), 0.55f);
  canvas.fill([&](float x, float y) {
    // Courses wander a little, and every second one is displaced by half a brick.
    const float wy = y + 0.004f * noise(x * 3, y * 3, seed + 1);
    const float course = static_cast<float>(floorInt(wy / kHeight));
    const auto row = static_cast<int32_t>(course);
    const float wx = x + ((row & 1) != 0 ? kLength * 0.5f : 0) + 0.03f * unitFloat(hash32(row, 7, seed));
    const float column = static_cast<float>(floorInt(wx / kLength));
    const uint32_t id = hash32(static_cast<int32_t>(column), row, seed + 2);
    const float bx = wx - column * kLength, by = wy - course * kHeight;
    const float chip = 0.004f * fbm(x * 45, y * 45, 3, seed + 3);
    const float edge = std::min({bx, kLength - bx, by, kHeight - by}) - kJoint + chip;
    const float a = unitFloat(id), b = unitFloat(hash32(static_cast<int32_t>(id), 1, seed));
    const float c = unitFloat(hash32(static_cast<int32_t>(id), 2, seed));
    const float grain = fbm(x * 55, y * 55, 4, id, 0.7f);
    const Ink brick = hsv(hue + 0.03f * b, 0.45f + 0.2f * c, 0.46f + 0.26f * a, 0.35f + 0.2f * a) *
                      (1 + (0.1f + 0.2f * b) * grain);
    const Ink joint = mortar * (1 + 0.25f * fbm(x * 90, y * 90, 3, seed + 4));
    const float stain = 1 + 0.22f * fbm(x * 1.3f, y * 1.3f, 4, seed + 5);
    return mix(joint, brick, smooth(-0.001f, 0.003f, edge)) * stain;
  });
  canvas.speckle(rng, 900, 0.003f, 0.03f, 0.35f);
  for (int i = 0; i < static_cast<int>(canvas.width() * 1.5f); ++i) crack(canvas, rng, {0.25f, 0.2f, 0.18f, 0.3f});
}

void paintWallpaper(Canvas &canvas, Rng &rng) {
  const uint32_t seed = noiseSeed(rng);
  const float hue = rng.uniform();
  const Ink base = hsv(hue, rng.uniform(0.1f, 0.35f), rng.uniform(0.68f, 0.85f), 0.65f);
  const Ink stripe =
      hsv(hue + rng.uniform(-0.08f, 0.08f), rng.uniform(0.2f, 0.45f), rng.uniform(0.55f, 0.8f), 0.6f);
  const float period = rng.uniform(0.12f, 0.3f);
  canvas.fill([&](float x, float y) {
    const float wave = std::sin(2 * kFloatPi * (x + 0.012f * std::sin(9 * y)) / period);
    const float fade = 1 + 0.1f * fbm(x * 1.1f, y * 1.1f, 4, seed) + 0.06f * fbm(x * 60, y * 60, 3, seed + 1, 0.8f);
    return mix(base, stripe, smooth(-0.15f, 0.15f, wave)) * fade;
  });
  const float pitch = rng.uniform(0.13f, 0.19f);
  for (float y = 0; y < canvas.height() + pitch; y += pitch) {
    for (float x = 0; x < canvas.width() + pitch; x += pitch) {
      const Ink petal =
          hsv(hue + rng.uniform(-0.2f, 0.3f), rng.uniform(0.2f, 0.6f), rng.uniform(0.35f, 0.95f), 0.5f);
      const Ink heart = hsv(hue + 0.5f + rng.uniform(-0.1f, 0.1f), 0.5f, rng.uniform(0.3f, 0.9f), 0.5f);
      flower(canvas, rng, x + rng.uniform(-0.03f, 0.03f), y + rng.uniform(-0.03f, 0.03f), rng.uniform(0.02f, 0.05f),
             petal, heart);
    }
  }
  canvas.speckle(rng, 1200, 0.004f, 0.02f, 0.3f);
}

// The style is the paper; the seed is what years leave, the only thing that does not repeat.
void paintRepeatingWallpaper(Canvas &canvas, Rng &style, Rng &rng) {
  constexpr float kRepeat = 0.53f;
  constexpr int kFlowers = 12;
  const uint32_t seed = noiseSeed(rng);
  const float hue = style.uniform();
  const Ink base = hsv(hue, style.uniform(0.1f, 0.35f), style.uniform(0.68f, 0.85f), 0.65f);
  const Ink stripe = hsv(hue + 0.06f, style.uniform(0.2f, 0.45f), style.uniform(0.55f, 0.8f), 0.6f);
  const float stripes = static_cast<float>(2 + style.index(3));
  canvas.fill([&](float x, float y) {
    const float wave = std::sin(2 * kFloatPi * stripes * x / kRepeat);
    return mix(base, stripe, smooth(-0.15f, 0.15f, wave)) * (1 + 0.04f * fbm(x * 1.1f, y * 1.1f, 3, seed));
  });
  // From one repetition before the canvas on, since flowers reach over the edge of theirs.
  for (float top = -kRepeat; top < canvas.height(); top += kRepeat) {
    for (float left = -kRepeat; left < canvas.width(); left += kRepeat) {
      Rng motif = style;
      for (int i = 0; i < kFlowers; ++i) {
        const Ink petal = hsv(hue + motif.uniform(-0.2f, 0.3f), 0.5f, motif.uniform(0.35f, 0.95f), 0.5f);
        const Ink heart = hsv(hue + 0.5f, 0.5f, motif.uniform(0.3f, 0.9f), 0.5f);
        const float x = left + motif.uniform(0, kRepeat), y = top + motif.uniform(0, kRepeat);
        flower(canvas, motif, x, y, motif.uniform(0.02f, 0.06f), petal, heart);
      }
    }
  }
}

void paintPlaster(Canvas &canvas, Rng &rng) {
  const uint32_t seed = noiseSeed(rng);
  const Ink base = mix(tasteful(rng), {0.9f, 0.88f, 0.82f, 0.7f}, rng.uniform(0.6f, 0.8f));
  const Ink under = mix(base, tasteful(rng), 0.35f);
  canvas.fill([&](float x, float y) {
    const float roller = fbm(x * 70, y * 25, 4, seed, 0.75f);
    const float large = fbm(x * 1.4f, y * 1.4f, 5, seed + 1, 0.6f);
    const float worn = fbm(x * 3.1f, y * 3.1f, 6, seed + 2, 0.6f);
    const Ink paint = mix(base, under, 0.75f * smooth(0.42f, 0.5f, worn));
    return paint * (1 + 0.09f * roller + 0.12f * large);
  });
  canvas.speckle(rng, 2200, 0.004f, 0.03f, 0.3f);
  const Ink dark = under * 0.5f;
  for (int i = 0; i < static_cast<int>(canvas.width() * 2); ++i) crack(canvas, rng, dark);
}

void paintBare(Canvas &canvas, Rng &rng) {
  const uint32_t seed = noiseSeed(rng);
  const Ink base = mix(tasteful(rng), {0.9f, 0.89f, 0.86f, 0.7f}, 0.85f);
  canvas.fill([&](float x, float y) { return base * (1 + 0.012f * fbm(x * 0.8f, y * 0.8f, 2, seed)); });
}

void paintCeiling(Canvas &canvas, Rng &rng) {
  const uint32_t seed = noiseSeed(rng);
  canvas.fill([&](float x, float y) {
    const float large = fbm(x * 0.9f, y * 0.9f, 5, seed, 0.6f), fine = fbm(x * 30, y * 30, 4, seed + 1, 0.7f);
    return Ink{0.86f, 0.84f, 0.8f, 0.75f} * (1 + 0.09f * large + 0.09f * fine);
  });
  canvas.speckle(rng, 350, 0.008f, 0.06f, 0.2f);
  for (int i = 0; i < 14; ++i) crack(canvas, rng, {0.5f, 0.47f, 0.43f, 0.5f});
}

}  // namespace sphc::simulated
