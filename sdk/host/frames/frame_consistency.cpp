#include "host/frames/frame_consistency.h"

#include "host/frames/frame_images.h"
#include "host/frames/heap_arena.h"

namespace sphc::host {
namespace {

ConsistencyConfig configOf(const sphc_rig &calibration, double depth_min_m, double depth_max_m) {
  ConsistencyConfig config;
  config.color_camera = Camera(calibration.color_camera);
  config.depth_camera = Camera(calibration.depth_camera);
  config.depth_sensor.unit_m = calibration.depth_unit_m;
  config.depth_sensor.min_m = depth_min_m;
  config.depth_sensor.max_m = depth_max_m;
  config.follows = true;
  return config;
}

}  // namespace

FrameConsistency::FrameConsistency(const sphc_rig &calibration, double depth_min_m, double depth_max_m)
    : color_from_depth_(rigidFromC(calibration.color_from_depth)) {
  Arena state_size, scratch_size;
  Consistency::layout(state_size, scratch_size, nullptr);
  Arena state = heapFor(state_size, &state_), scratch = heapFor(scratch_size, &scratch_);
  Consistency::layout(state, scratch, &consistency_);
  consistency_.init(configOf(calibration, depth_min_m, depth_max_m));
}

Faults FrameConsistency::look(const sphc_image &color, int64_t color_time_ns, const sphc_image &depth,
                              int64_t depth_time_ns, const Rigid &camera_from_camera_at_depth) {
  return consistency_.look({grayOf(color, &gray_), depthOf(depth), camera_from_camera_at_depth * color_from_depth_,
                            color_time_ns, depth_time_ns});
}

}  // namespace sphc::host
