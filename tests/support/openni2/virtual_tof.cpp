#include "virtual_tof.h"

#include <OniCProperties.h>
#include <PS1080.h>
#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <thread>

// ONI_EXPORT_DRIVER speaks of XnLib, which is not packaged.
#define XN_NEW(Type, argument) new Type(argument)
#define XN_DELETE(object) delete (object)
#include <Driver/OniDriverAPI.h>

using oni::driver::DeviceBase;
using oni::driver::DriverBase;
using oni::driver::StreamBase;

namespace sphc::vtof {

namespace {

OniVideoMode color_modes[] = {{ONI_PIXEL_FORMAT_YUV422, 640, 480, 30}, {ONI_PIXEL_FORMAT_RGB888, 640, 480, 30},
                              {ONI_PIXEL_FORMAT_RGB888, 320, 240, 30}, {ONI_PIXEL_FORMAT_RGB888, 320, 240, 60},
                              {ONI_PIXEL_FORMAT_GRAY8, 320, 240, 30},  {ONI_PIXEL_FORMAT_GRAY8, 160, 120, 15}};
OniVideoMode depth_modes[] = {
    {ONI_PIXEL_FORMAT_SHIFT_9_2, 640, 480, 30},   {ONI_PIXEL_FORMAT_DEPTH_1_MM, 640, 480, 30},
    {ONI_PIXEL_FORMAT_DEPTH_1_MM, 320, 240, 30},  {ONI_PIXEL_FORMAT_DEPTH_1_MM, 320, 288, 30},
    {ONI_PIXEL_FORMAT_DEPTH_1_MM, 200, 160, 30},  {ONI_PIXEL_FORMAT_DEPTH_1_MM, 320, 240, 60},
    {ONI_PIXEL_FORMAT_DEPTH_100_UM, 320, 240, 15}};
template <typename Modes>
constexpr int count(const Modes &modes) {
  return static_cast<int>(sizeof modes / sizeof modes[0]);
}

class Stream;
constexpr uint8_t kStuffing = 0xee;

// What of a device outlives its being opened.
struct Socket {
  std::mutex mutex;         // of all that follows; held while a frame is handed over, so that stop() waits for it
  Stream *streams[2] = {};  // opened: colour, depth
  Faults faults = {};
  bool plugged = true;
  int registration = ONI_IMAGE_REGISTRATION_OFF;
  OniDeviceInfo info = {};
  std::atomic<bool> running{false};
  std::thread runner;
};

Socket sockets[kDevices];

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
// What the recording player leaks as it is loaded can be suppressed by name only while it is still there at the
// end.
const void *const player = dlopen("libOniFile.so.0", RTLD_NOW | RTLD_NODELETE);
#endif
#endif

class Driver;
Driver *driver = nullptr;
std::atomic<int> synced_streams{0};

int slotOf(OniSensorType sensor) { return sensor == ONI_SENSOR_COLOR ? 0 : 1; }

int bytesPerPixel(OniPixelFormat format) {
  return format == ONI_PIXEL_FORMAT_RGB888 ? 3 : format == ONI_PIXEL_FORMAT_GRAY8 ? 1 : 2;
}

template <typename Value>
OniStatus give(const Value &value, void *data, int *bytes) {
  if (*bytes < static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof value);
  *bytes = sizeof value;
  return ONI_STATUS_OK;
}

template <typename Value>
OniStatus take(const void *data, int bytes, Value *value) {
  if (bytes != static_cast<int>(sizeof *value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(value, data, sizeof *value);
  return ONI_STATUS_OK;
}

class Stream final : public StreamBase {
 public:
  Stream(OniSensorType sensor, Socket &socket)
      : sensor_(sensor), socket_(socket), mode_(sensor == ONI_SENSOR_COLOR ? color_modes[2] : depth_modes[2]) {
    const std::lock_guard<std::mutex> lock(socket_.mutex);
    socket_.streams[slotOf(sensor)] = this;
  }
  ~Stream() override {
    const std::lock_guard<std::mutex> lock(socket_.mutex);
    socket_.streams[slotOf(sensor_)] = nullptr;
  }

  OniStatus start() override {
    const std::lock_guard<std::mutex> lock(socket_.mutex);
    if (!socket_.plugged || socket_.faults.does_not_start) return ONI_STATUS_ERROR;
    started_ = true;
    return ONI_STATUS_OK;
  }
  void stop() override {
    const std::lock_guard<std::mutex> lock(socket_.mutex);
    started_ = false;
  }

  // Under the socket's mutex.
  bool emit(const Frame &wanted) {
    if (!started_) return false;
    OniFrame *frame = getServices().acquireFrame();
    if (!frame) return false;
    describe(wanted, frame);
    draw(wanted, static_cast<uint8_t *>(frame->data));
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
    return true;
  }

  int getRequiredFrameSize() override { return 2 * getServices().getDefaultRequiredFrameSize(); }

  OniStatus getProperty(int id, void *data, int *bytes) override {
    const bool is_color = sensor_ == ONI_SENSOR_COLOR;
    switch (id) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return give(mode_, data, bytes);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return give(1.0f, data, bytes);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return give(0.8f, data, bytes);
      case ONI_STREAM_PROPERTY_MAX_VALUE:
        return give(10000, data, bytes);
      case ONI_STREAM_PROPERTY_MIN_VALUE:
        return give(0, data, bytes);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give(mirrored_, data, bytes);
      // Without it a recording of this stream plays back without frames.
      case ONI_STREAM_PROPERTY_CROPPING:
        return give(cropping_, data, bytes);
      case XN_STREAM_PROPERTY_DCMOS_RCMOS_DISTANCE:
        return is_color ? ONI_STATUS_NOT_SUPPORTED : give(2.5, data, bytes);
      case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
        return is_color ? give(auto_exposure_, data, bytes) : ONI_STATUS_NOT_SUPPORTED;
      case ONI_STREAM_PROPERTY_EXPOSURE:
        return is_color ? give(exposure_, data, bytes) : ONI_STATUS_NOT_SUPPORTED;
      default:
        return ONI_STATUS_NOT_SUPPORTED;  // no gain, no white balance
    }
  }

  OniStatus setProperty(int id, const void *data, int bytes) override {
    int ignored = 0;
    switch (id) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return setMode(data, bytes);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return take(data, bytes, socket_.faults.stays_mirrored ? &ignored : &mirrored_);
      case ONI_STREAM_PROPERTY_CROPPING:
        return take(data, bytes, &cropping_);
      case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
        return take(data, bytes, &auto_exposure_);
      case ONI_STREAM_PROPERTY_EXPOSURE:
        return take(data, bytes, socket_.faults.keeps_exposure ? &ignored : &exposure_);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }

  OniBool isPropertySupported(int id) override {
    char data[64];
    int bytes = sizeof data;
    return getProperty(id, data, &bytes) == ONI_STATUS_OK;
  }

  // A recorder writes down what it is told here.
  void notifyAllProperties() override {
    for (const int id :
         {ONI_STREAM_PROPERTY_VIDEO_MODE, ONI_STREAM_PROPERTY_HORIZONTAL_FOV, ONI_STREAM_PROPERTY_VERTICAL_FOV,
          ONI_STREAM_PROPERTY_MAX_VALUE, ONI_STREAM_PROPERTY_CROPPING}) {
      char data[64];
      int bytes = sizeof data;
      if (getProperty(id, data, &bytes) == ONI_STATUS_OK) raisePropertyChanged(id, data, bytes);
    }
  }

 private:
  OniStatus setMode(const void *data, int bytes) {
    OniVideoMode wanted;
    if (take(data, bytes, &wanted) != ONI_STATUS_OK) return ONI_STATUS_BAD_PARAMETER;
    if (socket_.faults.refuses_modes) return ONI_STATUS_ERROR;
    mode_ = wanted;
    if (socket_.faults.grants_another_mode) mode_.resolutionX /= 2, mode_.resolutionY /= 2;
    return ONI_STATUS_OK;
  }

  size_t rowBytes() const { return static_cast<size_t>(mode_.resolutionX * bytesPerPixel(mode_.pixelFormat)); }
  size_t rows() const { return static_cast<size_t>(mode_.resolutionY); }
  // Rows as long as the frame says, if there is room for them.
  size_t drawnStride(const Frame &wanted) const {
    const bool fits = wanted.stride_bytes > 0 && static_cast<size_t>(wanted.stride_bytes) <= 2 * rowBytes();
    return fits ? std::max(static_cast<size_t>(wanted.stride_bytes), rowBytes()) : rowBytes();
  }

  // The mode's pixels, whatever else the frame claims; longer rows are stuffed.
  void draw(const Frame &wanted, uint8_t *bytes) const {
    for (size_t y = 0; y < rows(); ++y) {
      uint8_t *row = bytes + y * drawnStride(wanted);
      std::memset(row, kStuffing, drawnStride(wanted));
      if (wanted.pixels) {
        std::memcpy(row, static_cast<const uint8_t *>(wanted.pixels) + y * rowBytes(), rowBytes());
        continue;
      }
      for (size_t i = 0; i < rowBytes(); ++i) row[i] = pattern(sensor_, wanted.index, y * rowBytes() + i);
    }
  }

  void describe(const Frame &wanted, OniFrame *frame) const {
    const auto orElse = [](int value, size_t otherwise) {
      return value != 0 ? value : static_cast<int>(otherwise);
    };
    frame->sensorType = sensor_;
    frame->frameIndex = wanted.index;
    frame->timestamp = wanted.timestamp_us;
    frame->width = orElse(wanted.width, static_cast<size_t>(mode_.resolutionX));
    frame->height = orElse(wanted.height, rows());
    frame->stride = orElse(wanted.stride_bytes, rowBytes());
    frame->dataSize = orElse(wanted.data_bytes, drawnStride(wanted) * rows());
    frame->videoMode = mode_;
    if (wanted.format != 0) frame->videoMode.pixelFormat = wanted.format;
    frame->croppingEnabled = FALSE;
    frame->cropOriginX = frame->cropOriginY = 0;
  }

  OniSensorType sensor_;
  Socket &socket_;
  OniVideoMode mode_;
  bool started_ = false;
  OniBool mirrored_ = TRUE;  // as PrimeSense's devices are
  OniCropping cropping_ = {TRUE, 8, 8, 64, 48};
  OniBool auto_exposure_ = TRUE;
  int exposure_ = 100;
};

class Device final : public DeviceBase {
 public:
  explicit Device(Socket &socket) : socket_(socket) {
    sensors_[0] = {ONI_SENSOR_COLOR, count(color_modes), color_modes};
    sensors_[1] = {ONI_SENSOR_DEPTH, count(depth_modes), depth_modes};
  }

  OniStatus getSensorInfoList(OniSensorInfo **sensors, int *number) override {
    *sensors = sensors_;
    *number = 2;
    return ONI_STATUS_OK;
  }
  StreamBase *createStream(OniSensorType sensor) override {
    return sensor == ONI_SENSOR_COLOR || sensor == ONI_SENSOR_DEPTH ? new Stream(sensor, socket_) : nullptr;
  }
  void destroyStream(StreamBase *stream) override { delete stream; }

  OniStatus getProperty(int id, void *data, int *bytes) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || socket_.faults.cannot_register)
      return ONI_STATUS_NOT_SUPPORTED;
    return give(socket_.registration, data, bytes);
  }
  OniStatus setProperty(int id, const void *data, int bytes) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION || socket_.faults.cannot_register)
      return ONI_STATUS_NOT_SUPPORTED;
    int ignored = 0;
    return take(data, bytes, socket_.faults.ignores_registration ? &ignored : &socket_.registration);
  }
  OniBool isPropertySupported(int id) override { return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION; }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override {
    return !socket_.faults.cannot_register;
  }
  OniStatus tryManualTrigger() override { return ONI_STATUS_OK; }

 private:
  Socket &socket_;
  OniSensorInfo sensors_[2];
};

