// The camera of a wanted model that comes nearest to given pixels, by least squares over the image.
#pragma once
#include <string>
#include <vector>

#include "runtime/geometry/camera.h"

namespace sphc::host {

struct RaySample {
  Vector2 ray;  // x / z, y / z
  Vector2 pixel_px;
};
// On a grid over the image, where the camera sees at all.
std::vector<RaySample> sampleCamera(const sphc_camera &camera);
// Share of the image, 0 to 1, where it does not: the distortion turns back, or it is 89 degrees and more off axis.
double shareWithoutRay(const sphc_camera &camera);
// That, and the cure, for people; empty where it is less than a hundredth.
std::string doubtOfField(const sphc_camera &camera);

// A model whose parameters behind the first `free_params` stay 0.
struct WantedModel {
  sphc_camera_model model;
  uint32_t free_params;
};

struct NearestCamera {
  sphc_camera camera;
  double largest_px, rms_px;
};
// `start` gives the image size and the first guess.  `samples` not empty.
NearestCamera nearestCamera(const std::vector<RaySample> &samples, WantedModel wanted, const sphc_camera &start);

}  // namespace sphc::host
