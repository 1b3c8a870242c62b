// canvas.h - drawing on one painted face: patterns, anti-aliased figures and lettering, in metres.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "drivers/simulated/random.h"
#include "drivers/simulated/texture.h"

namespace sphc::simulated {

// Paint: colour as the square root of linear light, and reflectance for the ToF camera; all in [0, 1].
struct Ink {
  float r = 0, g = 0, b = 0, ir = 0;
};
constexpr Ink operator*(const Ink &a, float s) { return {a.r * s, a.g * s, a.b * s, a.ir}; }
constexpr Ink mix(const Ink &a, const Ink &b, float t) {
  return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t, a.ir + (b.ir - a.ir) * t};
}
// Hue in turns, saturation, value.
Ink hsv(float hue, float saturation, float value, float ir = 0.5f);
// One of the colours that things in a living room have.
Ink tasteful(Rng &rng);
Ink randomInk(Rng &rng, float saturation_min, float saturation_max, float value_min, float value_max);

inline float smooth(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

class Canvas {
 public:
  Canvas(Texel *texels, uint32_t width, uint32_t height, float width_m, float height_m);

  float width() const { return width_m_; }
  float height() const { return height_m_; }
  float texel() const { return std::max(dx_, dy_); }

  // Every texel becomes pattern(x_m, y_m); x to the right, y down, from the top left corner.
  template <class Pattern>
  void fill(const Pattern &pattern) {
    for (uint32_t y = 0; y < height_; ++y) {
      for (uint32_t x = 0; x < width_; ++x) {
        put(x, y, pattern((static_cast<float>(x) + 0.5f) * dx_, (static_cast<float>(y) + 0.5f) * dy_));
      }
    }
  }

  // Blends `ink` where distance(x_m, y_m) < 0, inside the box given, with an edge one texel wide.
  template <class Distance>
  void figure(float x0, float y0, float x1, float y1, const Distance &distance, const Ink &ink, float alpha) {
    const uint32_t left = column(x0 - dx_), right = column(x1 + dx_ * 2);
    const uint32_t top = row(y0 - dy_), bottom = row(y1 + dy_ * 2);
    const float inverse = 1.0f / texel();
    for (uint32_t y = top; y < bottom; ++y) {
      for (uint32_t x = left; x < right; ++x) {
        const float d = distance((static_cast<float>(x) + 0.5f) * dx_, (static_cast<float>(y) + 0.5f) * dy_);
        const float cover = std::clamp(0.5f - d * inverse, 0.0f, 1.0f);
        if (cover > 0) blend(x, y, ink, alpha * cover);
      }
    }
  }

  void rectangle(float x0, float y0, float x1, float y1, const Ink &ink, float alpha = 1);
  void disc(float x, float y, float radius, const Ink &ink, float alpha = 1);
  void ring(float x, float y, float radius, float thickness, const Ink &ink);
  void line(float x0, float y0, float x1, float y1, float thickness, const Ink &ink, float alpha = 1);
  void triangle(const float xy[6], const Ink &ink, float alpha = 1);
  // A soft spot, darker or lighter than what is there by the factor.
  void spot(float x, float y, float radius, float factor);
  // Capital letters, digits and blanks; `height_m` of a letter; (x, y) is the top left corner.  `down`: turned a
  // quarter clockwise, as on the spine of a book; then (x, y) is the top right corner.  Returns the length.
  float text(float x, float y, float height_m, const std::string &words, const Ink &ink, bool down = false);

  // Spots of all sizes from radius_min to radius_max, `per_m2` of them: wear, grain, dust.
  void speckle(Rng &rng, float per_m2, float radius_min, float radius_max, float contrast);

 private:
  uint32_t column(float x) const { return index(x / dx_, width_); }
  uint32_t row(float y) const { return index(y / dy_, height_); }
  static uint32_t index(float at, uint32_t count) {
    return static_cast<uint32_t>(std::clamp(at, 0.0f, static_cast<float>(count)));
  }
  void put(uint32_t x, uint32_t y, const Ink &ink);
  void blend(uint32_t x, uint32_t y, const Ink &ink, float alpha);

  Texel *texels_;
  uint32_t width_, height_;
  float width_m_, height_m_, dx_, dy_;
};

std::string randomWord(Rng &rng, int letters);

}  // namespace sphc::simulated
