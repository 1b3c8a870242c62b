// raster.h - what each ray of a camera sees.  The image is cut into tiles; for each tile the solids that may appear
// in it are listed once, nearest first, so that a ray meets a handful of them.
#pragma once

#include <array>
#include <vector>

#include "drivers/simulated/lens.h"
#include "drivers/simulated/scene.h"
#include "drivers/simulated/vec.h"

namespace sphc::simulated {

constexpr uint32_t kTile = 16;

struct View {
  Pose world_from_camera;
  // Of each shape: the ray (x, y, 1) of the camera in its unit space.
  struct Local {
    Vec3f origin, x, y, z;
  };
  std::vector<Local> locals;
};
View makeView(const Scene &scene, const Pose &world_from_camera);

struct Hit {
  float z = kFar;  // depth along the camera's axis
  uint32_t shape = 0;
};

// Where and at what angle a hit lies on its face.
struct Seen {
  const Texture *texture;
  float u, v;
  float cosine;  // between the ray and the surface's normal
};

class Raster {
 public:
  // `views` are one or more moments of one exposure; the first serves to cut the tiles.  Borrows all but `views`.
  Raster(const Scene &scene, const sphc_camera &camera, const RayTable &rays, std::vector<View> views);

  uint32_t tileRows() const { return (height_ + kTile - 1) / kTile; }
  // Calls pixel(column, row, list) for each pixel of one row of tiles.
  using List = std::vector<uint32_t>;
  template <class Pixel>
  void forTileRow(uint32_t tile_row, const Pixel &pixel) const {
    List list;
    list.reserve(scene_.shapes.size());
    const uint32_t bottom = std::min((tile_row + 1) * kTile, height_);
    for (uint32_t left = 0; left < width_; left += kTile) {
      const uint32_t right = std::min(left + kTile, width_);
      gather(left, tile_row * kTile, right, bottom, list);
      for (uint32_t row = tile_row * kTile; row < bottom; ++row) {
        for (uint32_t column = left; column < right; ++column) pixel(column, row, list);
      }
    }
  }
  Hit cast(const List &list, uint32_t view, const Ray2 &ray) const;
  Seen look(const Hit &hit, uint32_t view, const Ray2 &ray) const;

 private:
  // Where a shape may appear: a rectangle of the plane z = 1, and its least depth.
  struct Extent {
    float x0, y0, x1, y1, z;
    uint32_t shape;
  };
  void gather(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom, List &list) const;
  void measure();
  LocalRay local(uint32_t shape, uint32_t view, const Ray2 &ray) const {
    const View::Local &l = views_[view].locals[shape];
    return {l.origin, l.x * ray.x + l.y * ray.y + l.z};
  }

  const Scene &scene_;
  const RayTable &rays_;
  uint32_t width_, height_;
  std::vector<View> views_;
  std::vector<Extent> extents_;  // nearest first; the room is not among them
};

}  // namespace sphc::simulated
