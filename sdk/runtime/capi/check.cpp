#include "runtime/capi/check.h"

#include <algorithm>

#include "runtime/base/message.h"
#include "runtime/base/parallel.h"
#include "runtime/capi/defaults.h"
#include "runtime/capi/format.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/objects.h"
#include "runtime/capi/transform.h"
#include "runtime/capi/translate.h"
#include "runtime/stages/align/dense.h"

namespace sphc {
namespace {

constexpr double kLeastSigma = 1e-6;  // smaller ones would square to nothing
constexpr double kMostAmplitude = 65535;

// A field that has to lie in [low, high]; `owner` is what its name begins with.
bool inRange(const char *owner, const char *name, double value, double low, double high, sphc_message *message) {
  if (value >= low && value <= high) return true;
  MessageWriter(message) << owner << name << " is " << value << "; it must lie in " << low << " to " << high;
  return false;
}
bool inRange(const char *name, double value, double low, double high, sphc_message *message) {
  return inRange("config.", name, value, low, high, message);
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
  return inRange("max_keypoints", c.max_keypoints, 64, 4096, message) &&
         inRange("max_maps", c.max_maps, 1, SPHC_MAPS_MAX, message) &&
         inRange("pixel_sigma_px", c.pixel_sigma_px, 0.01, 20, message) &&
         inRange("map_sigma_m", c.map_sigma_m, 0, 1, message) &&
         inRange("depth_mid_m", c.depth_mid_m, 0, 200, message) &&
         checkBias(kDepthFields, c.depth_offset_sigma_m, c.depth_slope_sigma, message) &&
         inRange("amplitude_min", c.amplitude_min, 0, kMostAmplitude, message) &&
         inRange("color_row_time_ns", static_cast<double>(c.color_row_time_ns), -SPHC_ROW_TIME_MAX_NS,
                 SPHC_ROW_TIME_MAX_NS, message) &&
         inRange("color_band", c.color_band, SPHC_BAND_VISIBLE, SPHC_BAND_INFRARED, message) &&
         inRange("mode", c.mode, SPHC_MODE_TRACKING, SPHC_MODE_SINGLE, message) &&
         (!c.log || inRange("log_level", c.log_level, SPHC_LOG_ERROR, SPHC_LOG_DEBUG, message));
}

static_assert(SPHC_PARALLEL_MAX == Parallel::kMostPieces);

bool checkParallel(const sphc_localizer_config &c, sphc_message *message) {
  if (c.parallel) return inRange("parallel_tasks", c.parallel_tasks, 1, SPHC_PARALLEL_MAX, message);
  if (!c.parallel_tasks) return true;
  MessageWriter(message) << "config.parallel_tasks is " << c.parallel_tasks
                         << ", but config.parallel is null; give it a function that runs tasks, or set "
                            "parallel_tasks to 0";
  return false;
}

bool priorInRange(const char *name, double value, double low, double high, sphc_message *message) {
  return inRange("prior.", name, value, low, high, message);
}

bool checkDirection(const char *name, const double *v, sphc_message *message) {
  const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  if (square >= SPHC_UP_MIN_LENGTH * SPHC_UP_MIN_LENGTH && square <= SPHC_UP_MAX_LENGTH * SPHC_UP_MAX_LENGTH)
    return true;
  MessageWriter(message) << "prior." << name << " is (" << v[0] << ", " << v[1] << ", " << v[2]
                         << "); its length must lie in " << SPHC_UP_MIN_LENGTH << " to " << SPHC_UP_MAX_LENGTH;
  return false;
}

bool checkPriorPose(const sphc_localizer_prior &prior, sphc_message *message) {
  return checkTransform("prior.camera_from_map", prior.camera_from_map, SPHC_POSE_MAX_OFFSET_M, message) &&
         priorInRange("rotation_sigma_rad", prior.rotation_sigma_rad, 1e-6, 3.2, message) &&
         priorInRange("translation_sigma_m", prior.translation_sigma_m, 1e-6, 1000, message);
}

bool checkPriorUp(const sphc_localizer_prior &prior, sphc_message *message) {
  return checkDirection("up_camera", prior.up_camera, message) && checkDirection("up_map", prior.up_map, message) &&
         priorInRange("up_sigma_rad", prior.up_sigma_rad, 1e-4, 0.5, message);
}

bool checkPriorOdometry(const sphc_localizer_prior &prior, sphc_message *message) {
  return checkTransform("prior.odometry_from_camera", prior.odometry_from_camera, SPHC_POSE_MAX_OFFSET_M,
                        message) &&
         priorInRange("odometry_rotation_sigma_rad", prior.odometry_rotation_sigma_rad, 1e-6, 1, message) &&
         priorInRange("odometry_translation_sigma_m", prior.odometry_translation_sigma_m, 1e-6, 10, message);
}

// A transform between sensors of one rig.
bool checkMount(const char *name, const sphc_rigid &mount, sphc_message *message) {
  return checkTransform(name, mount, SPHC_RIG_MAX_OFFSET_M, message);
}

// Of an array's element: says which, in front of what was found.
sphc_status refuseElement(uint32_t i, sphc_status status, const sphc_message &found, sphc_message *message) {
  MessageWriter(message) << "with i = " << i << ": " << found.text;
  return status;
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

// A camera as it is in one frame, where that is told.
bool checkCameraNow(const char *name, const sphc_camera *now, const sphc_camera &known, sphc_message *message) {
  if (!now) return true;
  if (!checkCamera(*now, name, message)) return false;
  if (now->width == known.width && now->height == known.height) return true;
  MessageWriter(message) << name << " is of " << now->width << " x " << now->height << " pixels, in the config of "
                         << known.width << " x " << known.height << "; give the calibration of the configured size";
  return false;
}

bool checkMountNow(const char *name, const sphc_rigid *now, sphc_message *message) {
  return !now || checkMount(name, *now, message);
}

sphc_status checkView(const sphc_localizer_view &view, const sphc_camera &known, bool looks_at_images,
                      sphc_message *message) {
  if (!checkCameraNow("frame.views[i].camera", view.camera, known, message) ||
      !checkMountNow("frame.views[i].color_from_camera", view.color_from_camera, message))
    return SPHC_E_ARGUMENT;
  if (!looks_at_images || !view.image.data) return SPHC_OK;
  return checkImage("frame.views[i]", view.image, known, {}, message);
}

// An array of a frame: one element for each of the config's `cameras`, and null where there are none.
sphc_status checkViewArray(const char *prefix, const void *array, uint32_t count, uint32_t cameras,
                           sphc_message *message) {
  if (count == cameras && (cameras > 0) == (array != nullptr)) return SPHC_OK;
  MessageWriter(message) << "frame." << prefix << "view_count is " << count << ", frame." << prefix << "views is "
                         << (array ? "not null" : "null") << ", and config." << prefix << "camera_count is "
                         << cameras << "; give a view for each camera, with data null where it has none";
  return SPHC_E_ARGUMENT;
}

sphc_status readViews(const FrameLimits &limits, FrameCopy *copy, sphc_message *message) {
  sphc_localizer_frame &frame = copy->frame;
  const auto cameras = static_cast<uint32_t>(limits.config.further.size());
  sphc_status status = checkViewArray("", frame.views, frame.view_count, cameras, message);
  if (status == SPHC_OK) status = readStructs("frame.views", frame.views, cameras, copy->views, message);
  if (status != SPHC_OK) return status;
  if (frame.views) frame.views = copy->views;
  for (uint32_t i = 0; i < cameras; ++i) {
    sphc_message found;
    status =
        checkView(copy->views[i], limits.config.further[i].camera.parameters(), limits.looks_at_images, &found);
    if (status != SPHC_OK) return refuseElement(i, status, found, message);
  }
  return SPHC_OK;
}

// `owner` is how the names of the camera's fields begin.
sphc_status checkAmplitude(const char *owner, const sphc_image &image, const RigDepthCamera &camera,
                           sphc_message *message) {
  if (!camera.least_amplitude) return SPHC_OK;  // not looked at
  if (!image.data) {
    MessageWriter(message) << "amplitude image is missing; give one with every frame, or set " << owner
                           << "amplitude_min to 0";
    return SPHC_E_IMAGE;
  }
  const LumaLayout layout = pixelFormatOf(image.format).luma;
  const bool is_number = layout.kind == LumaLayout::kWords || image.format == SPHC_FORMAT_GRAY8;
  if (!is_number || layout.green != LumaLayout::kNoFilter) {
    MessageWriter(message) << "amplitude image has format " << image.format
                           << "; give GRAY8, GRAY10, GRAY12 or GRAY16, as " << owner << "amplitude_min is set";
    return SPHC_E_IMAGE;
  }
  return checkImage("amplitude", image, camera.camera.parameters(), {}, message);
}

// The images of a depth camera, the i-th of the rig.
sphc_status checkDepthImages(const FrameLimits &limits, uint32_t i, const sphc_image &depth,
                             const sphc_image &amplitude, sphc_message *message) {
  const RigDepthCamera &camera = limits.config.depth[i];
  const DepthWanted wanted = {limits.depth_formats[i],
                              i == 0 ? "config.depth_format" : "config.depth_cameras[i].format"};
  const sphc_status status = checkImage("depth", depth, camera.camera.parameters(), wanted, message);
  if (status != SPHC_OK) return status;
  return checkAmplitude(i == 0 ? "config." : kFurtherDepthFields, amplitude, camera, message);
}

sphc_status checkDepthView(const FrameLimits &limits, uint32_t i, const sphc_localizer_depth_view &view,
                           sphc_message *message) {
  if (!checkCameraNow("frame.depth_views[i].camera", view.camera, limits.config.depth[i].camera.parameters(),
                      message) ||
      !checkMountNow("frame.depth_views[i].color_from_depth", view.color_from_depth, message))
    return SPHC_E_ARGUMENT;
  if (!view.depth.data) return SPHC_OK;
  return checkDepthImages(limits, i, view.depth, view.amplitude, message);
}

sphc_status readDepthViews(const FrameLimits &limits, FrameCopy *copy, sphc_message *message) {
  sphc_localizer_frame &frame = copy->frame;
  const auto cameras = static_cast<uint32_t>(limits.config.depth.size()) - 1;
  sphc_status status = checkViewArray("depth_", frame.depth_views, frame.depth_view_count, cameras, message);
  if (status == SPHC_OK)
    status = readStructs("frame.depth_views", frame.depth_views, cameras, copy->depth_views, message);
  if (status != SPHC_OK) return status;
  if (frame.depth_views) frame.depth_views = copy->depth_views;
  for (uint32_t i = 0; i < cameras; ++i) {
    sphc_message found;
    status = checkDepthView(limits, i + 1, copy->depth_views[i], &found);
    if (status != SPHC_OK) return refuseElement(i, status, found, message);
  }
  return SPHC_OK;
}

// What the second half of a frame looks at beside the first.
sphc_status checkDepthFrame(const FrameLimits &limits, FrameCopy *copy, sphc_message *message) {
  const sphc_localizer_frame &own = copy->frame;
  if (!checkCameraNow("frame.depth_camera", own.depth_camera, limits.config.depth[0].camera.parameters(), message))
    return SPHC_E_ARGUMENT;
  const sphc_status status = checkDepthImages(limits, 0, own.depth, own.amplitude, message);
  return status == SPHC_OK ? readDepthViews(limits, copy, message) : status;
}

sphc_status checkPrior(const sphc_localizer_prior &prior, const MapSet &maps, sphc_message *message) {
  if (prior.flags & ~(SPHC_PRIOR_POSE | SPHC_PRIOR_UP | SPHC_PRIOR_ODOMETRY)) {
    MessageWriter(message) << "prior.flags has bits that this library does not know: " << prior.flags
                           << "; use SPHC_PRIOR_POSE, _UP and _ODOMETRY";
    return SPHC_E_UNSUPPORTED;
  }
  if (prior.flags & (SPHC_PRIOR_POSE | SPHC_PRIOR_UP) && maps.slotOf(prior.map_id) == kNoMap) {
    MessageWriter(message) << "prior.map_id is " << prior.map_id << ", and none of the localizer's " << maps.count()
                           << " maps has this id; give one that sphc_localizer_set_map was called with";
    return SPHC_E_ARGUMENT;
  }
  const bool fine = (!(prior.flags & SPHC_PRIOR_POSE) || checkPriorPose(prior, message)) &&
                    (!(prior.flags & SPHC_PRIOR_UP) || checkPriorUp(prior, message)) &&
                    (!(prior.flags & SPHC_PRIOR_ODOMETRY) || checkPriorOdometry(prior, message));
  return fine ? SPHC_OK : SPHC_E_ARGUMENT;
}

sphc_status checkDeadline(const sphc_localizer_frame &frame, bool has_clock, sphc_message *message) {
  if (!frame.deadline_us || has_clock) return SPHC_OK;
  MessageWriter(message) << "frame.deadline_us is " << frame.deadline_us
                         << " but config.clock is null; give a clock or no deadline";
  return SPHC_E_ARGUMENT;
}

// What the first half of a frame looks at; reads the views.
sphc_status checkFeatureFrame(const FrameLimits &limits, FrameCopy *copy, sphc_message *message) {
  const sphc_localizer_frame &own = copy->frame;
  const sphc_camera &color = limits.config.color_camera.parameters();
  sphc_status status = checkDeadline(own, limits.has_clock, message);
  if (status == SPHC_OK && limits.looks_at_images) status = checkImage("color", own.color, color, {}, message);
  if (status != SPHC_OK) return status;
  if (!checkCameraNow("frame.color_camera", own.color_camera, color, message) ||
      !checkMountNow("frame.color_from_depth", own.color_from_depth, message))
    return SPHC_E_ARGUMENT;
  return readViews(limits, copy, message);
}

}  // namespace

sphc_status checkImage(const char *name, const sphc_image &image, const sphc_camera &camera,
                       const DepthWanted &wanted, sphc_message *message) {
  if (!image.data) {
    MessageWriter(message) << name << " image's data pointer is null; give the pixels";
    return SPHC_E_IMAGE;
  }
  const PixelFormat format = pixelFormatOf(image.format);
  const bool fits = wanted.format ? image.format == wanted.format : format.group_bytes && !format.is_depth;
  if (!fits) {
    MessageWriter text(message);
    text << name << " image has format " << image.format << "; give ";
    if (wanted.format)
      text << sphc_format_name(wanted.format) << " as " << wanted.field << " says, or set that to another";
    else
      text << "GRAY8, RGB8, BGR8 or another that is not of depth";
    return SPHC_E_IMAGE;
  }
  if (image.width != camera.width || image.height != camera.height) {
    MessageWriter(message) << name << " image is " << image.width << " x " << image.height
                           << ", its camera in the config " << camera.width << " x " << camera.height
                           << "; scale neither, give the calibrated size";
    return SPHC_E_IMAGE;
  }
  const uint32_t row = sphc_format_row_bytes(image.format, image.width);
  if (!row) {
    MessageWriter(message) << name << " image is " << image.width << " wide, and " << format.group_pixels
                           << " pixels of its format share bytes; give a multiple";
    return SPHC_E_IMAGE;
  }
  if (image.stride_bytes < row || image.stride_bytes > SPHC_STRIDE_MAX_BYTES ||
      image.stride_bytes % format.alignment) {
    MessageWriter text(message);
    text << name << " image has a stride of " << image.stride_bytes << " bytes; a row has " << row
         << ": give that to " << SPHC_STRIDE_MAX_BYTES;
    if (format.alignment > 1) text << ", a multiple of " << format.alignment;
    return SPHC_E_IMAGE;
  }
  if (reinterpret_cast<uintptr_t>(image.data) % format.alignment) {
    MessageWriter(message) << name << " image's data pointer is not aligned to " << format.alignment
                           << " bytes; begin the pixels there";
    return SPHC_E_IMAGE;
  }
  return SPHC_OK;
}

sphc_status readConfig(const sphc_localizer_config *config, ConfigCopy *copy, sphc_message *message) {
  sphc_localizer_config &own = copy->config;
  own = defaultConfig();
  sphc_status status = readStruct("config", config, &own, message);
  if (status == SPHC_OK) status = sphc_rig_check(&own.rig, message);
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
  if (status == SPHC_OK) status = sphc_rig_check(&copy->rig, message);
  if (status != SPHC_OK) return status;
  const sphc_aligner_config &c = *copy;
  const DepthSensor sensor = {c.rig.depth_unit_m, c.depth_min_m, c.depth_max_m, c.depth_sigma_m,
                              c.depth_sigma_per_m2};
  const bool good = checkDepth(kDepthFields, c.depth_format, c.rig.depth_camera.width, sensor, message) &&
                    (c.aligned_unit_m == 0 || inRange("aligned_unit_m", c.aligned_unit_m, SPHC_RIG_MIN_UNIT_M,
                                                      SPHC_RIG_MAX_UNIT_M, message));
  if (!good) return SPHC_E_ARGUMENT;
  const double unit_m = c.aligned_unit_m > 0 ? c.aligned_unit_m : c.rig.depth_unit_m;
  const double most_m = kMostMeasuredUnits * unit_m;
  if (c.depth_max_m <= most_m) return SPHC_OK;
  MessageWriter(message) << "config.depth_max_m is " << c.depth_max_m << ", but " << kMostMeasuredUnits
                         << " units of aligned_unit_m reach " << most_m << " m; raise the unit or lower the range";
  return SPHC_E_ARGUMENT;
}

sphc_status readFrame(const sphc_localizer_frame *frame, const FrameLimits &limits, FrameCopy *copy,
                      sphc_message *message) {
  *copy = {};
  sphc_localizer_frame &own = copy->frame;
  sphc_status status = readStruct("frame", frame, &own, message);
  if (status == SPHC_OK && own.prior) status = readStruct("prior", own.prior, &copy->prior, message);
  if (status != SPHC_OK) return status;
  if (own.prior) own.prior = &copy->prior;
  status = checkFeatureFrame(limits, copy, message);
  if (status == SPHC_OK) status = checkDepthFrame(limits, copy, message);
  if (status == SPHC_OK && own.prior) status = checkPrior(*own.prior, limits.maps, message);
  return status;
}

sphc_status readFeatureFrame(const sphc_localizer_frame *frame, const FrameLimits &limits, FrameCopy *copy,
                             sphc_message *message) {
  *copy = {};
  const sphc_status status = readStruct("frame", frame, &copy->frame, message);
  return status == SPHC_OK ? checkFeatureFrame(limits, copy, message) : status;
}

sphc_status readColorFrame(const sphc_localizer_frame *frame, const sphc_camera &color, sphc_localizer_frame *copy,
                           sphc_message *message) {
  *copy = {};
  const sphc_status status = readStruct("frame", frame, copy, message);
  return status == SPHC_OK ? checkImage("color", copy->color, color, {}, message) : status;
}

sphc_status checkPlacement(const sphc_rigid &common_from_map, double rotation_sigma_rad, double translation_sigma_m,
                           sphc_message *message) {
  const bool fine = checkTransform("common_from_map", common_from_map, SPHC_POSE_MAX_OFFSET_M, message) &&
                    inRange("", "rotation_sigma_rad", rotation_sigma_rad, 0, 0.5, message) &&
                    inRange("", "translation_sigma_m", translation_sigma_m, 0, 100, message);
  return fine ? SPHC_OK : SPHC_E_ARGUMENT;
}

sphc_status checkDepthBias(const sphc_depth_bias *depth, const DepthCalibration &prior, sphc_message *message) {
  if (!depth) {
    MessageWriter(message) << "depth is null; give result.depth of an earlier frame";
    return SPHC_E_ARGUMENT;
  }
  const sphc_depth_bias &d = *depth;
  constexpr double kRounding = 1 + 1e-4, kMostOffsetM = 1, kMostSlope = 0.5;
  const double offset_sigma_m = sqrtOf(prior.covariance(0, 0)) * kRounding,
               slope_sigma = sqrtOf(prior.covariance(1, 1)) * kRounding;
  const auto lies = [&](const char *name, double value, double low, double high) {
    return inRange("depth.", name, value, low, high, message);
  };
  const double most_m = prior.isKnown() ? 0 : kMostOffsetM, most_slope = prior.isKnown() ? 0 : kMostSlope;
  const double least = prior.isKnown() ? 0 : kLeastSigma;
  const bool fine = lies("mid_m", d.mid_m, prior.mid_m / kRounding, prior.mid_m * kRounding) &&
                    lies("offset_m", d.offset_m, -most_m, most_m) &&
                    lies("slope", d.slope, -most_slope, most_slope) &&
                    lies("offset_sigma_m", d.offset_sigma_m, least, offset_sigma_m) &&
                    lies("slope_sigma", d.slope_sigma, least, slope_sigma) &&
                    lies("correlation", d.correlation, -0.9999, 0.9999) &&
                    lies("noise_scale", d.noise_scale, kLeastNoiseScale, kMostNoiseScale);
  return fine ? SPHC_OK : SPHC_E_ARGUMENT;
}

sphc_status checkFeatures(const sphc_features &features, const sphc_localizer &localizer, sphc_message *message) {
  const ImageSize &of = features.sizes.of[0];
  const sphc_camera &own = localizer.localizer.config().color_camera.parameters();
  const bool same = features.max_keypoints == localizer.max_keypoints &&
                    features.sizes == imageSizesOf(localizer.localizer.config());
  if (!same) {
    MessageWriter(message) << "the features are made for " << features.max_keypoints << " keypoints of "
                           << features.sizes.count << " cameras, the first of " << of.width << " x " << of.height
                           << " pixels, the localizer for " << localizer.max_keypoints << " of "
                           << 1 + localizer.localizer.config().further.size() << ", the first of " << own.width
                           << " x " << own.height << "; make both with one config";
    return SPHC_E_ARGUMENT;
  }
  const sphc_status status = checkApart(localizer.state, features.memory, message);
  return status == SPHC_OK ? checkApart(localizer.scratch, features.memory, message) : status;
}

sphc_status giveMemory(const sphc_memory &need, sphc_memory *memory, sphc_message *message) {
  if (!memory) {
    MessageWriter(message) << "memory is null; give one to write the answer to";
    return SPHC_E_ARGUMENT;
  }
  *memory = need;
  return SPHC_OK;
}

sphc_status checkMemory(const void *memory, size_t bytes, size_t needed, size_t alignment, const char *what,
                        sphc_message *message) {
  if (!memory) {
    MessageWriter(message) << what << " memory is null; give as many bytes as were asked for";
    return SPHC_E_ARGUMENT;
  }
  if (reinterpret_cast<uintptr_t>(memory) % alignment) {
    MessageWriter(message) << what << " memory must be aligned to " << static_cast<uint64_t>(alignment) << " bytes";
    return SPHC_E_MEMORY_ALIGNMENT;
  }
  if (bytes < needed) {
    MessageWriter(message) << what << " memory has " << static_cast<uint64_t>(bytes) << " bytes, "
                           << static_cast<uint64_t>(needed)
                           << " are needed; ask again with this config and this version";
    return SPHC_E_MEMORY_SIZE;
  }
  return SPHC_OK;
}

sphc_status checkApart(const MemoryRange &written, const MemoryRange &other, sphc_message *message) {
  const auto a = reinterpret_cast<uintptr_t>(written.begin), b = reinterpret_cast<uintptr_t>(other.begin);
  const bool apart = a < b ? b - a >= written.bytes : a - b >= other.bytes;
  if (apart) return SPHC_OK;
  MessageWriter(message) << written.name << " memory overlaps " << other.name << "; give it bytes of its own";
  return SPHC_E_ARGUMENT;
}

sphc_status checkApartFromMap(const MemoryRange &written, const sphc_map &map, sphc_message *message) {
  const MapHeader &file = map.view.header();
  const sphc_status status = checkApart(written, {"the view of a map", &map, sizeof map}, message);
  if (status != SPHC_OK) return status;
  return checkApart(written, {"the file of a map", &file, static_cast<size_t>(file.file_bytes)}, message);
}

}  // namespace sphc
