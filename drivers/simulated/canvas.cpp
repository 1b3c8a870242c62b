#include "drivers/simulated/canvas.h"

#include "drivers/simulated/font.h"

namespace sphc::simulated {
namespace {

// Rounding: the cast cuts, and x is never negative.
constexpr float kHalf = 0.5f;
inline uint32_t byteOf(float x) { return static_cast<uint32_t>(std::clamp(x, 0.0f, 1.0f) * 255.0f + kHalf); }
inline float channel(Texel texel, int shift) {
  return static_cast<float>((texel >> shift) & 255u) * (1.0f / 255.0f);
}

float segmentDistance(float x, float y, float x0, float y0, float x1, float y1) {
  const float dx = x1 - x0, dy = y1 - y0;
  const float t = std::clamp(((x - x0) * dx + (y - y0) * dy) / std::max(dx * dx + dy * dy, 1e-12f), 0.0f, 1.0f);
  const float ex = x - x0 - t * dx, ey = y - y0 - t * dy;
  return std::sqrt(ex * ex + ey * ey);
}

}  // namespace

Ink hsv(float hue, float saturation, float value, float ir) {
  const auto tone = [&](float shift) {
    const float h = (hue + shift - std::floor(hue + shift)) * 6;
    return value * (1 - saturation * (1 - std::clamp(std::fabs(h - 3) - 1, 0.0f, 1.0f)));
  };
  return {tone(0), tone(2.0f / 3), tone(1.0f / 3), ir};
}

Ink randomInk(Rng &rng, float saturation_min, float saturation_max, float value_min, float value_max) {
  const float hue = rng.uniform();
  const float saturation = rng.uniform(saturation_min, saturation_max);
  return hsv(hue, saturation, rng.uniform(value_min, value_max), rng.uniform(0.3f, 0.8f));
}

Ink tasteful(Rng &rng) {
  // Browns, reds, blues, greens and greys that people buy: hue, saturation, value.
  constexpr float kChoices[14][3] = {{0.99f, 0.75f, 0.5f},  {0.60f, 0.65f, 0.42f}, {0.08f, 0.6f, 0.48f},
                                     {0.38f, 0.5f, 0.38f},  {0.13f, 0.65f, 0.8f},  {0.11f, 0.22f, 0.88f},
                                     {0.58f, 0.08f, 0.6f},  {0.6f, 0.15f, 0.22f},  {0.49f, 0.55f, 0.5f},
                                     {0.95f, 0.6f, 0.36f},  {0.05f, 0.78f, 0.8f},  {0.56f, 0.45f, 0.75f},
                                     {0.78f, 0.35f, 0.48f}, {0.25f, 0.4f, 0.55f}};
  const float *choice = kChoices[rng.index(14)];
  return hsv(choice[0] + rng.uniform(-0.02f, 0.02f), choice[1] * rng.uniform(0.8f, 1.15f),
             std::min(0.92f, choice[2] * rng.uniform(0.85f, 1.2f)), rng.uniform(0.3f, 0.8f));
}

Canvas::Canvas(Texel *texels, uint32_t width, uint32_t height, float width_m, float height_m)
    : texels_(texels),
      width_(width),
      height_(height),
      width_m_(width_m),
      height_m_(height_m),
      dx_(width_m / static_cast<float>(width)),
      dy_(height_m / static_cast<float>(height)) {}

void Canvas::put(uint32_t x, uint32_t y, const Ink &ink) {
  texels_[static_cast<size_t>(y) * width_ + x] =
      byteOf(ink.r) | byteOf(ink.g) << 8 | byteOf(ink.b) << 16 | byteOf(ink.ir) << 24;
}

void Canvas::blend(uint32_t x, uint32_t y, const Ink &ink, float alpha) {
  const Texel old = texels_[static_cast<size_t>(y) * width_ + x];
  put(x, y, mix({channel(old, 0), channel(old, 8), channel(old, 16), channel(old, 24)}, ink, alpha));
}

void Canvas::rectangle(float x0, float y0, float x1, float y1, const Ink &ink, float alpha) {
  const auto distance = [&](float x, float y) { return std::max({x0 - x, x - x1, y0 - y, y - y1}); };
  figure(x0, y0, x1, y1, distance, ink, alpha);
}

void Canvas::disc(float x, float y, float radius, const Ink &ink, float alpha) {
  const auto distance = [&](float px, float py) {
    return std::sqrt((px - x) * (px - x) + (py - y) * (py - y)) - radius;
  };
  figure(x - radius, y - radius, x + radius, y + radius, distance, ink, alpha);
}

void Canvas::ring(float x, float y, float radius, float thickness, const Ink &ink) {
  const float reach = radius + thickness;
  const auto distance = [&](float px, float py) {
    return std::fabs(std::sqrt((px - x) * (px - x) + (py - y) * (py - y)) - radius) - 0.5f * thickness;
  };
  figure(x - reach, y - reach, x + reach, y + reach, distance, ink, 1);
}

void Canvas::line(float x0, float y0, float x1, float y1, float thickness, const Ink &ink, float alpha) {
  const auto distance = [&](float x, float y) { return segmentDistance(x, y, x0, y0, x1, y1) - 0.5f * thickness; };
  figure(std::min(x0, x1) - thickness, std::min(y0, y1) - thickness, std::max(x0, x1) + thickness,
         std::max(y0, y1) + thickness, distance, ink, alpha);
}

void Canvas::triangle(const float xy[6], const Ink &ink, float alpha) {
  const float area = (xy[2] - xy[0]) * (xy[5] - xy[1]) - (xy[4] - xy[0]) * (xy[3] - xy[1]);
  const float turn = area > 0 ? 1.0f : -1.0f;
  const auto distance = [&](float x, float y) {
    float worst = -1e9f;
    for (int i = 0; i < 3; ++i) {
      const float *a = xy + 2 * i, *b = xy + 2 * ((i + 1) % 3);
      const float dx = b[0] - a[0], dy = b[1] - a[1];
      const float side = ((x - a[0]) * dy - (y - a[1]) * dx) / std::max(std::sqrt(dx * dx + dy * dy), 1e-9f);
      worst = std::max(worst, side * turn);
    }
    return worst;
  };
  figure(std::min({xy[0], xy[2], xy[4]}), std::min({xy[1], xy[3], xy[5]}), std::max({xy[0], xy[2], xy[4]}),
         std::max({xy[1], xy[3], xy[5]}), distance, ink, alpha);
}

void Canvas::spot(float x, float y, float radius, float factor) {
  const uint32_t left = column(x - radius), right = column(x + radius + dx_);
  const uint32_t top = row(y - radius), bottom = row(y + radius + dy_);
  for (uint32_t j = top; j < bottom; ++j) {
    for (uint32_t i = left; i < right; ++i) {
      const float ex = ((static_cast<float>(i) + 0.5f) * dx_ - x) / radius;
      const float ey = ((static_cast<float>(j) + 0.5f) * dy_ - y) / radius;
      const float inside = 1 - ex * ex - ey * ey;
      if (inside <= 0) continue;
      const float gain = 1 + (factor - 1) * std::min(1.0f, 1.6f * inside);
      const Texel old = texels_[static_cast<size_t>(j) * width_ + i];
      put(i, j, {channel(old, 0) * gain, channel(old, 8) * gain, channel(old, 16) * gain, channel(old, 24)});
    }
  }
}

float Canvas::text(float x, float y, float height_m, const std::string &words, const Ink &ink, bool down) {
  const float cell = height_m / static_cast<float>(kFontRows);
  float at = 0;
  for (const char letter : words) {
    for (int j = 0; j < kFontRows; ++j) {
      for (int i = 0; i < kFontColumns; ++i) {
        if (!fontDot(letter, i, j)) continue;
        const float a = at + static_cast<float>(i) * cell, b = static_cast<float>(j) * cell;
        if (down) {
          rectangle(x - b - cell, y + a, x - b, y + a + cell, ink);
        } else {
          rectangle(x + a, y + b, x + a + cell, y + b + cell, ink);
        }
      }
    }
    at += cell * static_cast<float>(kFontColumns + 1);
  }
  return at;
}

void Canvas::speckle(Rng &rng, float per_m2, float radius_min, float radius_max, float contrast) {
  const int count = static_cast<int>(per_m2 * width_m_ * height_m_);
  for (int i = 0; i < count; ++i) {
    const float pick = rng.uniform();
    // Many small, few large: equal numbers in equal shares of 1 / radius.
    const float radius = 1.0f / (1.0f / radius_min + (1.0f / radius_max - 1.0f / radius_min) * pick);
    const float x = rng.uniform(0, width_m_), y = rng.uniform(0, height_m_);
    // Large spots are faint: wear, not mould.
    const float strength = contrast * std::sqrt(radius_min / radius);
    spot(x, y, std::max(radius, 0.7f * texel()), 1 + rng.uniform(-strength, strength));
  }
}

std::string randomWord(Rng &rng, int letters) {
  static const char kConsonants[] = "BCDFGHKLMNPRSTVWZ", kVowels[] = "AEIOU";
  std::string word;
  bool vowel = rng.chance(0.4f);
  for (int i = 0; i < letters; ++i, vowel = !vowel) {
    word += vowel ? kVowels[rng.index(5)] : kConsonants[rng.index(17)];
  }
  return word;
}

}  // namespace sphc::simulated