class Driver final : public DriverBase {
 public:
  explicit Driver(OniDriverServices *services) : DriverBase(services) { driver = this; }
  ~Driver() override { driver = nullptr; }

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed, void *cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    for (int i = 0; i < kDevices; ++i) {
      OniDeviceInfo &info = sockets[i].info;
      std::snprintf(info.uri, sizeof info.uri, "%s", uri(i));
      std::snprintf(info.vendor, sizeof info.vendor, "SphereCloud");
      std::snprintf(info.name, sizeof info.name, "virtual ToF camera %d", i);
      if (sockets[i].plugged) deviceConnected(&info);
    }
    return ONI_STATUS_OK;
  }
  void shutdown() override {}

  DeviceBase *deviceOpen(const char *its_uri, const char *) override {
    for (Socket &socket : sockets)
      if (!std::strcmp(socket.info.uri, its_uri))
        return socket.plugged && !socket.faults.does_not_open ? new Device(socket) : nullptr;
    return nullptr;
  }
  void deviceClose(DeviceBase *device) override { delete device; }
  OniStatus tryDevice(const char *) override { return ONI_STATUS_ERROR; }

  void *enableFrameSync(StreamBase **, int number) override {
    for (Socket &socket : sockets)
      if (socket.faults.refuses_sync) return nullptr;
    synced_streams = number;
    return this;
  }
  void disableFrameSync(void *) override { synced_streams = 0; }

  void tellConnected(Socket &socket) { deviceConnected(&socket.info); }
  void tellDisconnected(Socket &socket) { deviceDisconnected(&socket.info); }
  void tellState(Socket &socket, OniDeviceState state) { deviceStateChanged(&socket.info, state); }
};

