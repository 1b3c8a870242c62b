#include "player.h"

#include <algorithm>
#include <thread>

#include "host/recording/failure.h"

namespace sphc::replay {

using recording::Failure;
using recording::guarded;

Player::Player(const Recording &recording, const sphc_rig &calibration, const sphc_replay_config &config)
    : recording_(recording),
      reader_(recording, calibration, config.color_format),
      mode_(config.mode),
      slots_(config.loan_limit),
      slot_bytes_(std::max(reader_.colorBytes(), 2 * reader_.depthBytes())) {  // of depth with its amplitudes
  if (config.streams & SPHC_REPLAY_STREAM_COLOR) addEvents(SPHC_STREAM_COLOR, recording.color);
  if (config.streams & SPHC_REPLAY_STREAM_DEPTH) addEvents(SPHC_STREAM_DEPTH, recording.depth);
  std::stable_sort(events_.begin(), events_.end(),
                   [](const Event &a, const Event &b) { return a.time_ns < b.time_ns; });
}

void Player::addEvents(sphc_stream stream, const std::vector<RecordedImage> &images) {
  for (size_t i = 0; i < images.size(); ++i)
    events_.push_back({images[i].time_ns, stream, static_cast<uint32_t>(i)});
}

sphc_status Player::start() {
  if (running_) throw Failure(SPHC_E_STATE, "start: running already; call stop first");
  for (Slot &slot : slots_) slot.pixels.resize(slot_bytes_);  // allocates at the first start
  next_event_ = 0;
  started_ = Clock::now();
  running_ = true;
  return SPHC_OK;
}

Player::Slot *Player::freeSlot() {
  const auto it = std::find_if(slots_.begin(), slots_.end(), [](const Slot &slot) { return slot.token == 0; });
  return it == slots_.end() ? nullptr : &*it;
}

// False when the timeout runs out first.
bool Player::waitUntilDue(int64_t time_ns, uint32_t timeout_us) const {
  if (mode_ == SPHC_REPLAY_FAST) return true;
  // Recorded times may be as late as there are, so none is added to the clock.
  const std::chrono::nanoseconds since_first(time_ns - events_.front().time_ns);
  const std::chrono::nanoseconds left = since_first - (Clock::now() - started_);
  const std::chrono::microseconds most(timeout_us);
  std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(left, most));
  return left <= most;
}

sphc_status Player::acquire(uint32_t timeout_us, sphc_capture &capture) {
  if (!running_) throw Failure(SPHC_E_STATE, "acquire: not running; call start first");
  if (next_event_ == events_.size()) return SPHC_END;
  Slot *slot = freeSlot();
  if (!slot)
    throw Failure(SPHC_E_STATE,
                  "acquire: all " + std::to_string(slots_.size()) + " captures are on loan; release one first");
  const Event &event = events_[next_event_];
  if (!waitUntilDue(event.time_ns, timeout_us)) return SPHC_AGAIN;
  ++next_event_;  // before reading: the next call goes on behind an image that fails
  const bool is_color = event.stream == SPHC_STREAM_COLOR;
  const RecordedImage &image = (is_color ? recording_.color : recording_.depth)[event.index];
  const sphc_image view = reader_.read(event.stream, image, slot->pixels.data());
  const sphc_image amplitude =
      is_color ? sphc_image() : reader_.readAmplitude(image, slot->pixels.data() + reader_.depthBytes());
  slot->token = ++last_token_;
  capture = {};
  capture.struct_size = sizeof capture;
  capture.stream = event.stream;
  capture.time_ns = event.time_ns;
  capture.token = slot->token;
  capture.sequence = image.sequence;
  capture.time_point = image.note.time_point;
  capture.arrival_ns = image.note.arrival_ns;
  capture.exposure_us = image.note.exposure_us;
  capture.time_sigma_us = image.note.time_sigma_us;
  capture.clock = image.note.clock;
  capture.image = view;
  capture.amplitude = amplitude;
  return SPHC_OK;
}

void Player::release(const sphc_capture &capture) {
  if (!running_ || capture.token == 0) return;
  for (Slot &slot : slots_)
    if (slot.token == capture.token && slot.pixels.data() == capture.image.data) slot.token = 0;
}

void Player::stop() {
  running_ = false;
  for (Slot &slot : slots_) slot.token = 0;
}

namespace {

Player *playerOf(void *self) { return static_cast<Player *>(self); }

sphc_status startPlayer(void *self) {
  if (!self) return SPHC_E_ARGUMENT;
  return guarded(playerOf(self)->messageRoom(), [&] { return playerOf(self)->start(); });
}

sphc_status acquireFromPlayer(void *self, uint32_t timeout_us, sphc_capture *capture) {
  if (!self) return SPHC_E_ARGUMENT;
  return guarded(playerOf(self)->messageRoom(), [&] {
    if (!capture) throw Failure(SPHC_E_ARGUMENT, "acquire: capture is null; give one");
    if (capture->struct_size != sizeof *capture)
      throw Failure(SPHC_E_STRUCT_SIZE, "acquire: set capture.struct_size to sizeof(sphc_capture)");
    return playerOf(self)->acquire(timeout_us, *capture);
  });
}

void releaseToPlayer(void *self, const sphc_capture *capture) {
  if (self && capture) playerOf(self)->release(*capture);
}

void stopPlayer(void *self) {
  if (self) playerOf(self)->stop();
}

const char *messageOfPlayer(const void *self) {
  return self ? static_cast<const Player *>(self)->message() : "self is null";
}

}  // namespace

sphc_source Player::source() {
  return {sizeof(sphc_source),
          static_cast<uint32_t>(slots_.size()),
          this,
          startPlayer,
          acquireFromPlayer,
          releaseToPlayer,
          stopPlayer,
          messageOfPlayer};
}

}  // namespace sphc::replay
