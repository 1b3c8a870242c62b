// raster.h - what each ray of a camera sees.  The image is cut into tiles; for each tile the solids that may appear
// in it are listed once, nearest first, so that a ray meets a handful of them.
#pragma once

#include <memory>
#include <vector>

#include "drivers/simulated/lanes.h"
#include "drivers/simulated/lens.h"
#include "drivers/simulated/scene.h"
#include "drivers/simulated/vec.h"

namespace sphc::simulated {

constexpr uint32_t kTile = 16;

struct Hit {
  float z = kFar;  // depth along the camera's axis; of what is seen in a mirror, of its image behind the glass
  uint32_t shape = 0;
  uint32_t portal = 0;  // the shape is seen through portal - 1; 0: straight
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
// world_from_camera of each lane: moments of one exposure, or one moment four times.
struct Poses {
  Pose lane[kLanes];
};
inline Poses posesOf(const Pose &pose) { return {{pose, pose, pose, pose}}; }

class Raster {
 public:
  // `shapes`: the scene's, where they are at this moment.  Borrows all but the poses.
  Raster(const Scene &scene, const std::vector<Shape> &shapes, const sphc_camera &camera, const RayTable &rays,
         const Poses &poses);

  uint32_t tileRows() const { return (height_ + kTile - 1) / kTile; }
  // What may appear in a tile: straight, and through each portal.
  struct List {
    std::vector<uint32_t> straight;
    std::vector<std::vector<uint32_t>> beyond;
  };
  // Calls pixel(column, row, list) for each pixel of one row of tiles.
  template <class Pixel>
  void forTileRow(uint32_t tile_row, const Pixel &pixel) const {
    forRows(tile_row * kTile, std::min((tile_row + 1) * kTile, height_), pixel);
  }
  // The same for the rows from `top` to before `bottom`, a row of tiles at most.
  template <class Pixel>
  void forRows(uint32_t top, uint32_t bottom, const Pixel &pixel) const {
    List list;
    list.straight.reserve(shapes_.size());
    list.beyond.resize(beyond_.size());
    for (uint32_t left = 0; left < width_; left += kTile) {
      const uint32_t right = std::min(left + kTile, width_);
      gatherAll(left, top, right, bottom, list);
      for (uint32_t row = top; row < bottom; ++row) {
        for (uint32_t column = left; column < right; ++column) pixel(column, row, list);
      }
    }
  }
  Hits cast(const List &list, const Rays &rays) const;
  Seen look(const Hit &hit, uint32_t lane, const Ray2 &ray) const;

 private:
  // What one portal shows, from where it shows it; it has no portals of its own.
  struct Beyond {
    uint32_t shape;
    std::unique_ptr<Raster> raster;
  };
  Raster(const TexturePool &pool, const std::vector<Shape> &shapes, const sphc_camera &camera, const RayTable &rays,
         const Poses &poses);
  // Where a shape may appear: a rectangle of the plane z = 1, and its least depth.
  struct Extent {
    float x0, y0, x1, y1, z;
    uint32_t shape;
  };
  void gather(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom, std::vector<uint32_t> &list) const;
  void gatherAll(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom, List &list) const;
  // What each lane meets beyond its own `from`.
  Hits castStraight(const std::vector<uint32_t> &list, const Rays &rays, Float4 from) const;
  void measure();
  // Of a shape: the ray (x, y, 1) of each lane's camera in its unit space.
  struct Local {
    Vec4 origin, x, y, z;
  };
  static Local localOf(const Shape &shape, const Poses &poses);
  LocalRay local(uint32_t shape, uint32_t lane, const Ray2 &ray) const;
  void meet(uint32_t shape, const Rays &rays, Float4 x, Float4 y, Float4 from, Hits &hits, Float4 &nearest) const;

  const TexturePool &pool_;
  const std::vector<Shape> &shapes_;
  const RayTable &rays_;
  uint32_t width_, height_;
  Pose cut_;  // the pose by which tiles are cut
  std::vector<Local> locals_;
  std::vector<Extent> extents_;  // nearest first; the room is not among them
  std::vector<Beyond> beyond_;
};

}  // namespace sphc::simulated
