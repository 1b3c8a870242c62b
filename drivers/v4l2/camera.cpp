#include "camera.h"

#include <linux/videodev2.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "controls.h"
#include "drivers/pixels/convert.h"
#include "drivers/pixels/explain.h"

namespace sphc::v4l2 {

namespace {

using pixels::explain;

constexpr uint32_t kLeastBuffers = 2;  // one to fill while the other is read
constexpr int kMaxRounds = 64;         // of waiting within one acquire, should a device wake us for nothing

int64_t periodNs(const Mode &mode) {
  return mode.period_denominator ? int64_t{mode.period_numerator} * 1000000000 / mode.period_denominator : 0;
}

// Layouts that are the C interface's already.
bool isReadyMade(const Mode &mode, sphc_format format) {
  if (mode.pixel_format.is_jpeg) return false;
  const pixels::Layout layout = mode.pixel_format.layout;
  if (layout == pixels::Layout::Grey) return format == SPHC_FORMAT_GRAY8;
  const uint16_t one = 1;
  const bool is_little_endian = *reinterpret_cast<const uint8_t *>(&one) == 1;
  return layout == pixels::Layout::Depth16 && is_little_endian && mode.stride_bytes % 2 == 0;
}

}  // namespace

// ---- opening ---------------------------------------------------------------------------------------------------

sphc_status Camera::open(const char *path, const sphc_v4l2_config &config, sphc_message *message) {
  config_ = config;
  if (const int error = node_.open(path)) {
    const sphc_status status = node_.explain(message, "open", error);
    return status == SPHC_E_DEVICE_LOST ? SPHC_E_DEVICE : status;  // it was never ours
  }
  if (const int error = readCapability(node_, &capability_))
    return node_.explain(message, "VIDIOC_QUERYCAP", error);
  if (!capability_.is_capture || capability_.is_multi_planar || !capability_.can_stream)
    return explain(message, SPHC_E_UNSUPPORTED, "%s (%s) %s", node_.path(), capability_.card,
                   !capability_.is_capture       ? "captures no video; a camera has several nodes, take another"
                   : capability_.is_multi_planar ? "is multi-planar, which this driver cannot; use libcamera"
                                                 : "cannot stream, only read(); not supported");
  sphc_status status = negotiate(node_, config_, &mode_, message);
  if (status < 0) return status;
  const uint32_t least = config_.export_dmabuf ? config_.loan_limit + 1 : kLeastBuffers;
  status = ring_.make(config_.buffers, least, mode_.buffer_bytes, config_.export_dmabuf != 0, message);
  if (status < 0) return status;
  const bool can_lend = ring_.count() > config_.loan_limit;  // and the device still has one to fill
  is_zero_copy_ = can_lend && !config_.always_copy && isReadyMade(mode_, config_.format);
  subscribeEvents(node_);
  return makeSlots(message);
}

sphc_status Camera::makeSlots(sphc_message *message) {
  if (!decoder_.isReady()) return explain(message, SPHC_E_DEVICE, "out of memory for a JPEG decoder; free some");
  slot_stride_bytes_ = mode_.width * sphc_format_bytes(config_.format);
  if (is_zero_copy_) return SPHC_OK;
  for (uint32_t i = 0; i < config_.loan_limit; ++i) {
    loans_[i].pixels.reset(new (std::nothrow) uint8_t[size_t{slot_stride_bytes_} * mode_.height]());
    if (!loans_[i].pixels)
      return explain(message, SPHC_E_DEVICE, "out of memory for %u images of %u x %u pixels", config_.loan_limit,
                     mode_.width, mode_.height);
  }
  return SPHC_OK;
}

void Camera::getMode(sphc_v4l2_mode *mode) const {
  *mode = {};
  mode->struct_size = sizeof *mode;
  mode->fourcc = mode_.pixel_format.fourcc;
  mode->width = mode_.width;
  mode->height = mode_.height;
  mode->stride_bytes = mode_.stride_bytes;
  mode->period_numerator = mode_.period_numerator;
  mode->period_denominator = mode_.period_denominator;
  mode->adjusted = mode_.adjusted;
  mode->buffers = ring_.count();
  mode->zero_copy = is_zero_copy_;
  std::memcpy(mode->node, node_.path(), sizeof mode->node);
  std::memcpy(mode->card, capability_.card, sizeof mode->card);
  std::memcpy(mode->bus, capability_.bus, sizeof mode->bus);
  std::memcpy(mode->driver, capability_.driver, sizeof mode->driver);
}

// ---- failure ---------------------------------------------------------------------------------------------------

sphc_status Camera::fail(sphc_status status, const char *text) { return explain(&message_, status, "%s", text); }

sphc_status Camera::failCall(const char *call, int error) {
  const sphc_status status = node_.explain(&message_, call, error);
  if (status == SPHC_E_DEVICE_LOST)
    loss_ = message_;
  else
    ++stats_.device_errors;
  return status;
}

// ---- states ----------------------------------------------------------------------------------------------------

sphc_status Camera::start() {
  if (is_running_) return fail(SPHC_E_STATE, "start: running already; call stop first");
  if (loss_.text[0]) return fail(SPHC_E_DEVICE_LOST, loss_.text);
  counter_.restart();
  clock_.restart(node_.nowNs(), periodNs(mode_));
  readExposure();
  bad_frame_ = {};
  const sphc_status status = ring_.streamOn(&message_);
  if (status < 0) return status;
  is_running_ = true;
  return SPHC_OK;
}

void Camera::stop() {
  if (!is_running_) return;
  ring_.streamOff();
  is_running_ = false;
  for (Loan &loan : loans_) loan.token = 0;
}

void Camera::readExposure() { clock_.setExposure(readExposureUs(node_)); }

// ---- loans -----------------------------------------------------------------------------------------------------

Camera::Loan *Camera::freeLoan() {
  Loan *end = loans_ + config_.loan_limit;
  Loan *free = std::find_if(loans_, end, [](const Loan &loan) { return loan.token == 0; });
  return free == end ? nullptr : free;
}

const Camera::Loan *Camera::findLoan(const sphc_capture &capture) const {
  if (capture.token == 0) return nullptr;
  for (const Loan &loan : loans_)
    if (loan.token == capture.token && loan.data == capture.image.data) return &loan;
  return nullptr;
}

void Camera::release(const sphc_capture &capture) {
  Loan *loan = const_cast<Loan *>(findLoan(capture));
  if (!loan) return;
  if (loan->buffer != kNoBuffer) ring_.giveBack(loan->buffer);
  loan->token = 0;
}

sphc_status Camera::dmabuf(const sphc_capture &capture, int32_t *fd) const {
  const Loan *loan = findLoan(capture);
  if (!loan) return SPHC_E_ARGUMENT;
  if (loan->buffer == kNoBuffer || ring_.dmabuf(loan->buffer) < 0) return SPHC_E_UNSUPPORTED;
  *fd = ring_.dmabuf(loan->buffer);
  return SPHC_OK;
}

// ---- capturing -------------------------------------------------------------------------------------------------

sphc_status Camera::acquire(uint32_t timeout_us, sphc_capture *capture) {
  if (!capture) return fail(SPHC_E_ARGUMENT, "acquire: capture is null; give one");
  if (capture->struct_size != sizeof *capture)
    return fail(SPHC_E_STRUCT_SIZE,
                "acquire: capture->struct_size is none this library knows; set it to sizeof(sphc_capture)");
  if (!is_running_) return fail(SPHC_E_STATE, "acquire: not running; call start first");
  if (loss_.text[0]) return fail(SPHC_E_DEVICE_LOST, loss_.text);
  Loan *loan = freeLoan();
  if (!loan) return fail(SPHC_E_STATE, "acquire: loan_limit reached; release a capture first");

  const int64_t deadline_ns = node_.nowNs() + int64_t{timeout_us} * 1000;
  for (uint32_t tries = 0; tries <= ring_.count(); ++tries) {  // a whole ring of bad frames is enough for one call
    FilledBuffer filled;
    const sphc_status status = nextFilled(deadline_ns, &filled);
    if (status < 0) return status;
    if (status == SPHC_AGAIN) break;
    if (takeFrame(filled, loan, capture)) return SPHC_OK;
  }
  return explain(&message_, SPHC_AGAIN, "no good frame within %u us%s%s", timeout_us,
                 bad_frame_.text[0] ? "; last one left out: " : "", bad_frame_.text);
}

sphc_status Camera::nextFilled(int64_t deadline_ns, FilledBuffer *filled) {
  ring_.queueIdle();
  const sphc_status news = takeNews();
  if (news < 0) return news;
  for (int round = 0; round < kMaxRounds; ++round) {
    const int64_t asked_ns = node_.nowNs();
    const int error = ring_.dequeue(filled);
    if (error == EAGAIN) clock_.sawNoFrame(asked_ns);
    if (error == 0 && round == 0 && !ring_.deviceHasRoom()) ++stats_.starved;
    if (error == 0) return SPHC_OK;
    if (error == EIO && hasStreamEnded()) return checkAlive();
    if (error != EAGAIN) return failCall("VIDIOC_DQBUF", error);
    const sphc_status status = waitForFrame(deadline_ns);
    if (status != SPHC_OK) return status;
  }
  return SPHC_AGAIN;
}

// OK: look again.  AGAIN: time is up.
sphc_status Camera::waitForFrame(int64_t deadline_ns) {
  pollfd file = {node_.fd(), POLLIN | POLLPRI, 0};
  const Syscalls &syscalls = node_.syscalls();
  int ready = 0;
  do {  // signals cost no round
    const int64_t remaining_ns = deadline_ns - node_.nowNs();
    if (remaining_ns <= 0) return SPHC_AGAIN;
    ready = syscalls.poll(syscalls.self, &file, remaining_ns);
  } while (ready < 0 && errno == EINTR);
  if (ready < 0) return failCall("poll", errno);
  if (ready == 0) return SPHC_AGAIN;
  if (file.revents & POLLPRI) {
    const sphc_status status = takeNews();
    if (status != SPHC_OK) return status;
  }
  return file.revents & (POLLERR | POLLHUP | POLLNVAL) ? checkAlive() : SPHC_OK;
}

sphc_status Camera::takeNews() {
  const News news = readNews(node_);
  if (news.error) return failCall("VIDIOC_DQEVENT", news.error);
  if (news.exposure_changed) {
    ++stats_.control_changes;
    readExposure();
  }
  if (!news.source_changed) return SPHC_OK;
  explain(&loss_, SPHC_E_DEVICE_LOST, "%s: its signal has another size now; stop, close and open again",
          node_.path());
  return fail(SPHC_E_DEVICE_LOST, loss_.text);
}

// DQBUF says EIO of a stream that the kernel has given up, and does so until it is stopped; another EIO passes.
bool Camera::hasStreamEnded() const {
  pollfd file = {node_.fd(), POLLIN, 0};
  const Syscalls &syscalls = node_.syscalls();
  return syscalls.poll(syscalls.self, &file, 0) > 0 && (file.revents & POLLERR) != 0;
}

// After poll saw an error: unplugged, or a stream that the kernel has given up.
sphc_status Camera::checkAlive() {
  Capability capability;
  if (const int error = readCapability(node_, &capability)) return failCall("VIDIOC_QUERYCAP", error);
  ++stats_.device_errors;
  return explain(&message_, SPHC_E_DEVICE,
                 "%s: the kernel has stopped the stream after an error; stop and start again", node_.path());
}

bool Camera::takeFrame(const FilledBuffer &filled, Loan *loan, sphc_capture *capture) {
  const int64_t arrival_ns = node_.nowNs();
  sphc_capture taken = {};
  const bool is_good = countFrame(filled, &taken) && isWhole(filled) && fillImage(filled, *loan, &taken.image) &&
                       stampTime(filled, arrival_ns, &taken);
  if (!is_good || !is_zero_copy_) ring_.giveBack(filled.index);
  if (!is_good) return false;
  loan->token = ++last_token_;
  loan->data = taken.image.data;
  loan->buffer = is_zero_copy_ ? filled.index : kNoBuffer;
  ++stats_.captured;
  taken.struct_size = sizeof taken;
  taken.stream = config_.stream;
  taken.token = loan->token;
  *capture = taken;
  return true;
}

bool Camera::countFrame(const FilledBuffer &filled, sphc_capture *capture) {
  const FrameCounter::Step step = counter_.step(filled.sequence, filled.time_ns);
  capture->sequence = step.sequence;
  stats_.lost += step.lost;
  stats_.uncounted += step.kind == FrameCounter::Kind::kUncounted;
  if (step.kind != FrameCounter::Kind::kDuplicate) return true;
  ++stats_.duplicated;
  explain(&bad_frame_, SPHC_E_DEVICE, "frame %u: came before, with the same time; take the next", filled.sequence);
  return false;
}

bool Camera::stampTime(const FilledBuffer &filled, int64_t arrival_ns, sphc_capture *capture) {
  FrameClock::Stamp stamp;
  if (!clock_.stamp(filled.time_ns, filled.flags, arrival_ns, &stamp)) {
    ++stats_.time_refused;
    explain(&bad_frame_, SPHC_E_DEVICE, "frame %u: no later than the last one; take the next", filled.sequence);
    return false;
  }
  stats_.time_replaced += stamp.is_replaced;
  capture->time_ns = stamp.time_ns;
  capture->time_point = stamp.time_point;
  capture->exposure_us = stamp.exposure_us;
  capture->time_sigma_us = stamp.time_sigma_us;
  capture->clock = SPHC_CLOCK_MONOTONIC;
  capture->arrival_ns = arrival_ns;
  return true;
}

bool Camera::isWhole(const FilledBuffer &filled) {
  if (filled.flags & V4L2_BUF_FLAG_ERROR || filled.bytes_used > ring_.bytes(filled.index)) {
    ++stats_.corrupt;
    explain(&bad_frame_, SPHC_E_DEVICE, "frame %u: the kernel says that its data are damaged; take the next",
            filled.sequence);
    return false;
  }
  if (mode_.pixel_format.is_jpeg) return true;  // the decoder sees
  const pixels::RawImage raw = mode_.rawImage(ring_.data(filled.index), filled.bytes_used);
  if (pixels::checkRaw(raw, &bad_frame_) == SPHC_OK) return true;
  ++stats_.short_frames;
  return false;
}

bool Camera::fillImage(const FilledBuffer &filled, const Loan &loan, sphc_image *image) {
  *image = {loan.pixels.get(), mode_.width, mode_.height, slot_stride_bytes_, config_.format};
  if (is_zero_copy_) {
    image->data = ring_.data(filled.index);
    image->stride_bytes = mode_.stride_bytes;
    return true;
  }
  const size_t slot_bytes = size_t{slot_stride_bytes_} * mode_.height;
  return convertInto(
      filled, {loan.pixels.get(), slot_bytes, mode_.width, mode_.height, slot_stride_bytes_, config_.format});
}

bool Camera::convertInto(const FilledBuffer &filled, const pixels::OutImage &out) {
  const uint8_t *data = ring_.data(filled.index);
  const sphc_status status = mode_.pixel_format.is_jpeg
                                 ? decoder_.decode(data, filled.bytes_used, out, &bad_frame_)
                                 : pixels::convert(mode_.rawImage(data, filled.bytes_used), out, &bad_frame_);
  stats_.corrupt += status < 0;
  return status == SPHC_OK;
}

}  // namespace sphc::v4l2