template <typename Tell>
void onAThread(Tell tell) {
  if (driver) std::thread(tell).join();
}

}  // namespace

void reset() {
  for (int i = 0; i < kDevices; ++i) {
    run(i, false);
    plug(i);
    const std::lock_guard<std::mutex> lock(sockets[i].mutex);
    sockets[i].faults = {};
    sockets[i].registration = ONI_IMAGE_REGISTRATION_OFF;
  }
}

void setFaults(int device, const Faults &faults) {
  const std::lock_guard<std::mutex> lock(sockets[device].mutex);
  sockets[device].faults = faults;
}

void unplug(int device) {
  Socket &socket = sockets[device];
  run(device, false);
  {
    const std::lock_guard<std::mutex> lock(socket.mutex);
    if (!socket.plugged) return;
    socket.plugged = false;
  }
  onAThread([&] { driver->tellDisconnected(socket); });
}

void plug(int device) {
  Socket &socket = sockets[device];
  {
    const std::lock_guard<std::mutex> lock(socket.mutex);
    if (socket.plugged) return;
    socket.plugged = true;
  }
  onAThread([&] { driver->tellConnected(socket); });
}

void changeState(int device, OniDeviceState state) {
  onAThread([&] { driver->tellState(sockets[device], state); });
}

bool emit(int device, const Frame &frame) {
  Socket &socket = sockets[device];
  const std::lock_guard<std::mutex> lock(socket.mutex);
  Stream *stream = socket.streams[slotOf(frame.sensor)];
  return socket.plugged && stream && stream->emit(frame);
}

void emitPair(int device, int index, uint64_t depth_lag_us) {
  const uint64_t time_us = static_cast<uint64_t>(index) * kPeriodUs;
  emit(device, {ONI_SENSOR_COLOR, index, time_us, nullptr, 0, 0, 0, 0, OniPixelFormat{}});
  emit(device, {ONI_SENSOR_DEPTH, index, time_us + depth_lag_us, nullptr, 0, 0, 0, 0, OniPixelFormat{}});
}

void run(int device, bool on) {
  Socket &socket = sockets[device];
  socket.running = false;
  if (socket.runner.joinable()) socket.runner.join();
  if (!on) return;
  socket.running = true;
  socket.runner = std::thread([device, &socket] {
    for (int index = 1; socket.running; ++index) {
      emitPair(device, index, 5000);
      std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
  });
}

bool registered(int device) {
  const std::lock_guard<std::mutex> lock(sockets[device].mutex);
  return sockets[device].registration != ONI_IMAGE_REGISTRATION_OFF;
}

int syncedStreams() { return synced_streams; }

}  // namespace sphc::vtof

ONI_EXPORT_DRIVER(sphc::vtof::Driver)
