// random.h - hashes, a seeded generator and value noise.  Everything is integer arithmetic on fixed widths, hence
// the same on every machine.
#pragma once

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

// The whole number at or below x; std::floor is a function call where the target lacks the instruction.
inline int32_t floorInt(float x) {
  const auto i = static_cast<int32_t>(x);
  return i - (x < static_cast<float>(i) ? 1 : 0);
}

// Random values in [-1, 1] for the lattice of the noise, which repeats after kSide points.
struct NoiseLattice {
  static constexpr uint32_t kSide = 128;
  float value[kSide * kSide];
  NoiseLattice();
};
extern const NoiseLattice kNoiseLattice;

// Smooth noise with one lattice point a unit, in [-1, 1]; `seed` displaces the lattice.
inline float noise(float x, float y, uint32_t seed) {
  constexpr uint32_t kMask = NoiseLattice::kSide - 1;
  const int32_t ix = floorInt(x), iy = floorInt(y);
  float u = x - static_cast<float>(ix), v = y - static_cast<float>(iy);
  u = u * u * (3 - 2 * u);
  v = v * v * (3 - 2 * v);
  const uint32_t shift = seed * 0x9E3779B1u;
  const uint32_t x0 = static_cast<uint32_t>(ix) + (shift >> 25),
                 y0 = static_cast<uint32_t>(iy) + ((shift >> 18) & kMask);
  const float *row0 = kNoiseLattice.value + (y0 & kMask) * NoiseLattice::kSide;
  const float *row1 = kNoiseLattice.value + ((y0 + 1) & kMask) * NoiseLattice::kSide;
  const float a = row0[x0 & kMask], b = row0[(x0 + 1) & kMask];
  const float c = row1[x0 & kMask], d = row1[(x0 + 1) & kMask];
  const float top = a + (b - a) * u, bottom = c + (d - c) * u;
  return top + (bottom - top) * v;
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
