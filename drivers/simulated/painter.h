// painter.h - paint and light for the faces of a scene, one at a time and in any order.
#pragma once

#include <vector>

#include "drivers/simulated/bvh.h"
#include "drivers/simulated/scene.h"

namespace sphc::simulated {

// Keeps what it needs of the scene as it was built: shadows are those of what never moves.
class Painter {
 public:
  Painter(const Scene &scene, const std::vector<Job> &jobs);
  Painter(const Painter &) = delete;
  Painter &operator=(const Painter &) = delete;
  // Level 0 of a texture.  The same whenever it is called; for any number of threads.
  void paint(uint32_t index, const Texture &texture, Texel *texels) const;

 private:
  std::vector<Shape> shapes_, outdoors_, fixed_;
  Bvh bvh_;  // of fixed_
  FloorPlan plan_;
  Lighting lighting_;
  std::vector<Job> jobs_;  // of each texture
};

}  // namespace sphc::simulated
