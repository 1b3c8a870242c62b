// raster.h - what each ray of a camera sees.  The image is cut into tiles; for each tile the solids that may appear
// in it are listed once, nearest first, so that a ray meets a handful of them.
#pragma once

#include <array>
#include <vector>

#include "drivers/simulated/lanes.h"
#include "drivers/simulated/lens.h"
#include "drivers/simulated/scene.h"
#include "drivers/simulated/vec.h"

namespace sphc::simulated {

constexpr uint32_t kTile = 16;

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

// Rays are cast four at a time: four samples of a pixel, or four neighbours.
struct Hits {
  Hit lane[kLanes];
};
struct Rays {
  Ray2 lane[kLanes];
};

class Raster {
 public:
  // world_from_camera of each lane: moments of one exposure, or one moment four times.  Borrows all but the poses.
  Raster(const Scene &scene, const sphc_camera &camera, const RayTable &rays, const Pose (&poses)[kLanes]);

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
  Hits cast(const List &list, const Rays &rays) const;
  Seen look(const Hit &hit, uint32_t lane, const Ray2 &ray) const;

 private:
  // Where a shape may appear: a rectangle of the plane z = 1, and its least depth.
  struct Extent {
    float x0, y0, x1, y1, z;
    uint32_t shape;
  };
  void gather(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom, List &list) const;
  void measure();
  // Of a shape: the ray (x, y, 1) of each lane's camera in its unit space.
  struct Local {
    Vec4 origin, x, y, z;
  };
  static Local localOf(const Shape &shape, const Pose (&poses)[kLanes]);
  LocalRay local(uint32_t shape, uint32_t lane, const Ray2 &ray) const;
  void meet(uint32_t shape, const Rays &rays, Float4 x, Float4 y, Hits &hits, Float4 &nearest) const;

  const Scene &scene_;
  const RayTable &rays_;
  uint32_t width_, height_;
  Pose cut_;  // the pose by which tiles are cut
  std::vector<Local> locals_;
  std::vector<Extent> extents_;  // nearest first; the room is not among them
};

}  // namespace sphc::simulated
