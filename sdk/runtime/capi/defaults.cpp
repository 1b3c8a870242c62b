#include "runtime/capi/defaults.h"

namespace sphc {

sphc_localizer_config defaultConfig() {
  sphc_localizer_config config = {};
  config.struct_size = sizeof config;
  config.max_keypoints = 800;
  config.max_maps = 16;
  sphc_rig_init(&config.rig);
  config.depth_min_m = 0.25;
  config.depth_max_m = 6;
  config.depth_sigma_m = 0.004;
  config.depth_sigma_per_m2 = 0.002;
  config.pixel_sigma_px = 0.8;
  config.map_sigma_m = 0.004;
  config.depth_offset_sigma_m = 0.003;
  config.depth_slope_sigma = 0.02;
  config.log_level = SPHC_LOG_INFO;
  return config;
}

sphc_aligner_config defaultAlignerConfig() {
  const sphc_localizer_config localizer = defaultConfig();
  sphc_aligner_config config = {};
  config.struct_size = sizeof config;
  config.rig = localizer.rig;
  config.depth_min_m = localizer.depth_min_m;
  config.depth_max_m = localizer.depth_max_m;
  config.depth_sigma_m = localizer.depth_sigma_m;
  config.depth_sigma_per_m2 = localizer.depth_sigma_per_m2;
  return config;
}

sphc_localizer_camera emptyCamera() {
  sphc_localizer_camera camera = {};
  camera.struct_size = sizeof camera;
  camera.color_from_camera.q_wxyz[0] = 1;
  return camera;
}

sphc_localizer_depth_camera emptyDepthCamera() {
  const sphc_localizer_config config = defaultConfig();
  sphc_localizer_depth_camera camera = {};
  camera.struct_size = sizeof camera;
  camera.color_from_depth = config.rig.color_from_depth;
  camera.unit_m = config.rig.depth_unit_m;
  camera.min_m = config.depth_min_m;
  camera.max_m = config.depth_max_m;
  camera.sigma_m = config.depth_sigma_m;
  camera.sigma_per_m2 = config.depth_sigma_per_m2;
  camera.offset_sigma_m = config.depth_offset_sigma_m;
  camera.slope_sigma = config.depth_slope_sigma;
  return camera;
}

sphc_localizer_result emptyResult() {
  sphc_localizer_result result = {};
  result.map_id = SPHC_MAP_NONE;
  result.camera_from_map.q_wxyz[0] = 1;
  return result;
}

sphc_localizer_prior emptyPrior() {
  sphc_localizer_prior prior = {};
  prior.camera_from_map.q_wxyz[0] = prior.odometry_from_camera.q_wxyz[0] = 1;
  return prior;
}

sphc_localizer_prediction emptyPrediction() {
  sphc_localizer_prediction prediction = {};
  prediction.map_id = SPHC_MAP_NONE;
  prediction.camera_from_map.q_wxyz[0] = 1;
  return prediction;
}

}  // namespace sphc
