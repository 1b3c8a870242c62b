#include "runtime/capi/frame_copy.h"

#include "runtime/base/message.h"
#include "runtime/capi/check.h"
#include "runtime/capi/format.h"
#include "runtime/capi/growth.h"
#include "runtime/capi/transform.h"

namespace sphc {
namespace {

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
  return checkAmplitude(i == 0 ? "config." : "config.depth_cameras[i].", amplitude, camera, message);
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

}  // namespace sphc
