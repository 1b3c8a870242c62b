// texture.h - painted faces in one pool of memory, each with its pyramid, and the sampling of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace sphc::simulated {

// A texel: red, green, blue as square roots of linear light (a gamma of 2), and reflectance at the ToF camera's
// wavelength in the top byte.
using Texel = uint32_t;

struct Texture {
  static constexpr int kMaxLevels = 13;
  uint32_t width = 0, height = 0;  // of level 0
  int levels = 0;
  float texel_m = 0;  // size of a texel of level 0, the larger of the two directions
  size_t offset[kMaxLevels] = {};
};

class TexturePool {
 public:
  // Makes room for a texture and its pyramid; contents are zero.  Returns its index.
  uint32_t add(float width_m, float height_m, float texel_m);
  // Once after all `add`s.
  void allocate() { texels_.assign(total_, 0); }
  Texel *texels(uint32_t index) { return texels_.data() + textures_[index].offset[0]; }
  // Fills levels 1 and up from level 0.
  void buildPyramid(uint32_t index);

  const Texture &texture(uint32_t index) const { return textures_[index]; }
  uint32_t size() const { return static_cast<uint32_t>(textures_.size()); }
  size_t bytes() const { return texels_.size() * sizeof(Texel); }
  // Trilinear; u and v in [0, 1]; `level` is the base-2 logarithm of the footprint in texels of level 0.
  Texel sample(const Texture &texture, float u, float v, float level) const;
  // The nearest texel of level round(level).
  Texel nearest(const Texture &texture, float u, float v, float level) const;

 private:
  uint64_t bilinear(const Texture &texture, int level, float u, float v) const;

  std::vector<Texture> textures_;
  std::vector<Texel> texels_;
  size_t total_ = 0;
};

}  // namespace sphc::simulated
