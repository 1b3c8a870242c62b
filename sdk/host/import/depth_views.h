// The depth images of a recording, made small, and where they were taken: how far each view sees along any ray.
#pragma once
#include <cstdint>
#include <vector>

#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "runtime/types/image_view.h"
#include "spherecloud/spherecloud.h"

namespace sphc::host {

// What one view measured where a point lies in it.
struct Sight {
  double depth_m;   // of the point, in the view
  double beyond_m;  // how much farther everything around its pixel is; -infinity where part of it has no depth
  double
      off_m;  // how far the nearest to it of what was measured around its pixel is off; infinity where nothing was
};

class DepthViews {
 public:
  static constexpr size_t kMost = 400;  // views that are kept, of 100 kB each at most

  DepthViews(const sphc_rig &rig, double depth_min_m, double depth_max_m);

  // Of more than kMost frames every second takes part, then every fourth, and so on: between half of kMost and
  // kMost.
  void add(ImageView<uint16_t> depth, const Rigid &world_from_camera);

  size_t count() const { return views_.size(); }
  Vector3 camera_m(size_t view) const { return views_[view].world_from_camera.translation_m; }
  std::vector<Matrix3> cameraFromWorld() const;
  // False where the point, in the world, is outside of the view.
  bool look(size_t view, const Vector3 &point_m, Sight *sight) const;

 private:
  // The nearest and the farthest measurement of a block of pixels, in the sensor's unit; both 0 where fewer than
  // half of them have one.
  struct Block {
    uint16_t nearest, farthest;
  };
  struct View {
    Rigid world_from_camera, depth_from_world;
    std::vector<Block> blocks;
  };
  Block blockOf(ImageView<uint16_t> depth, int32_t column, int32_t row) const;

  Camera camera_;
  Rigid depth_from_color_;
  double unit_m_;
  uint16_t least_, most_;  // a measurement, in the sensor's unit
  int32_t block_px_, columns_, rows_;
  uint32_t offered_ = 0, every_ = 1;
  std::vector<View> views_;
};

}  // namespace sphc::host
