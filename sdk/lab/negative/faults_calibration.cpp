#include "lab/negative/fault.h"

namespace sphc::host {
namespace {

std::function<void(Sequence *)> shift(int axis, double metres) {
  return [axis, metres](Sequence *s) { s->rig.color_from_depth.t_m[axis] += metres; };
}

void scaleFocal(double factor, sphc_camera *camera) {
  camera->params[0] *= factor;
  camera->params[1] *= factor;
}

std::function<void(Sequence *)> focalOfColor(double factor) {
  return [factor](Sequence *s) { scaleFocal(factor, &s->rig.color_camera); };
}

std::function<void(Sequence *)> focalOfBoth(double factor) {
  return [factor](Sequence *s) {
    scaleFocal(factor, &s->rig.color_camera);
    scaleFocal(factor, &s->rig.depth_camera);
  };
}

}  // namespace

std::vector<SensorFault> calibrationFaults() {
  const uint32_t disagree = SPHC_FAULT_DEPTH_COLOR_DISAGREE | SPHC_FAULT_FOCAL_DISAGREES,
                 bias = disagree | SPHC_FAULT_DEPTH_BIAS;
  return {{"extrinsics 10 cm right", shift(0, 0.1), disagree, false, false},
          {"extrinsics 10 cm down", shift(1, 0.1), disagree, false, false},
          {"extrinsics 10 cm forward", shift(2, 0.1), bias, false, false},
          {"colour focal length + 10 %", focalOfColor(1.1), disagree, false, false},
          {"colour focal length - 10 %", focalOfColor(0.9), disagree, false, false},
          {"both focal lengths + 10 %", focalOfBoth(1.1), bias, false, false}};
}

}  // namespace sphc::host
