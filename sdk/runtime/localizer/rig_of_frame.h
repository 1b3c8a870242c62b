// A rig's cameras where they stood when the colour image of a frame was taken, as far as odometry tells.
#pragma once
#include "runtime/localizer/between_images.h"
#include "runtime/localizer/frame.h"
#include "runtime/localizer/front_end.h"
#include "runtime/localizer/tracker.h"

namespace sphc {

struct RigOfFrame {
  FrameRig cameras;
  BetweenImages between;              // colour and all images that are there, and rows of a rolling shutter
  BetweenImages between_first_depth;  // colour and the first depth image
};

// Each frame, after the tracker has advanced to it.  Without a tracker (null) nothing tells how the camera came
// from image to image.  `rate`: how it moves while rows are exposed.  `seen`: images of further cameras may be gone
// by now.
RigOfFrame rigOfFrame(const LocalizerConfig &config, const FrameInput &frame, SeenCameras seen,
                      const Tracker *tracker, const CameraRate &rate);

}  // namespace sphc
