// random.h - hashes, a seeded generator and value noise.  Everything is integer arithmetic on fixed widths, hence
// the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>

namespace sphc::simulated {

// Mixes all bits of x: multiplications by odd constants (digits of the golden ratio and of sqrt 3) carry low bits
// up, the shifts carry high bits down.
constexpr uint64_t hash64(uint64_t x) {
  x = (x ^ (x >> 31)) * 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 29)) * 0xBB67AE8584CAA73Bu;
  return x ^ (x >> 32);
}
constexpr uint64_t hash64(uint64_t a, uint64_t b) {
  return hash64(a * 0x9E3779B97F4A7C15u + hash64(b + 0x6A09E667u));
}

constexpr uint32_t hash32(int32_t x, int32_t y, uint32_t seed) {
  uint32_t h = static_cast<uint32_t>(x) * 0x9E3779B1u ^ static_cast<uint32_t>(y) * 0xBB67AE85u ^ seed * 0x3C6EF373u;
  h = (h ^ (h >> 15)) * 0xA54FF53Bu;
  h = (h ^ (h >> 13)) * 0x9B05688Du;
  return h ^ (h >> 16);
}
// In [0, 1).
constexpr float unitFloat(uint32_t h) { return static_cast<float>(h >> 8) * (1.0f / 16777216.0f); }

// Close to a normal variable of unit variance: the sum of four 16-bit uniforms (it ends at 3.5 sigma).
constexpr float gaussian(uint64_t h) {
  const auto sum = static_cast<int32_t>((h & 0xFFFF) + ((h >> 16) & 0xFFFF) + ((h >> 32) & 0xFFFF) + (h >> 48));
  return static_cast<float>(sum - 131070) * (1.0f / 37837.2f);
}

class Rng {
 public:
  explicit Rng(uint64_t seed) : state_(hash64(seed + 1)) {}
  uint64_t next() { return hash64(state_ += 0x9E3779B97F4A7C15u); }
  double real() { return static_cast<double>(next() >> 11) * (1.0 / 9007199254740992.0); }
  double real(double low, double high) { return low + (high - low) * real(); }
  float uniform() { return unitFloat(static_cast<uint32_t>(next() >> 32)); }
  float uniform(float low, float high) { return low + (high - low) * uniform(); }
  // 0 to count - 1.
  int index(int count) { return static_cast<int>((next() >> 33) % static_cast<uint64_t>(count)); }
  bool chance(float p) { return uniform() < p; }

 private:
  uint64_t state_;
};

// Smooth noise with one lattice point a unit, in [-1, 1].
inline float noise(float x, float y, uint32_t seed) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto ix = static_cast<int32_t>(fx), iy = static_cast<int32_t>(fy);
  float u = x - fx, v = y - fy;
  u = u * u * (3 - 2 * u);
  v = v * v * (3 - 2 * v);
  const float a = unitFloat(hash32(ix, iy, seed)), b = unitFloat(hash32(ix + 1, iy, seed));
  const float c = unitFloat(hash32(ix, iy + 1, seed)), d = unitFloat(hash32(ix + 1, iy + 1, seed));
  const float top = a + (b - a) * u, bottom = c + (d - c) * u;
  return 2 * (top + (bottom - top) * v) - 1;
}

// Octaves of noise, each of half the size and `gain` times the amplitude of the one before; about [-1, 1].
inline float fbm(float x, float y, int octaves, uint32_t seed, float gain = 0.5f) {
  float sum = 0, amplitude = 1, total = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * noise(x, y, seed + static_cast<uint32_t>(i) * 101u);
    total += amplitude;
    amplitude *= gain;
    x = 2.03f * x + 17.3f;
    y = 2.03f * y - 9.1f;
  }
  return sum / total * 1.4f;
}

}  // namespace sphc::simulated
