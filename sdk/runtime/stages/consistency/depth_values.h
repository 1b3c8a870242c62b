// What the measurements of one depth image say of the sensor, the colour image left out.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/geometry/camera.h"
#include "runtime/types/depth_sensor.h"
#include "runtime/types/image_view.h"

namespace sphc {

struct DepthValues {
  static constexpr uint32_t kMostDistinct = 8;
  uint32_t samples = 0;
  uint32_t measured = 0;  // not 0
  uint32_t in_range = 0;  // of these
  uint32_t distinct = 0;  // different measurements in range, counted up to kMostDistinct
  uint32_t slanted = 0;   // places of a smooth surface that is slanted to the view
  // Their median bend, without corners: second differences of the inverse depth times the inverse depth, over its
  // squared slope.  The inverse depth of a plane is linear in the rays, so 0; 2 where the values are inverse
  // depths, more where they are a constant less the depth.
  double bend = 0;
};

// Reads a grid of samples.
class DepthSamples {
 public:
  static constexpr int32_t kColumns = 40, kRows = 30;
  static constexpr size_t kCount = size_t{kColumns} * kRows;

  static void layout(Arena &state, DepthSamples *samples);
  // After layout with memory: makes the table of rays.  `is_range`: the sensor measures distances from its centre,
  // of which the images hold z.
  void init(const Camera &camera, const DepthSensor &sensor, bool is_range);
  DepthValues look(ImageView<uint16_t> depth);
  // Measurements of the last look, row by row; 0 where there is none.
  Span<const uint16_t> values() const { return values_; }

 private:
  struct Ray {
    float x, y;
  };
  uint32_t asMeasured(uint16_t z, size_t at) const;
  void addBend(int32_t column, int32_t row, DepthValues *found);
  // Over `reach` pixels to each side.
  float smoothInverse(ImageView<uint16_t> depth, int32_t x, int32_t y, int32_t reach) const;
  bool isSmooth(size_t at, size_t step) const;

  DepthSensor sensor_ = {};
  bool is_range_ = false;
  Span<Ray> rays_;
  Span<uint16_t> values_;
  Span<float> inverse_;  // 1 / m; 0 where there is no measurement in range
  Span<float> bends_;
};

}  // namespace sphc
