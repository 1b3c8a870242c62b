// A whole depth image, seen from the colour camera.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "runtime/stages/align/kernels.h"
#include "runtime/types/depth_sensor.h"
#include "runtime/types/image_view.h"

namespace sphc {

// In units of the aligned image: the farthest measurement, of the sixteen bits that also hold how far noise takes
// it and what is empty; and what a pixel may hold at the most.
constexpr double kMostMeasuredUnits = 62000;
constexpr float kMostAlignedUnits = 63000;

struct DenseConfig {
  Camera color, depth;
  Rigid color_from_depth;
  DepthSensor sensor;
  double out_unit_m = 0.001;
};

// Where the pixels go; each may be null.  Strides in elements.
struct AlignedImages {
  uint16_t *depth = nullptr;
  uint8_t *mask = nullptr, *confidence = nullptr;
  int64_t depth_stride = 0, mask_stride = 0, confidence_stride = 0;
};

// Forward projection into a z-buffer.  Every measurement falls into one colour pixel; where the colour image is the
// denser, it is also spread over its footprint; cracks are closed between pixels of one surface; what lies behind
// the edge of something near is marked as hidden from the depth camera.
class DenseAligner {
 public:
  // `aligner` is null while measuring.
  static void layout(const DenseConfig &config, Arena &arena, DenseAligner *aligner);
  // Once, after layout with memory: makes the tables.  `kernels`: the scalar version gives the same bits.
  void init(const DenseConfig &config, const AlignKernels &kernels = simdAlignKernels());
  // `depth` has the size of the depth camera's image.
  void process(ImageView<uint16_t> depth, const AlignedImages &out);

 private:
  struct Plane {
    Span<int32_t> keys;  // kEmpty between frames
    int32_t *row(int32_t y, int32_t stride) const { return keys.data() + (y + 1) * int64_t{stride} + kRowPadding; }
  };
  void makeRays();
  void makeTask();
  void makeFootprints();
  void makeSides();
  void sense(ImageView<uint16_t> depth, int32_t y);
  void project(ImageView<uint16_t> depth, int32_t y, bool with_shadows);
  RowToProject rowToProject(int32_t y);
  Vector2 rayOf(int32_t x, int32_t y) const;
  // From a ray to the colour camera, in the plane of the rays, times its depth.
  Vector2 towardColor(const Vector2 &ray) const {
    return {center_m_.x() - center_m_.z() * ray.x(), center_m_.y() - center_m_.z() * ray.y()};
  }
  uint16_t beside(const uint16_t *pixel, int64_t step, int32_t steps) const;
  void castShadows(const ImageView<uint16_t> &depth, int32_t y, const int32_t *columns, int32_t count);
  void castShadow(const Vector2 &ray, size_t at, double near_m, double far_m);
  void markShadow(const Vector2 &px, const Vector2 &half);
  void decode(int32_t y);
  void resolve(int32_t y, const AlignedImages &out);

  uint16_t *sensedRow(int32_t y) { return sensed_.data() + (y + 3) % 3 * int64_t{ray_stride_} + kRowPadding; }
  DecodedRow decodedRow(int32_t y) {
    const int64_t at = (y + 3) % 3 * int64_t{plane_stride_} + kRowPadding;
    return {decoded_depth_.data() + at, decoded_state_.data() + at};
  }

  DenseConfig config_;
  const AlignKernels *kernels_ = nullptr;
  ProjectTask task_ = {};
  Vector2 per_focal_ = Vector2::Zero();  // of the depth camera, 1 / px
  Vector3 center_m_ = Vector3::Zero();   // of the colour camera, depth frame
  uint16_t low_ = 1, high_ = 65535;      // measurements in range; none where low is beyond high
  int32_t depth_width_ = 0, depth_height_ = 0, width_ = 0, height_ = 0;
  int32_t ray_stride_ = 0, plane_stride_ = 0;

  Span<float> rays_x_, rays_y_;  // of a depth camera with distortion; without, turned_ has all but a row's offset
  Span<float> turned_;           // three rows: of x, y, z
  Span<uint8_t> half_x_, half_y_;
  Span<uint8_t> sides_;  // SensedRows'
  Plane measured_, spread_;
  Span<uint16_t> sensed_;                         // three rows of the depth image
  Span<uint16_t> slope_;                          // of the middle one
  Span<uint16_t> decoded_depth_, decoded_state_;  // three rows of the colour image
  Span<int32_t> row_;                             // ProjectedRow's arrays
  Span<int32_t> edges_;
  ProjectedRow projected_ = {};
  Span<uint16_t> depth_row_;
  Span<uint8_t> mask_row_, confidence_row_;
};

}  // namespace sphc
