#include "device.h"

#include <PS1080.h>

#include <cmath>
#include <cstring>

#include "explain.h"
#include "frame_check.h"
#include "modes.h"

namespace sphc::openni2 {

namespace {

constexpr int64_t kPlayerPatienceNs = 1000000000;
constexpr OniSensorType kSensors[kStreams] = {ONI_SENSOR_COLOR, ONI_SENSOR_DEPTH};

template <typename Value>
bool getProperty(OniStreamHandle stream, int id, Value *value) {
  int bytes = sizeof *value;
  return oniStreamGetProperty(stream, id, value, &bytes) == ONI_STATUS_OK && bytes == sizeof *value;
}

template <typename Value>
bool setProperty(OniStreamHandle stream, int id, const Value &value) {
  return oniStreamSetProperty(stream, id, &value, sizeof value) == ONI_STATUS_OK;
}

struct ControlName {
  int property;  // -1: no such control
  const char *text;
};
ControlName nameOf(sphc_openni2_control control) {
  switch (control) {
    case SPHC_OPENNI2_AUTO_EXPOSURE:
      return {ONI_STREAM_PROPERTY_AUTO_EXPOSURE, "auto exposure"};
    case SPHC_OPENNI2_AUTO_WHITE_BALANCE:
      return {ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE, "auto white balance"};
    case SPHC_OPENNI2_EXPOSURE:
      return {ONI_STREAM_PROPERTY_EXPOSURE, "exposure"};
    case SPHC_OPENNI2_GAIN:
      return {ONI_STREAM_PROPERTY_GAIN, "gain"};
    default:
      return {-1, "?"};
  }
}

}  // namespace

// ---- open, close ----

sphc_status Device::open(const char *uri, const sphc_openni2_config &config, sphc_message *message) {
  if (oniDeviceOpen(uri, &device_) != ONI_STATUS_OK) {
    device_ = nullptr;
    return explain(message, SPHC_E_DEVICE,
                   "%.60s cannot be opened (%s): end the program that has it, give another URI, or permission to "
                   "read its file or USB node",
                   uri, LibraryError().text);
  }
  is_recording_ = oniDeviceIsPropertySupported(device_, ONI_DEVICE_PROPERTY_PLAYBACK_SPEED);
  player_awake_ = false;
  sphc_status status = is_recording_ ? playByHand(message) : SPHC_OK;
  if (status == SPHC_OK && config.streams & SPHC_OPENNI2_STREAM_COLOR)
    status = openStream(kColor, config.color, message);
  if (status == SPHC_OK && config.streams & SPHC_OPENNI2_STREAM_DEPTH)
    status = openStream(kDepth, config.depth, message);
  if (status == SPHC_OK && is_recording_ && !startPlayer())
    status = explain(message, SPHC_E_DEVICE,
                     "the recording gives no frames: it is cut short, damaged, or was made of a device without the "
                     "cropping property; record it anew");
  if (status == SPHC_OK) status = setRegistration(config.registration != 0, message);
  frame_sync_ = config.frame_sync != 0;
  if (status == SPHC_OK && frame_sync_) status = checkFrameSync(message);
  if (status != SPHC_OK) close();
  return status;
}

void Device::close() {
  if (device_ && is_recording_ && !player_awake_) startPlayer();
  player_.close();
  for (OniStreamHandle &stream : streams_) {
    if (stream) oniStreamDestroy(stream);
    stream = nullptr;
  }
  if (device_) oniDeviceClose(device_);
  device_ = nullptr;
}

sphc_status Device::openStream(int stream, const sphc_openni2_mode &wanted, sphc_message *message) {
  if (!oniDeviceGetSensorInfo(device_, kSensors[stream]))
    return explain(message, SPHC_E_UNSUPPORTED,
                   "the device has no %s stream; leave it out of config.streams, and take it from another driver",
                   kStreamNames[stream]);
  if (oniDeviceCreateStream(device_, kSensors[stream], &streams_[stream]) != ONI_STATUS_OK) {
    streams_[stream] = nullptr;
    return explain(message, SPHC_E_DEVICE, "the %s stream cannot be made (%s); plug the device in again",
                   kStreamNames[stream], LibraryError().text);
  }
  const sphc_status status = setMode(stream, wanted, message);
  return status == SPHC_OK ? makePlain(stream, message) : status;
}

// The mode that runs is read back: what was granted counts.
sphc_status Device::setMode(int stream, const sphc_openni2_mode &wanted, sphc_message *message) {
  const OniStreamHandle handle = streams_[stream];
  const OniSensorInfo &offered = *oniStreamGetSensorInfo(handle);
  OniVideoMode &mode = modes_[stream];
  if (!getProperty(handle, ONI_STREAM_PROPERTY_VIDEO_MODE, &mode)) mode = {};
  const OniVideoMode *chosen = chooseMode(offered, stream, wanted, mode);
  if (!chosen)
    return explain(message, SPHC_E_UNSUPPORTED,
                   "no %s mode of %ux%u@%u (0: any) in a usable format; the device has %s", kStreamNames[stream],
                   wanted.width, wanted.height, wanted.frames_per_s,
                   ModeList(offered.pSupportedVideoModes, offered.numSupportedVideoModes).text);
  const OniVideoMode asked = *chosen;
  const bool granted = is_recording_ || setProperty(handle, ONI_STREAM_PROPERTY_VIDEO_MODE, asked);
  if (!granted || !getProperty(handle, ONI_STREAM_PROPERTY_VIDEO_MODE, &mode) || !modeFits(mode, stream, wanted) ||
      mode.pixelFormat != asked.pixelFormat)
    return explain(message, SPHC_E_UNSUPPORTED,
                   "the %s mode %s was offered, but the device runs %s (%s); ask for that one",
                   kStreamNames[stream], ModeList(&asked, 1).text, ModeList(&mode, 1).text, LibraryError().text);
  return SPHC_OK;
}

// Neither mirrored, as many devices are until told, nor cropped.  A device without the property does neither.
sphc_status Device::makePlain(int stream, sphc_message *message) {
  const OniStreamHandle handle = streams_[stream];
  OniBool mirrored = FALSE;
  setProperty(handle, ONI_STREAM_PROPERTY_MIRRORING, mirrored);
  if (getProperty(handle, ONI_STREAM_PROPERTY_MIRRORING, &mirrored) && mirrored)
    return explain(message, SPHC_E_UNSUPPORTED,
                   "the %s stream is mirrored, and the device refuses to change that; use another device",
                   kStreamNames[stream]);
  OniCropping cropping = {};
  if (getProperty(handle, ONI_STREAM_PROPERTY_CROPPING, &cropping) && cropping.enabled) {
    cropping.enabled = FALSE;
    if (!setProperty(handle, ONI_STREAM_PROPERTY_CROPPING, cropping))
      return explain(message, SPHC_E_UNSUPPORTED,
                     "the %s stream is cropped, and the device refuses to change that; use another device",
                     kStreamNames[stream]);
  }
  return SPHC_OK;
}

// A recording says that it was set and leaves depth as it is: only what is read back counts.
sphc_status Device::setRegistration(bool on, sphc_message *message) {
  OniImageRegistrationMode mode = on ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF;
  const bool supported = oniDeviceIsImageRegistrationModeSupported(device_, mode);
  if (supported) oniDeviceSetProperty(device_, ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION, &mode, sizeof mode);
  OniImageRegistrationMode is = ONI_IMAGE_REGISTRATION_OFF;
  int bytes = sizeof is;
  if (oniDeviceGetProperty(device_, ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION, &is, &bytes) != ONI_STATUS_OK)
    is = ONI_IMAGE_REGISTRATION_OFF;
  registration_ = is == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  if (on ? supported && registration_ : !registration_ || is_recording_) return SPHC_OK;
  return explain(
      message, SPHC_E_UNSUPPORTED,
      "registration cannot be switched %s: %s; set config.registration to %d and calibrate the two cameras",
      on ? "on" : "off", supported ? "the device says it did, but did not" : "the device cannot", on ? 0 : 1);
}

sphc_status Device::checkFrameSync(sphc_message *message) const {
  if (!is_recording_ && has(kColor) && has(kDepth)) return SPHC_OK;
  return explain(message, SPHC_E_UNSUPPORTED, "frame synchronisation: %s; set config.frame_sync to 0",
                 is_recording_ ? "a recording has none" : "it needs both streams");
}

// Speed -1: the file goes on as frames are read.  Seeking crashes in OpenNI2 and is never done.  Repeating: at an
// end the player's thread would run on at full speed, and crash when streams are destroyed meanwhile.
sphc_status Device::playByHand(sphc_message *message) {
  const float speed = -1;
  const OniBool repeat = TRUE;
  if (oniDeviceSetProperty(device_, ONI_DEVICE_PROPERTY_PLAYBACK_REPEAT_ENABLED, &repeat, sizeof repeat) !=
          ONI_STATUS_OK ||
      oniDeviceSetProperty(device_, ONI_DEVICE_PROPERTY_PLAYBACK_SPEED, &speed, sizeof speed) != ONI_STATUS_OK)
    return explain(message, SPHC_E_DEVICE, "the recording cannot be played frame by frame (%s); record it again",
                   LibraryError().text);
  return SPHC_OK;
}

// Until the file's first frame is there.  A player that is closed before its thread runs is not ended but killed, 3
// s later, and takes the process with it.
bool Device::startPlayer() {
  player_.close();
  const bool started = player_.start(streams_);
  player_awake_ = player_.await(monotonicNs() + kPlayerPatienceNs) && started;
  return player_awake_;
}

// ---- running ----

sphc_status Device::start(sphc_message *message) {
  for (int stream = 0; stream < kStreams; ++stream) {
    if (!has(stream) || oniStreamStart(streams_[stream]) == ONI_STATUS_OK) continue;
    const LibraryError error;
    stop();
    return explain(message, SPHC_E_DEVICE,
                   "start: the %s stream does not start (%s); unplug the device and plug it in",
                   kStreamNames[stream], error.text);
  }
  // Asked for before the streams run, OpenNI2 grants it whatever the device says.
  if (!frame_sync_ || oniDeviceEnableDepthColorSync(device_) == ONI_STATUS_OK) return SPHC_OK;
  stop();
  return explain(
      message, SPHC_E_UNSUPPORTED,
      "start: the device refuses to synchronise its streams; set config.frame_sync to 0 and pair by time");
}

void Device::stop() {
  if (frame_sync_ && oniDeviceGetDepthColorSyncEnabled(device_)) oniDeviceDisableDepthColorSync(device_);
  for (const OniStreamHandle stream : streams_)
    if (stream) oniStreamStop(stream);
}

int Device::listStreams(OniStreamHandle (&handles)[kStreams], int (&streams)[kStreams]) const {
  int count = 0;
  for (int stream = 0; stream < kStreams; ++stream) {
    if (!has(stream)) continue;
    handles[count] = streams_[stream];
    streams[count++] = stream;
  }
  return count;
}

size_t Device::frameBytes(int stream) const {
  if (!has(stream)) return 0;
  const OniVideoMode &mode = modes_[stream];
  return size_t{sphc_format_bytes(formatOf(mode.pixelFormat))} * static_cast<size_t>(mode.resolutionX) *
         static_cast<size_t>(mode.resolutionY);
}

// ---- what it says of itself ----

void Device::describe(sphc_openni2_info *info) const {
  OniDeviceInfo its = {};
  if (oniDeviceGetInfo(device_, &its) == ONI_STATUS_OK) info->device = publicInfo(its);
  info->is_recording = is_recording_;
  const auto modeOf = [&](int stream) -> sphc_openni2_mode {
    const OniVideoMode &mode = modes_[stream];
    return {static_cast<uint32_t>(mode.resolutionX), static_cast<uint32_t>(mode.resolutionY),
            static_cast<uint32_t>(mode.fps)};
  };
  info->color = modeOf(kColor);
  info->depth = modeOf(kDepth);
  info->color_format = formatOf(modes_[kColor].pixelFormat);
  info->registration = registration_;
  info->frame_sync = frame_sync_;
  info->depth_unit_m = modes_[kDepth].pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM ? 0.0001 : 0.001;
  info->color_camera = cameraHint(kColor);
  info->depth_camera = cameraHint(kDepth);
  double baseline_cm = 0;  // a property of PrimeSense's devices, and of those that follow them
  if (has(kDepth) && getProperty(streams_[kDepth], XN_STREAM_PROPERTY_DCMOS_RCMOS_DISTANCE, &baseline_cm) &&
      baseline_cm > 0 && baseline_cm < 100)
    info->baseline_m = 0.01 * baseline_cm;
}

sphc_camera Device::cameraHint(int stream) const {
  // Registered depth lies on the colour image.
  const int seen_by = stream == kDepth && registration_ && has(kColor) ? kColor : stream;
  float horizontal_rad = 0, vertical_rad = 0;
  sphc_camera camera = {};
  if (!has(stream) || !getProperty(streams_[seen_by], ONI_STREAM_PROPERTY_HORIZONTAL_FOV, &horizontal_rad) ||
      !getProperty(streams_[seen_by], ONI_STREAM_PROPERTY_VERTICAL_FOV, &vertical_rad))
    return camera;
  constexpr float kMinRad = 0.01f, kMaxRad = 3.1f;  // that of a file without them is 0
  const auto plausible = [](float angle_rad) { return angle_rad > kMinRad && angle_rad < kMaxRad; };
  if (!plausible(horizontal_rad) || !plausible(vertical_rad)) return camera;
  const double width = modes_[stream].resolutionX, height = modes_[stream].resolutionY;
  camera.model = SPHC_CAMERA_PINHOLE;
  camera.width = static_cast<uint32_t>(modes_[stream].resolutionX);
  camera.height = static_cast<uint32_t>(modes_[stream].resolutionY);
  camera.param_count = 4;
  camera.params[0] = 0.5 * width / std::tan(0.5 * static_cast<double>(horizontal_rad));
  camera.params[1] = 0.5 * height / std::tan(0.5 * static_cast<double>(vertical_rad));
  camera.params[2] = 0.5 * width;
  camera.params[3] = 0.5 * height;
  return camera;
}

// ---- controls ----

sphc_status Device::setControl(sphc_openni2_control control, int32_t value, sphc_message *message) {
  int32_t is = 0;
  const sphc_status status = getControl(control, &is, message);  // says what is unknown or not there
  if (status != SPHC_OK) return status;
  const ControlName name = nameOf(control);
  const bool taken = setProperty(streams_[kColor], name.property, value);
  if (taken && getControl(control, &is, message) == SPHC_OK && is == value) return SPHC_OK;
  return explain(message, SPHC_E_DEVICE, "%s cannot be set to %d: it is %d%s; try another value%s", name.text,
                 value, is, taken ? " in spite of a success" : "",
                 control == SPHC_OPENNI2_EXPOSURE || control == SPHC_OPENNI2_GAIN ? ", and auto exposure off" : "");
}

sphc_status Device::getControl(sphc_openni2_control control, int32_t *value, sphc_message *message) const {
  const ControlName name = nameOf(control);
  if (name.property < 0) return explain(message, SPHC_E_ARGUMENT, "control %d; it must be 1 to 4", control);
  int32_t is = 0;
  if (!has(kColor) || !oniStreamIsPropertySupported(streams_[kColor], name.property) ||
      !getProperty(streams_[kColor], name.property, &is))
    return explain(message, SPHC_E_UNSUPPORTED, "%s: the device has no such control%s", name.text,
                   has(kColor) ? "; leave it out" : " without its colour stream; open that too");
  *value = is;
  return SPHC_OK;
}

}  // namespace sphc::openni2
