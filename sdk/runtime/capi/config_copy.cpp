#include "runtime/capi/config_copy.h"

#include <algorithm>

#include "runtime/base/message.h"
#include "runtime/base/parallel.h"
#include "runtime/capi/check.h"
#include "runtime/capi/defaults.h"
#include "runtime/capi/format.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/translate.h"
#include "runtime/stages/align/dense.h"

namespace sphc {
namespace {

constexpr double kMostAmplitude = 65535;

bool configInRange(const char *name, double value, double low, double high, sphc_message *message) {
  return inRange("config.", name, value, low, high, message);
}

// A config's; forgotten, it is the first thing to say.
sphc_status checkRig(const sphc_rig &rig, sphc_message *message) {
  if (rig.color_camera.model || rig.depth_camera.model) return sphc_rig_check(&rig, message);
  MessageWriter(message)
      << "config.rig is not set, neither of its cameras has a model; give the calibration of the "
         "headset";
  return SPHC_E_ARGUMENT;
}

// What every depth camera has; so the names of its fields begin.
constexpr const char *kDepthFields = "config.depth_", *kFurtherDepthFields = "config.depth_cameras[i].";

// 1 sigma of a bias: both known, or none.
bool checkBias(const char *owner, double offset_sigma_m, double slope_sigma, sphc_message *message) {
  if (!inRange(owner, "offset_sigma_m", offset_sigma_m, 0, 1, message) ||
      !inRange(owner, "slope_sigma", slope_sigma, 0, 0.5, message))
    return false;
  const bool known = offset_sigma_m == 0 && slope_sigma == 0;
  if (known || (offset_sigma_m >= kLeastSigma && slope_sigma >= kLeastSigma)) return true;
  MessageWriter(message) << owner << "offset_sigma_m and " << owner
                         << "slope_sigma must both be 1e-6 or more, or both 0 for a sensor without bias";
  return false;
}

// Can the camera have images of this format, and is what is said of its measurements possible?
bool checkDepth(const char *owner, sphc_format configured, uint32_t width, const DepthSensor &sensor,
                sphc_message *message) {
  if (!inRange(owner, "min_m", sensor.min_m, 0.01, 100, message) ||
      !inRange(owner, "max_m", sensor.max_m, sensor.min_m + 0.01, 200, message) ||
      !inRange(owner, "sigma_m", sensor.sigma_m, 1e-5, 1, message) ||
      !inRange(owner, "sigma_per_m2", sensor.sigma_per_m2, 0, 1, message))
    return false;
  const PixelFormat format = pixelFormatOf(depthFormatOf(configured));
  if (!format.is_depth) {
    MessageWriter(message) << owner << "format is " << configured
                           << ", which is not of depth; give a DEPTH or RANGE format, or 0 for DEPTH16";
    return false;
  }
  if (width % format.group_pixels) {
    MessageWriter(message) << owner << "format is " << configured << ", of which " << format.group_pixels
                           << " pixels share bytes, but the depth camera's width is " << width
                           << "; give a format or a width that fit each other";
    return false;
  }
  const double farthest_m = 65535 * sensor.unit_m;
  if (format.depth.kind != DepthLayout::kMetres || sensor.max_m <= farthest_m) return true;
  MessageWriter(message) << owner << "max_m is " << sensor.max_m << ", but 16 bits of the depth unit reach "
                         << farthest_m << " m, and depth in metres is rounded to it; raise the unit or lower the "
                         << "range";
  return false;
}

bool checkNumbers(const sphc_localizer_config &c, sphc_message *message) {
  return configInRange("max_keypoints", c.max_keypoints, 64, 4096, message) &&
         configInRange("max_maps", c.max_maps, 1, SPHC_MAPS_MAX, message) &&
         configInRange("pixel_sigma_px", c.pixel_sigma_px, 0.01, 20, message) &&
         configInRange("map_sigma_m", c.map_sigma_m, 0, 1, message) &&
         configInRange("depth_mid_m", c.depth_mid_m, 0, 200, message) &&
         checkBias(kDepthFields, c.depth_offset_sigma_m, c.depth_slope_sigma, message) &&
         configInRange("amplitude_min", c.amplitude_min, 0, kMostAmplitude, message) &&
         configInRange("color_row_time_ns", static_cast<double>(c.color_row_time_ns), -SPHC_ROW_TIME_MAX_NS,
                       SPHC_ROW_TIME_MAX_NS, message) &&
         configInRange("color_band", c.color_band, SPHC_BAND_VISIBLE, SPHC_BAND_INFRARED, message) &&
         configInRange("mode", c.mode, SPHC_MODE_TRACKING, SPHC_MODE_SINGLE, message) &&
         (!c.log || configInRange("log_level", c.log_level, SPHC_LOG_ERROR, SPHC_LOG_DEBUG, message));
}

static_assert(SPHC_PARALLEL_MAX == Parallel::kMostPieces);

bool checkParallel(const sphc_localizer_config &c, sphc_message *message) {
  if (c.parallel) return configInRange("parallel_tasks", c.parallel_tasks, 1, SPHC_PARALLEL_MAX, message);
  if (!c.parallel_tasks) return true;
  MessageWriter(message) << "config.parallel_tasks is " << c.parallel_tasks
                         << ", but config.parallel is null; give it a function that runs tasks, or set "
                            "parallel_tasks to 0";
  return false;
}

// An array of the config: `count` elements, at most `most`, and null where there are none.
sphc_status checkArray(const char *name, const void *array, uint32_t count, uint32_t most, sphc_message *message) {
  if (count <= most && (count > 0) == (array != nullptr)) return SPHC_OK;
  MessageWriter(message) << "config." << name << "_count is " << count << ", and config." << name << "s is "
                         << (array ? "not null" : "null") << "; give an array of 1 to " << most
                         << " further cameras, or 0 and null";
  return SPHC_E_ARGUMENT;
}

sphc_status readCameras(ConfigCopy *copy, sphc_message *message) {
  sphc_localizer_config &config = copy->config;
  sphc_status status = checkArray("camera", config.cameras, config.camera_count, SPHC_CAMERAS_MAX - 1, message);
  if (status != SPHC_OK) return status;
  std::fill_n(copy->cameras, SPHC_CAMERAS_MAX - 1, emptyCamera());
  status = readStructs("config.cameras", config.cameras, config.camera_count, copy->cameras, message);
  if (status != SPHC_OK) return status;
  if (config.cameras) config.cameras = copy->cameras;
  for (uint32_t i = 0; i < config.camera_count; ++i) {
    const sphc_localizer_camera &own = copy->cameras[i];
    sphc_message found;
    if (!checkCamera(own.camera, "config.cameras[i].camera", &found) ||
        !checkMount("config.cameras[i].color_from_camera", own.color_from_camera, &found) ||
        !inRange("config.cameras[i].", "row_time_ns", static_cast<double>(own.row_time_ns), -SPHC_ROW_TIME_MAX_NS,
                 SPHC_ROW_TIME_MAX_NS, &found))
      return refuseElement(i, SPHC_E_ARGUMENT, found, message);
  }
  return SPHC_OK;
}

bool checkDepthCamera(const sphc_localizer_depth_camera &c, sphc_message *message) {
  const char *const owner = kFurtherDepthFields;
  return checkCamera(c.camera, "config.depth_cameras[i].camera", message) &&
         checkMount("config.depth_cameras[i].color_from_depth", c.color_from_depth, message) &&
         inRange(owner, "unit_m", c.unit_m, SPHC_RIG_MIN_UNIT_M, SPHC_RIG_MAX_UNIT_M, message) &&
         checkDepth(owner, c.format, c.camera.width, depthSensorFrom(c), message) &&
         checkBias(owner, c.offset_sigma_m, c.slope_sigma, message) &&
         inRange(owner, "amplitude_min", c.amplitude_min, 0, kMostAmplitude, message);
}

sphc_status readDepthCameras(ConfigCopy *copy, sphc_message *message) {
  sphc_localizer_config &config = copy->config;
  sphc_status status = checkArray("depth_camera", config.depth_cameras, config.depth_camera_count,
                                  SPHC_DEPTH_CAMERAS_MAX - 1, message);
  if (status != SPHC_OK) return status;
  std::fill_n(copy->depth_cameras, SPHC_DEPTH_CAMERAS_MAX - 1, emptyDepthCamera());
  status = readStructs("config.depth_cameras", config.depth_cameras, config.depth_camera_count, copy->depth_cameras,
                       message);
  if (status != SPHC_OK) return status;
  if (config.depth_cameras) config.depth_cameras = copy->depth_cameras;
  for (uint32_t i = 0; i < config.depth_camera_count; ++i) {
    sphc_message found;
    if (!checkDepthCamera(copy->depth_cameras[i], &found)) return refuseElement(i, SPHC_E_ARGUMENT, found, message);
  }
  return SPHC_OK;
}

}  // namespace

sphc_status readConfig(const sphc_localizer_config *config, ConfigCopy *copy, sphc_message *message) {
  sphc_localizer_config &own = copy->config;
  own = defaultConfig();
  sphc_status status = readStruct("config", config, &own, message);
  if (status == SPHC_OK) status = checkRig(own.rig, message);
  if (status != SPHC_OK) return status;
  const bool fine =
      checkNumbers(own, message) && checkParallel(own, message) &&
      checkDepth(kDepthFields, own.depth_format, own.rig.depth_camera.width, depthSensorFrom(own), message);
  if (!fine) return SPHC_E_ARGUMENT;
  status = readCameras(copy, message);
  return status == SPHC_OK ? readDepthCameras(copy, message) : status;
}

sphc_status readAlignerConfig(const sphc_aligner_config *config, sphc_aligner_config *copy, sphc_message *message) {
  *copy = defaultAlignerConfig();
  sphc_status status = readStruct("config", config, copy, message);
  if (status == SPHC_OK) status = checkRig(copy->rig, message);
  if (status != SPHC_OK) return status;
  const sphc_aligner_config &c = *copy;
  const DepthSensor sensor = {c.rig.depth_unit_m, c.depth_min_m, c.depth_max_m, c.depth_sigma_m,
                              c.depth_sigma_per_m2};
  const bool good = checkDepth(kDepthFields, c.depth_format, c.rig.depth_camera.width, sensor, message) &&
                    (c.aligned_unit_m == 0 || configInRange("aligned_unit_m", c.aligned_unit_m, SPHC_RIG_MIN_UNIT_M,
                                                            SPHC_RIG_MAX_UNIT_M, message));
  if (!good) return SPHC_E_ARGUMENT;
  const double unit_m = c.aligned_unit_m > 0 ? c.aligned_unit_m : c.rig.depth_unit_m;
  const double most_m = kMostMeasuredUnits * unit_m;
  if (c.depth_max_m <= most_m) return SPHC_OK;
  MessageWriter(message) << "config.depth_max_m is " << c.depth_max_m << ", but " << kMostMeasuredUnits
                         << " units of aligned_unit_m reach " << most_m << " m; raise the unit or lower the range";
  return SPHC_E_ARGUMENT;
}

}  // namespace sphc
