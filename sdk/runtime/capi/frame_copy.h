// Copies of the frames that a caller gave, of any version (growth.h), where they can be used.
#pragma once
#include "runtime/localizer/config.h"
#include "runtime/localizer/map_set.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

// What a frame must fit.
struct FrameLimits {
  bool looks_at_images;  // of the colour camera and of further ones
  const LocalizerConfig &config;
  const sphc_format *depth_formats;  // of each of config.depth
  const MapSet &maps;
  bool has_clock;
};
// What is copied points to the others, where the caller gave some.
struct FrameCopy {
  sphc_localizer_frame frame;
  sphc_localizer_prior prior;
  sphc_localizer_view views[SPHC_CAMERAS_MAX - 1];
  sphc_localizer_depth_view depth_views[SPHC_DEPTH_CAMERAS_MAX - 1];
};
sphc_status readFrame(const sphc_localizer_frame *frame, const FrameLimits &limits, FrameCopy *copy,
                      sphc_message *message);
// Of a frame, what its features are made of: the images but depth.
sphc_status readFeatureFrame(const sphc_localizer_frame *frame, const FrameLimits &limits, FrameCopy *copy,
                             sphc_message *message);
// Of a frame, the colour image.
sphc_status readColorFrame(const sphc_localizer_frame *frame, const sphc_camera &color, sphc_localizer_frame *copy,
                           sphc_message *message);

}  // namespace sphc
