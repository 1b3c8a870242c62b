// Validation of what comes through the C interface.
#pragma once
#include "runtime/localizer/config.h"
#include "runtime/localizer/map_set.h"
#include "runtime/types/depth_calibration.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

// Copies of what the caller gave, of any version (growth.h), and whether it can be used.
// `config.cameras` and `config.depth_cameras` of the copy are its own.
struct ConfigCopy {
  sphc_localizer_config config;
  sphc_localizer_camera cameras[SPHC_CAMERAS_MAX - 1];
  sphc_localizer_depth_camera depth_cameras[SPHC_DEPTH_CAMERAS_MAX - 1];
};
sphc_status readConfig(const sphc_localizer_config *config, ConfigCopy *copy, sphc_message *message);
sphc_status readAlignerConfig(const sphc_aligner_config *config, sphc_aligner_config *copy, sphc_message *message);
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
sphc_status checkPlacement(const sphc_rigid &common_from_map, double rotation_sigma_rad, double translation_sigma_m,
                           sphc_message *message);
// Can a localizer of this prior go on from what was learnt of its depth sensor?
sphc_status checkDepthBias(const sphc_depth_bias *depth, const DepthCalibration &prior, sphc_message *message);
// The format that a depth image must have, and the field of the config that says so; 0 for colour or grey.
struct DepthWanted {
  sphc_format format = 0;
  const char *field = "";
};
// Does an image fit its camera?  `name` is that of the image.
sphc_status checkImage(const char *name, const sphc_image &image, const sphc_camera &camera,
                       const DepthWanted &wanted, sphc_message *message);
// The answer of a function that ends in _memory.
sphc_status giveMemory(const sphc_memory &need, sphc_memory *memory, sphc_message *message);
// Is memory there, aligned and large enough?  `what` names it in the message.
sphc_status checkMemory(const void *memory, size_t bytes, size_t needed, size_t alignment, const char *what,
                        sphc_message *message);
// Were features made for a localizer of this image size and room?
sphc_status checkFeatures(const sphc_features &features, const sphc_localizer &localizer, sphc_message *message);
// What the library writes to must not be read as something else.
struct MemoryRange {
  const char *name;
  const void *begin;
  size_t bytes;
};
sphc_status checkApart(const MemoryRange &written, const MemoryRange &other, sphc_message *message);
// Is it apart from a map's view and file?
sphc_status checkApartFromMap(const MemoryRange &written, const sphc_map &map, sphc_message *message);

}  // namespace sphc
