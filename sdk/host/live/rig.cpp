#include "host/live/rig.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "host/base/checked_call.h"
#include "host/recording/calibration_json.h"

namespace sphc::host {
namespace {

constexpr std::chrono::milliseconds kTurn(2);  // with two cameras: how long one is waited for
constexpr std::chrono::seconds kRetry(1);
constexpr uint32_t kFailures = 10;       // in a row: the camera is closed and opened again
constexpr uint32_t kMostCaptures = 200;  // that come without a pair, before the caller hears of it

int64_t nowNs(clockid_t clock) {
  timespec now = {};
  clock_gettime(clock, &now);
  return int64_t{now.tv_sec} * 1000000000 + now.tv_nsec;
}

// Of a time and of the mapping that brought it to another clock, which know nothing of each other.
uint32_t jointSigmaUs(uint32_t time_sigma_us, int64_t mapping_sigma_ns) {
  const double sigma_us = std::round(std::hypot(time_sigma_us, static_cast<double>(mapping_sigma_ns) / 1000));
  return static_cast<uint32_t>(std::min<double>(sigma_us, UINT32_MAX));
}

// Of a camera of one stream, where none was said: colour and depth may have two sizes.
void chooseSize(Wish *wish) {
  if (wish->width && wish->height) return;
  uint32_t width = 640, height = 480;
  if (!wish->calibration.empty()) {
    const sphc_rig calibration = recording::readCalibration(wish->calibration);
    const sphc_camera &camera = wish->depth ? calibration.depth_camera : calibration.color_camera;
    width = camera.width;
    height = camera.height;
  }
  if (!wish->width) wish->width = width;
  if (!wish->height) wish->height = height;
}

}  // namespace

Rig::Rig(const RigOptions &options, Tell trouble)
    : options_(options), trouble_(std::move(trouble)), unreadable_(trouble_) {
  if (!options.both.empty()) {
    add(options.both, true, true);
  } else {
    add(options.color, true, false);
    add(options.depth, false, true);
  }
  makePairer();
  // What a camera sends while another one is being opened would be lost.
  for (Camera &camera : cameras_) camera.device = options_.open(camera.spec, camera.wish);
  for (Camera &camera : cameras_) start(&camera);
}

Rig::~Rig() {
  for (Camera &camera : cameras_)
    if (camera.device) camera.device->source().stop(camera.device->source().self);
}

void Rig::add(const std::string &spec, bool color, bool depth) {
  Camera camera;
  camera.spec = spec;
  camera.wish = options_.wish;
  camera.wish.color = color;
  camera.wish.depth = depth;
  camera.wish.tolerance_ms = options_.tolerance_ms;
  if (!(color && depth)) {
    chooseSize(&camera.wish);
    camera.wish.at_once = false;  // arrivals tell how the clocks of two cameras lie to each other
  }
  sphc_memory need = {};
  sphc_clock_mapper_memory(&need);
  camera.mapper_memory.resize(need.state_bytes / sizeof(uint64_t) + 1);
  sphc_clock_mapper_config config;
  sphc_clock_mapper_config_init(&config, sizeof config);
  orThrow("clock mapper", [&](sphc_message *message) {
    return sphc_clock_mapper_init(camera.mapper_memory.data(), need.state_bytes, &config, &camera.mapper, message);
  });
  cameras_.push_back(std::move(camera));
}

void Rig::start(Camera *camera) {
  const sphc_source &source = camera->device->source();
  if (source.start(source.self) < 0) throw std::runtime_error(camera->spec + ": " + source.message(source.self));
}

void Rig::makePairer() {
  sphc_memory need = {};
  sphc_pairer_memory(&need);
  pairer_memory_.resize(need.state_bytes / sizeof(uint64_t) + 1);
  sphc_pairer_config config;
  sphc_pairer_config_init(&config, sizeof config);
  config.slots = kLoans - 2;
  config.tolerance_ns = static_cast<int64_t>(options_.tolerance_ms * 1e6);
  orThrow("pairer", [&](sphc_message *message) {
    return sphc_pairer_init(pairer_memory_.data(), need.state_bytes, &config, &pairer_, message);
  });
}

Rig::Camera &Rig::cameraOf(sphc_stream stream) {
  return stream == SPHC_STREAM_COLOR ? cameras_.front() : cameras_.back();
}

void Rig::giveBack(const sphc_capture &capture) {
  const Camera &camera = cameraOf(capture.stream);
  if (camera.device) camera.device->source().release(camera.device->source().self, &capture);
}

void Rig::release(const CapturePair &pair) {
  giveBack(pair.color);
  giveBack(pair.depth);
}

bool Rig::pop(CapturePair *pair) {
  for (;;) {
    sphc_capture dropped = {};
    if (sphc_pairer_pop(pairer_, &pair->color, &pair->depth, &dropped) == SPHC_OK) return true;
    if (dropped.stream == SPHC_STREAM_NONE) return false;
    giveBack(dropped);
  }
}

Rig::Got Rig::next(std::chrono::milliseconds timeout, CapturePair *pair) {
  const Clock::time_point until = Clock::now() + timeout;
  bool came = false;
  uint32_t captures = 0;
  do {
    came = false;
    if (pop(pair)) return Got::kPair;
    const bool over = std::all_of(cameras_.begin(), cameras_.end(), [](const Camera &c) { return c.ended; });
    if (over && flushed_) return Got::kEnd;
    if (over) {
      sphc_pairer_flush(pairer_);
      flushed_ = true;
      continue;
    }
    const auto left = std::chrono::duration_cast<std::chrono::microseconds>(until - Clock::now());
    const auto turn = cameras_.size() == 1 ? left : std::min<std::chrono::microseconds>(left, kTurn);
    for (Camera &camera : cameras_)
      came = acquireFrom(&camera, std::max(turn, std::chrono::microseconds(0))) || came;
    captures += came;
  } while ((came && captures < kMostCaptures) || Clock::now() < until || flushed_);
  return pop(pair) ? Got::kPair : Got::kNothing;
}

bool Rig::acquireFrom(Camera *camera, std::chrono::microseconds timeout) {
  if (camera->ended) return false;
  if (!camera->device) tryAgain(camera);
  if (!camera->device) {
    const auto until_retry = std::chrono::duration_cast<std::chrono::microseconds>(camera->retry - Clock::now());
    std::this_thread::sleep_for(std::min(timeout, until_retry));
    return false;
  }
  const sphc_source &source = camera->device->source();
  sphc_capture capture = {};
  capture.struct_size = sizeof capture;
  const sphc_status status = source.acquire(source.self, static_cast<uint32_t>(timeout.count()), &capture);
  if (status == SPHC_AGAIN) return false;
  camera->ended = status == SPHC_END;
  if (status < 0 && status != SPHC_E_DEVICE_LOST) unreadable_(camera->spec + ": " + source.message(source.self));
  camera->failures = status < 0 ? camera->failures + 1 : 0;
  if (status == SPHC_E_DEVICE_LOST || (camera->failures > kFailures && !camera->device->waits())) lose(camera);
  if (status != SPHC_OK) return false;
  cameras_.size() > 1 ? bringToHostClock(camera, &capture) : keepTimeGoing(camera, &capture);
  if (watcher_) watcher_(capture);
  // A clock that was set may bring a time that does not grow.
  if (sphc_pairer_push(pairer_, &capture) != SPHC_OK) giveBack(capture);
  return true;
}

// A device's own clock may begin again when it is plugged in again; what records goes on.
void Rig::keepTimeGoing(Camera *camera, sphc_capture *capture) {
  if (capture->clock != SPHC_CLOCK_SOURCE) return;
  const int64_t now_ns = nowNs(CLOCK_MONOTONIC);
  if (camera->reopened) camera->shift_ns = camera->last_ns + (now_ns - camera->last_arrival_ns) - capture->time_ns;
  camera->reopened = false;
  capture->time_ns += camera->shift_ns;
  camera->last_ns = std::max(camera->last_ns, capture->time_ns);
  camera->last_arrival_ns = now_ns;
}

void Rig::bringToHostClock(Camera *camera, sphc_capture *capture) {
  if (capture->clock == SPHC_CLOCK_BOOTTIME) capture->time_ns -= nowNs(CLOCK_BOOTTIME) - nowNs(CLOCK_MONOTONIC);
  if (capture->clock == SPHC_CLOCK_SOURCE) {
    const int64_t arrival_ns = capture->arrival_ns ? capture->arrival_ns : nowNs(CLOCK_MONOTONIC);
    sphc_clock_mapper_add(camera->mapper, capture->time_ns, arrival_ns);
    sphc_clock_mapper_map(camera->mapper, capture->time_ns, &capture->time_ns);
    sphc_clock_mapping mapping = {};
    mapping.struct_size = sizeof mapping;
    sphc_clock_mapper_get(camera->mapper, &mapping);
    capture->time_sigma_us = jointSigmaUs(capture->time_sigma_us, mapping.sigma_ns);
  }
  capture->clock = SPHC_CLOCK_MONOTONIC;
}

// What waits in the pairer goes back while it still can.
void Rig::emptyPairer() {
  CapturePair pair;
  sphc_pairer_flush(pairer_);
  while (pop(&pair)) release(pair);
  earlier_ = counts();
  makePairer();
}

void Rig::lose(Camera *camera) {
  const sphc_source &source = camera->device->source();
  trouble_(camera->spec + ": " + source.message(source.self) + "; waiting for it to come back");
  ++losses_;
  emptyPairer();
  source.stop(source.self);
  camera->device.reset();
  camera->failures = 0;
  camera->retry = Clock::now() + kRetry;
}

void Rig::tryAgain(Camera *camera) {
  if (Clock::now() < camera->retry) return;
  camera->retry = Clock::now() + kRetry;
  try {
    camera->device = options_.open(camera->spec, camera->wish);
    start(camera);
    camera->reopened = true;
    camera->why_not_back.clear();
    trouble_(camera->spec + ": is back");
  } catch (const std::exception &error) {  // not yet: unplugged still, or another program was quicker
    camera->device.reset();
    if (camera->why_not_back != error.what()) trouble_("not back yet: " + std::string(error.what()));
    camera->why_not_back = error.what();
  }
}

std::vector<std::string> Rig::descriptions() const {
  std::vector<std::string> all;
  for (const Camera &camera : cameras_)
    all.push_back(camera.device ? camera.device->describe() : camera.spec + " (unplugged)");
  return all;
}

std::string Rig::troubles() const {
  std::string all;
  for (const Camera &camera : cameras_) {
    const std::string words = camera.device                 ? camera.device->troubles()
                              : camera.why_not_back.empty() ? "unplugged"
                                                            : "not back yet: " + camera.why_not_back;
    if (!words.empty()) all += (all.empty() ? "" : "; ") + camera.spec + ": " + words;
  }
  return all;
}

sphc_pairer_counts Rig::counts() const {
  sphc_pairer_counts now = {};
  now.struct_size = sizeof now;
  sphc_pairer_get_counts(pairer_, &now);
  now.pairs += earlier_.pairs;
  now.too_far += earlier_.too_far;
  now.overtaken += earlier_.overtaken;
  now.full += earlier_.full;
  now.ended += earlier_.ended;
  now.color_lost += earlier_.color_lost;
  now.depth_lost += earlier_.depth_lost;
  return now;
}

bool Rig::calibration(sphc_rig *calibration) const {
  return cameras_.size() == 1 && cameras_[0].device && cameras_[0].device->calibration(calibration);
}

recording::RecordingReader *Rig::replayed() const {
  return cameras_.size() == 1 && cameras_[0].device ? cameras_[0].device->replayed() : nullptr;
}

bool Rig::waits() const {
  return std::all_of(cameras_.begin(), cameras_.end(),
                     [](const Camera &camera) { return camera.device && camera.device->waits(); });
}

}  // namespace sphc::host
