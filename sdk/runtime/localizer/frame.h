// What a localizer is given for each frame: images, and what the caller knows before they are processed.
#pragma once
#include <optional>

#include "runtime/localizer/config.h"
#include "runtime/types/image_view.h"
#include "runtime/types/pose_prior.h"

namespace sphc {

// The device's own dead reckoning: where the camera is in a frame that drifts.
struct Odometry {
  Rigid odometry_from_camera;
  double rotation_sigma_rad = 0, translation_sigma_m = 0;  // 1 sigma an axis, of the step from the frame before
  double scale_sigma = 0;                                  // of all shifts, as a share of them
};

struct Known {
  PosePrior prior;
  uint32_t map = 0;  // slot of the map whose frame the prior's pose and vertical are in
  bool has_odometry = false;
  Odometry odometry;
};

// The image of one of the further cameras; without bytes it has none in this frame.
struct FurtherView {
  ColorView image;
  int64_t time_ns = 0;  // mid-exposure
  // As they are in this frame, where they are not as in the config.
  std::optional<Camera> camera;
  std::optional<Rigid> color_from_camera;
};
using FurtherViews = FixedVector<FurtherView, kMostCameras - 1>;  // in the order of the cameras

// Whose images the features of a frame are of: bit i is the i-th of the further cameras.
using SeenCameras = uint32_t;
constexpr SeenCameras seenBit(size_t further) { return SeenCameras{1} << further; }

// The image of a depth camera, of its layout; without bytes it has none in this frame.
struct DepthView {
  ByteView depth;
  AmplitudeView amplitude;
  int64_t time_ns = 0;  // mid-exposure
  // As they are in this frame, where they are not as in the config.
  std::optional<Camera> camera;
  std::optional<Rigid> color_from_depth;
};
using DepthViews = FixedVector<DepthView, kMostDepthCameras>;  // in the order of the cameras

// Everything is borrowed.
struct FrameInput {
  int64_t color_time_ns = 0;  // mid-exposure
  ColorView color;
  std::optional<Camera> color_camera;  // as it is in this frame, where it is not as in the config
  FurtherViews further;                // none, or one of each camera
  DepthViews depth;                    // one of each depth camera
  Known known;
  int64_t time_limit_ns = 0;  // from the beginning of its processing; 0: none
};

}  // namespace sphc
