// Copies of the configurations that a caller gave, of any version (growth.h), where they can be used.
#pragma once
#include "spherecloud/spherecloud.h"

namespace sphc {

// `config.cameras` and `config.depth_cameras` are its own.
struct ConfigCopy {
  sphc_localizer_config config;
  sphc_localizer_camera cameras[SPHC_CAMERAS_MAX - 1];
  sphc_localizer_depth_camera depth_cameras[SPHC_DEPTH_CAMERAS_MAX - 1];
};
sphc_status readConfig(const sphc_localizer_config *config, ConfigCopy *copy, sphc_message *message);
sphc_status readAlignerConfig(const sphc_aligner_config *config, sphc_aligner_config *copy, sphc_message *message);

}  // namespace sphc
