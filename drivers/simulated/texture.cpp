#include "drivers/simulated/texture.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <utility>

namespace sphc::simulated {
namespace {

constexpr uint64_t kEven = 0x00FF00FF00FF00FFu;
constexpr uint64_t kHalves = 0x0080008000800080u;

// The four bytes of a texel in four lanes of 16 bits, so that one multiplication scales all of them.
inline uint64_t spread(Texel texel) {
  uint64_t x = texel;
  x = (x | (x << 16)) & 0x0000FFFF0000FFFFu;
  return (x | (x << 8)) & kEven;
}
inline Texel gather(uint64_t x) {
  x = (x | (x >> 8)) & 0x0000FFFF0000FFFFu;
  return static_cast<Texel>(x | (x >> 16));
}
// a + (b - a) * weight / 256; no lane overflows since 255 * 256 + 128 < 65536.
inline uint64_t mix(uint64_t a, uint64_t b, uint32_t weight) {
  return ((a * (256 - weight) + b * weight + kHalves) >> 8) & kEven;
}

inline uint32_t levelWidth(uint32_t width, int level) { return std::max(width >> level, 1u); }

}  // namespace

struct TexturePool::Painted {
  std::atomic<bool> done{false};
  std::once_flag once;
};

uint32_t TexturePool::add(float width_m, float height_m, float texel_m) {
  constexpr float kMaxSide = 4096;
  const auto side = [&](float size_m) {
    return static_cast<uint32_t>(std::clamp(std::round(size_m / texel_m), 2.0f, kMaxSide));
  };
  Texture texture;
  texture.width = side(width_m);
  texture.height = side(height_m);
  texture.texel_m =
      std::max(width_m / static_cast<float>(texture.width), height_m / static_cast<float>(texture.height));
  for (int level = 0; level < Texture::kMaxLevels; ++level) {
    const uint32_t w = levelWidth(texture.width, level), h = levelWidth(texture.height, level);
    texture.offset[level] = total_;
    total_ += static_cast<size_t>(w) * h;
    texture.levels = level + 1;
    if (w == 1 && h == 1) break;
  }
  textures_.push_back(texture);
  return size() - 1;
}

void TexturePool::allocate(Paint paint) {
  paint_ = std::move(paint);
  painted_ = std::shared_ptr<Painted[]>(new Painted[textures_.size()]);
  texels_.reset(static_cast<Texel *>(std::calloc(total_, sizeof(Texel))));
  if (!texels_) throw std::bad_alloc();
}

const Texture &TexturePool::painted(uint32_t index) const {
  if (!painted_[index].done.load(std::memory_order_acquire)) paint(index);
  return textures_[index];
}

void TexturePool::paint(uint32_t index) const {
  std::call_once(painted_[index].once, [&] {
    const Texture &texture = textures_[index];
    paint_(index, texture, texels_.get() + texture.offset[0]);
    buildPyramid(texture);
    painted_[index].done.store(true, std::memory_order_release);
  });
}

void TexturePool::buildPyramid(const Texture &texture) const {
  for (int level = 1; level < texture.levels; ++level) {
    const uint32_t from_w = levelWidth(texture.width, level - 1), from_h = levelWidth(texture.height, level - 1);
    const uint32_t w = levelWidth(texture.width, level), h = levelWidth(texture.height, level);
    const Texel *from = texels_.get() + texture.offset[level - 1];
    Texel *to = texels_.get() + texture.offset[level];
    for (uint32_t y = 0; y < h; ++y) {
      const Texel *row0 = from + static_cast<size_t>(std::min(2 * y, from_h - 1)) * from_w;
      const Texel *row1 = from + static_cast<size_t>(std::min(2 * y + 1, from_h - 1)) * from_w;
      for (uint32_t x = 0; x < w; ++x) {
        const uint32_t x0 = std::min(2 * x, from_w - 1), x1 = std::min(2 * x + 1, from_w - 1);
        const uint64_t sum = spread(row0[x0]) + spread(row0[x1]) + spread(row1[x0]) + spread(row1[x1]);
        to[static_cast<size_t>(y) * w + x] = gather(((sum + 0x0002000200020002u) >> 2) & kEven);
      }
    }
  }
}

// Texture coordinates are spread over the level's own texels.  An odd side loses half a texel at its end from a
// level to the next (at most 0.5 / side of the face), far less than a pixel where that level is in use.
Texel TexturePool::sample(const Texture &texture, float u, float v, int wanted_level) const {
  const int level = std::min(wanted_level, texture.levels - 1);
  const auto w = static_cast<int32_t>(levelWidth(texture.width, level));
  const auto h = static_cast<int32_t>(levelWidth(texture.height, level));
  // Level-0 texels scaled down, so that every level agrees on where a painted point is.
  const float scale = 1.0f / static_cast<float>(1u << level);
  const float x = u * static_cast<float>(texture.width) * scale - 0.5f;
  const float y = v * static_cast<float>(texture.height) * scale - 0.5f;
  const auto x256 = static_cast<int32_t>(std::clamp(x, 0.0f, static_cast<float>(w - 1)) * 256.0f);
  const auto y256 = static_cast<int32_t>(std::clamp(y, 0.0f, static_cast<float>(h - 1)) * 256.0f);
  const int32_t x0 = x256 >> 8, y0 = y256 >> 8;
  const int32_t x1 = std::min(x0 + 1, w - 1);
  const Texel *row0 = texels_.get() + texture.offset[level] + static_cast<size_t>(y0) * static_cast<size_t>(w);
  const Texel *row1 = y0 + 1 < h ? row0 + w : row0;
  const auto fx = static_cast<uint32_t>(x256 & 255), fy = static_cast<uint32_t>(y256 & 255);
  return gather(mix(mix(spread(row0[x0]), spread(row0[x1]), fx), mix(spread(row1[x0]), spread(row1[x1]), fx), fy));
}

}  // namespace sphc::simulated
