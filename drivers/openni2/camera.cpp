#include "camera.h"

#include <algorithm>

#include "explain.h"
#include "frame_check.h"

namespace sphc::openni2 {

namespace {

using Lock = std::lock_guard<std::mutex>;

}  // namespace

// ---- open, close ----

sphc_status Camera::open(const char *uri, const sphc_openni2_config &config, sphc_message *message) {
  config_ = config;
  sphc_status status = library_.start(message);
  if (status == SPHC_OK) status = startReader(message);
  if (status != SPHC_OK) return status;
  copyText(uri_, uri);
  if (!enroll(uri_))
    return explain(message, SPHC_E_DEVICE, "%.80s is open in this process already; close it there first", uri_);
  status = openDevice(message);
  if (status != SPHC_OK) return status;
  info_.struct_size = sizeof info_;
  device_.describe(&info_);
  const size_t buffer_bytes = std::max(device_.frameBytes(kColor), device_.frameBytes(kDepth));
  if (!queue_.open(config_.loan_limit, buffer_bytes))
    return explain(message, SPHC_E_DEVICE, "out of memory: %u buffers of %zu bytes; lower loan_limit or the modes",
                   config_.loan_limit, buffer_bytes);
  return SPHC_OK;
}

Camera::~Camera() {
  stop();
  closeDevice();
  resign();
}

sphc_status Camera::openDevice(sphc_message *message) {
  const sphc_status status = device_.open(uri_, config_, message);
  return status == SPHC_OK && !device_.isRecording() ? listen(message) : status;
}

// A callback that is still running when its stream goes is killed by OpenNI2: ours are short, and ended before.
void Camera::closeDevice() {
  listeners_.removeAll();
  withdraw();
  device_.close();
}

sphc_status Camera::listen(sphc_message *message) {
  for (int stream = 0; stream < kStreams; ++stream)
    if (device_.has(stream) && !listeners_.add(device_.stream(stream), onNewFrame, this))
      return explain(message, SPHC_E_DEVICE, "OpenNI2 refuses to tell of new frames (%s); open the device again",
                     LibraryError().text);
  return SPHC_OK;
}

// ---- the source ----

sphc_status Camera::start() {
  if (running_) return explain(&message_, SPHC_E_STATE, "start: running already; call stop first");
  if (gone_)
    return explain(&message_, SPHC_E_DEVICE_LOST, "start: the device was unplugged; close, and open it again");
  if (played_) {  // a recording cannot be rewound
    device_.close();
    const sphc_status status = openDevice(&message_);
    if (status != SPHC_OK) return status;  // the next start tries again
    if (!isAsOpened()) {
      device_.close();
      return explain(&message_, SPHC_E_DEVICE, "start: %.80s is another recording now; close, and open it again",
                     uri_);
    }
  }
  silent_ns_ = 0;
  std::fill(last_index_, last_index_ + kStreams, -1);
  const QueueConfig config = queueConfig();
  {
    const Lock lock(reading_);
    timeline_.start(config.is_recording, config.period_ns);
    queue_.start(config);
  }
  running_ = true;
  played_ = config.is_recording;
  const sphc_status status = device_.start(&message_);
  if (status != SPHC_OK) stop();
  const Lock lock(reading_);
  listening_ = status == SPHC_OK;
  return status;
}

// A file may have been written anew since, with images that do not fit the buffers.
bool Camera::isAsOpened() const {
  sphc_openni2_info now = {};
  device_.describe(&now);
  const auto same = [](const sphc_openni2_mode &a, const sphc_openni2_mode &b) {
    return a.width == b.width && a.height == b.height && a.frames_per_s == b.frames_per_s;
  };
  return device_.isRecording() && same(now.color, info_.color) && same(now.depth, info_.depth) &&
         now.color_format == info_.color_format && now.depth_unit_m == info_.depth_unit_m;
}

QueueConfig Camera::queueConfig() const {
  QueueConfig config = {};
  config.is_recording = device_.isRecording();
  for (int stream = 0; stream < kStreams; ++stream) {
    config.runs[stream] = device_.has(stream);
    if (!device_.has(stream)) continue;
    config.period_ns[stream] = periodNs(stream);
    config.order_wait_ns = std::max(config.order_wait_ns, config.period_ns[stream]);
  }
  if (config_.order_wait_us != 0) config.order_wait_ns = int64_t{config_.order_wait_us} * 1000;
  config.stall_ns = int64_t{config_.stall_us} * 1000;
  return config;
}

sphc_status Camera::acquire(uint32_t timeout_us, sphc_capture *capture) {
  if (!capture) return explain(&message_, SPHC_E_ARGUMENT, "acquire: capture is null; give one");
  if (capture->struct_size != sizeof *capture)
    return explain(&message_, SPHC_E_STRUCT_SIZE, "acquire: set capture.struct_size to sizeof(sphc_capture)");
  const int64_t until_ns = monotonicNs() + int64_t{timeout_us} * 1000;
  if (running_ && device_.isRecording()) return acquireFromFile(until_ns, capture);
  return queue_.take(until_ns, capture, &message_);
}

void Camera::stop() {
  if (!running_) return;
  running_ = false;
  {  // from here nothing is read: a read whose frame OpenNI2's stop has cleared would wait for ever
    const Lock lock(reading_);
    listening_ = false;
  }
  if (!device_.isRecording()) device_.stop();  // a file waits until it is asked again, and is closed as it is
  const Lock lock(reading_);
  queue_.stop();
}

void Camera::onGone() {
  gone_ = true;
  queue_.deviceGone();
}

void Camera::onState(OniDeviceState state) {
  if (state == ONI_DEVICE_STATE_ERROR)
    queue_.report(SPHC_E_DEVICE, "acquire: the device reports a failure; if captures stay away, unplug it");
  if (state == ONI_DEVICE_STATE_NOT_READY)
    queue_.report(SPHC_E_DEVICE, "acquire: the device reports that it is not ready; wait, or unplug it");
}

// ---- frames ----

// On a thread of OpenNI2, one a stream.
void ONI_CALLBACK_TYPE Camera::onNewFrame(OniStreamHandle, void *camera) { static_cast<Camera *>(camera)->ask(); }

void Camera::read() {
  const Lock lock(reading_);
  if (!listening_) return;
  OniStreamHandle handles[kStreams];
  int streams[kStreams], index = 0;
  const int count = device_.listStreams(handles, streams);
  // Reading without a frame would block, perhaps for ever.
  while (oniWaitForAnyStream(handles, count, &index, 0) == ONI_STATUS_OK)
    if (!readOne(streams[index])) return;
}

sphc_status Camera::acquireFromFile(int64_t until_ns, sphc_capture *capture) {
  for (;;) {
    const sphc_status status = queue_.take(0, capture, &message_);
    if (status != SPHC_AGAIN || !readFromFile(until_ns)) return status;
  }
}

// True when the queue may have more: a frame, the end, or the news that the file is silent.  False: the time is
// over.
bool Camera::readFromFile(int64_t until_ns) {
  const int64_t before_ns = monotonicNs(), limit_ns = int64_t{config_.stall_us} * 1000;
  const bool is_told = silent_ns_ >= limit_ns;
  const int64_t silent_at_ns = before_ns + limit_ns - silent_ns_;
  if (device_.player().await(is_told ? until_ns : std::min(until_ns, silent_at_ns))) {
    silent_ns_ = 0;
    onReader([&] {
      const Lock lock(reading_);
      readOne(device_.player().take());
    });
    return true;
  }
  silent_ns_ += monotonicNs() - before_ns;
  if (is_told || silent_ns_ < limit_ns) return false;
  queue_.report(
      SPHC_E_DEVICE,
      "acquire: the recording gives no more frames and does not end: it is cut short, damaged, or was made "
      "of a device without the cropping property; record it anew");
  return true;
}

// The first frame of a stream once more: the player is through, and repeats.
bool Camera::beginsAnew(int stream, const OniFrame &frame) {
  const bool is_first = last_index_[stream] < 0;
  if (is_first) first_index_[stream] = frame.frameIndex;
  const bool anew =
      !is_first && (frame.frameIndex < last_index_[stream] || frame.frameIndex == first_index_[stream]);
  last_index_[stream] = frame.frameIndex;
  return anew;
}

bool Camera::readOne(int stream) {
  OniFrame *frame = nullptr;
  if (oniStreamReadFrame(device_.stream(stream), &frame) != ONI_STATUS_OK || !frame) return false;
  if (!device_.isRecording())
    accept(stream, *frame, monotonicNs());
  else if (beginsAnew(stream, *frame))
    queue_.endReached();
  else
    accept(stream, *frame, 0);
  oniFrameRelease(frame);
  return true;
}

void Camera::accept(int stream, const OniFrame &frame, int64_t arrival_ns) {
  const Place place = timeline_.place(stream, frame.frameIndex, frame.timestamp, arrival_ns);
  sphc_message trouble = {};
  const bool fits = checkFrame(frame, stream, device_.mode(stream), &trouble) == SPHC_OK;
  queue_.count(stream, [&](sphc_openni2_counts &counts) {
    counts.duplicated += place.duplicate;
    counts.lost += place.lost;
    counts.clock_jumps += place.clock_jumped;
    counts.bad += !place.duplicate && !fits;
  });
  if (place.duplicate) return;
  if (place.clock_jumped) {
    sphc_message jump = {};
    explain(&jump, SPHC_E_DEVICE,
            "acquire: the device's clock jumped before %s frame %d, to %llu us; times go on where they were",
            kStreamNames[stream], frame.frameIndex, static_cast<unsigned long long>(frame.timestamp));
    queue_.report(SPHC_E_DEVICE, jump.text);
  }
  if (!fits) return queue_.report(SPHC_E_IMAGE, trouble.text);
  const sphc_capture capture = makeCapture(stream, place, arrival_ns);
  queue_.push(stream, capture,
              {static_cast<const uint8_t *>(frame.data), capture.image.stride_bytes,
               static_cast<size_t>(frame.stride), capture.image.height});
}

sphc_capture Camera::makeCapture(int stream, const Place &place, int64_t arrival_ns) const {
  const OniVideoMode &mode = device_.mode(stream);
  const sphc_format format = formatOf(mode.pixelFormat);
  const uint32_t width = static_cast<uint32_t>(mode.resolutionX), height = static_cast<uint32_t>(mode.resolutionY);
  const uint32_t period_us = static_cast<uint32_t>(periodNs(stream) / 1000);
  sphc_capture capture = {};
  capture.struct_size = sizeof capture;
  capture.stream = streamId(stream);
  capture.time_ns = place.time_ns;
  capture.sequence = place.sequence;
  capture.time_point = config_.time_point;
  capture.image = {nullptr, width, height, width * sphc_format_bytes(format), format};
  capture.arrival_ns = arrival_ns;
  // What a recording loses of the time between its streams is up to a period.
  const uint32_t sigma_us = config_.time_sigma_us != 0 ? config_.time_sigma_us : period_us / 2;
  capture.time_sigma_us = device_.isRecording() ? std::max(sigma_us, period_us) : sigma_us;
  capture.clock = SPHC_CLOCK_SOURCE;
  return capture;
}

}  // namespace sphc::openni2
