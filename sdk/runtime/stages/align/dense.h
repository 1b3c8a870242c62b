// A whole depth image, seen from the colour camera.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "runtime/stages/align/kernels.h"
#include "runtime/types/depth_sensor.h"
#include "runtime/types/image_view.h"

namespace sphc {

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
  // Once, after layout with memory: makes the tables.  `kernels`: the scalar twin gives the same bits.
  void init(const DenseConfig &config, const AlignKernels &kernels = simdAlignKernels());
  // `depth` has the size of the depth camera's image.
  void process(ImageView<uint16_t> depth, const AlignedImages &out);

 private:
  struct Plane {
    Span<int32_t> keys;
    int32_t *row(int32_t y, int32_t stride) { return keys.data() + (y + 1) * int64_t{stride} + kRowPadding; }
  };
  void makeRays();
  void makeFootprints();
  void sense(ImageView<uint16_t> depth, int32_t y);
  void project(ImageView<uint16_t> depth, int32_t y);
  uint16_t beside(ImageView<uint16_t> depth, int32_t x, int32_t y, int32_t dx, int32_t dy) const;
  void castShadows(ImageView<uint16_t> depth, int32_t x, int32_t y);
  void castShadow(int32_t x, int32_t y, double near_m, double far_m);
  void markShadow(const Vector2 &px, double half_x, double half_y);
  void combine(int32_t y);
  void resolve(int32_t y, const AlignedImages &out);

  const float *rayRow(Span<float> rays, int32_t y) const {
    return rays.data() + y * int64_t{row_of_rays_} + kRowPadding;
  }
  float *sensedRow(int32_t y) { return sensed_.data() + (y % 3) * int64_t{ray_stride_} + kRowPadding; }
  int32_t *combinedRow(int32_t y) {
    return combined_.data() + ((y + 3) % 3) * int64_t{plane_stride_} + kRowPadding;
  }

  DenseConfig config_;
  const AlignKernels *kernels_ = nullptr;
  ProjectTask task_ = {};
  uint16_t low_ = 1, high_ = 65535;  // measurements in range
  int32_t depth_width_ = 0, depth_height_ = 0, width_ = 0, height_ = 0;
  int32_t ray_stride_ = 0, plane_stride_ = 0;

  int32_t row_of_rays_ = 0;  // stride of the rays; 0: without distortion x is the same in every row, y in a row
  Span<float> rays_x_, rays_y_;
  Span<uint8_t> half_x_, half_y_;
  Plane measured_, spread_;
  Span<float> sensed_;      // three rows of the depth image
  Span<int32_t> combined_;  // three rows of both planes together
  Span<int32_t> row_;       // ProjectedRow's arrays
  Span<int32_t> edges_;     // of it, apart as it is written in whole vectors
  ProjectedRow projected_ = {};
  Span<uint16_t> depth_row_;
  Span<uint8_t> mask_row_, confidence_row_;
};

}  // namespace sphc
