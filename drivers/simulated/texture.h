// texture.h - painted faces in one pool of memory, each with its pyramid, and the sampling of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
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
  // Fills level 0 of the texture of this index.
  using Paint = std::function<void(uint32_t index, const Texture &texture, Texel *texels)>;

  // Makes room for a texture and its pyramid.  Returns its index.
  uint32_t add(float width_m, float height_m, float texel_m);
  // Once after all `add`s.  Throws std::bad_alloc.
  void allocate(Paint paint);
  // To be sampled.  Whoever asks for it first paints it, while others who want the same one wait.
  const Texture &painted(uint32_t index) const;

  const Texture &texture(uint32_t index) const { return textures_[index]; }
  uint32_t size() const { return static_cast<uint32_t>(textures_.size()); }
  // Bilinear in one level (clamped to those there are) of a painted texture; u and v in [0, 1].
  Texel sample(const Texture &texture, float u, float v, int level) const;

 private:
  struct Painted;
  struct Free {
    void operator()(Texel *texels) const { std::free(texels); }
  };
  void paint(uint32_t index) const;
  // Fills levels 1 and up from level 0.
  void buildPyramid(const Texture &texture) const;

  std::vector<Texture> textures_;
  size_t total_ = 0;
  Paint paint_;
  std::shared_ptr<Painted[]> painted_;     // of each texture
  std::unique_ptr<Texel[], Free> texels_;  // memory that the system gives where something is painted
};

}  // namespace sphc::simulated
