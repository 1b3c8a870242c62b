// Depth at a pixel from the measurements around it.
#pragma once
#include "runtime/types/depth_sensor.h"
#include "runtime/types/image_view.h"

namespace sphc {

struct PatchDepth {
  double depth_m = 0;  // 0: none
  double sigma_m = 0;
};

// Fits a plane to the inverse depths (a plane in space is linear in them) of the (2 radius + 1)^2 pixels around
// (x, y), in array coordinates, keeping those close to the nearest valid one.  Averages noise where the surface is
// smooth; at a depth edge it keeps to the side of the centre, with a larger sigma.
PatchDepth patchDepth(ImageView<uint16_t> depth, const DepthSensor &sensor, double x, double y);

}  // namespace sphc
