#include "tests/soak/day.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "tests/memory/sealed_heap.h"
#include "tests/support/backwards.h"

namespace sphc::soak {
namespace {

constexpr int64_t kTickNs = 33333333, kSecondNs = 1000000000;
constexpr double kWrongM = 0.25, kWrongRad = 0.175;
constexpr uint32_t kContradictionsToReset = 15;  // in a row; the test room shows too little to take them back soon

[[noreturn]] void fail(const char *promise) {
  test::unsealHeap();
  std::fprintf(stderr, "soak: broken promise: %s\n", promise);
  std::exit(1);
}

void require(bool holds, const char *promise) {
  if (!holds) fail(promise);
}

// No call of the library may use the heap.
template <typename Call>
auto sealed(const Call &call) {
  test::sealHeap();
  const auto answer = call();
  test::unsealHeap();
  return answer;
}

test::GuardedMemory memoryOf(const sphc_memory &need) { return {need.state_bytes, need.alignment}; }

}  // namespace

Day::Day(const World *world, uint64_t seed) : world_(*world), random_(seed) {
  config_.seed = seed;
  config_.clock = test::SteppingClock::read;
  config_.clock_user = &clock_;
  config_.parallel = test::runBackwards;
  config_.parallel_tasks = 2;
  sphc_memory need = {};
  sphc_localizer_memory(&config_, &need, nullptr);
  state_ = memoryOf(need);
  scratch_ = test::GuardedMemory(need.scratch_bytes, need.alignment);
  sphc_features_memory(&config_, &need, nullptr);
  features_memory_ = memoryOf(need);
  sphc_pairer_memory(&need);
  pairer_memory_ = memoryOf(need);
  sphc_clock_mapper_memory(&need);
  mapper_memory_ = memoryOf(need);
  begin();
}

Day::~Day() { end(); }

void Day::begin() {
  sphc_pairer_config pairing;
  sphc_pairer_config_init(&pairing, sizeof pairing);
  sphc_clock_mapper_config mapping;
  sphc_clock_mapper_config_init(&mapping, sizeof mapping);
  require(sealed([&] {
            return sphc_localizer_init(state_.data(), state_.size(), scratch_.data(), scratch_.size(), &config_,
                                       &localizer_, nullptr) == SPHC_OK &&
                   sphc_features_init(features_memory_.data(), features_memory_.size(), &config_, &features_,
                                      nullptr) == SPHC_OK &&
                   sphc_pairer_init(pairer_memory_.data(), pairer_memory_.size(), &pairing, &pairer_, nullptr) ==
                       SPHC_OK &&
                   sphc_clock_mapper_init(mapper_memory_.data(), mapper_memory_.size(), &mapping, &mapper_,
                                          nullptr) == SPHC_OK;
          }),
          "what can be measured can be made");
  for (uint32_t room = 0; room < kMappedRooms; ++room) setMap(room);
  last_ns_ = INT64_MIN;
}

void Day::end() {
  sealed([&] {
    sphc_localizer_fini(&localizer_);
    sphc_features_fini(&features_);
    sphc_pairer_fini(&pairer_);
    sphc_clock_mapper_fini(&mapper_);
    return true;
  });
  checkGuards();
}

void Day::play(uint64_t frames) {
  const uint64_t last = totals_.frames + frames;
  while (totals_.frames < last) {
    tick();
    if (totals_.frames < day_ends_) continue;
    end();
    begin();
    ++totals_.restarts;
    day_ends_ += kFramesOfADay;
  }
}

void Day::breakGuard() { static_cast<uint8_t *>(state_.data())[state_.size()] = 0; }

void Day::checkGuards() const {
  require(state_.guardsIntact() && scratch_.guardsIntact() && features_memory_.guardsIntact() &&
              pairer_memory_.guardsIntact() && mapper_memory_.guardsIntact(),
          "instances keep inside their memory");
  require(prior_.isIntact() && result_.isIntact() && prediction_.isIntact() && hypotheses_.isIntact() &&
              observations_.isIntact(),
          "no byte beside a caller's buffer is written");
}

void Day::tick() {
  walk();
  if (chance(0.002)) unplug();
  changeMaps();
  captureBoth();
  if (chance(0.1)) ask();
  if (chance(0.05)) refusedCall();
}

void Day::walk() {
  source_ns_ += kTickNs;
  host_ns_ += kTickNs;
  if (chance(0.05)) forward_ = !forward_;
  if (chance(0.5) && (forward_ ? place_ + 1 < kPlaces : place_ > 0)) place_ += forward_ ? 1 : -1;
  if (!chance(0.002)) return;
  room_ = random_.below(kRooms);
  place_ = random_.below(kPlaces);
  ++totals_.rooms;
  const int64_t away_ns = kSecondNs * random_.below(5);
  source_ns_ += away_ns;
  host_ns_ += away_ns;
}

// The source is away for a while; some count time from 0 when they are back.
void Day::unplug() {
  sealed([&] { return sphc_pairer_flush(pairer_), true; });
  popAll();
  sphc_pairer_config pairing;
  sphc_pairer_config_init(&pairing, sizeof pairing);
  require(sealed([&] {
            sphc_pairer_fini(&pairer_);
            return sphc_pairer_init(pairer_memory_.data(), pairer_memory_.size(), &pairing, &pairer_, nullptr) ==
                   SPHC_OK;
          }),
          "a pairer can be made again");
  host_ns_ += kSecondNs / 10 * (1 + random_.below(300));
  source_ns_ = chance(0.5) ? 0 : source_ns_ + kSecondNs;
  sequence_ = 0;
  last_ns_ = INT64_MIN;
  ++totals_.unplugs;
}

void Day::setMap(uint32_t room) {
  require(sealed([&] {
            return sphc_localizer_set_map(localizer_, room, world_.release(room, release_[room]).map) == SPHC_OK;
          }),
          "a map can be set at any time");
  has_map_[room] = true;
}

void Day::changeMaps() {
  for (uint32_t room = 0; room < kMappedRooms; ++room) {
    if (!has_map_[room] && chance(0.02)) setMap(room);
    if (chance(0.003)) {
      release_[room] = 1 - release_[room];
      setMap(room);
      ++totals_.swaps;
    } else if (has_map_[room] && chance(0.001)) {
      require(sealed([&] { return sphc_localizer_remove_map(localizer_, room) == SPHC_OK; }),
              "a map that is there can be removed");
      has_map_[room] = false;
    }
  }
}

void Day::captureBoth() {
  ++sequence_;
  const int64_t late_ns = 1000000 + int64_t{1000} * random_.below(3000);
  require(sealed([&] { return sphc_clock_mapper_add(mapper_, source_ns_, host_ns_ + late_ns) >= 0; }),
          "a pair of times is taken");
  for (const sphc_stream stream : {SPHC_STREAM_COLOR, SPHC_STREAM_DEPTH})
    if (!chance(0.03)) push(stream);
  popAll();
}

void Day::push(sphc_stream stream) {
  sphc_capture capture = {};
  capture.struct_size = sizeof capture;
  capture.stream = stream;
  capture.time_ns = source_ns_ + (stream == SPHC_STREAM_DEPTH ? int64_t{1000} * random_.below(5000) : 0);
  capture.sequence = sequence_;
  capture.token = token_++ % std::size(shots_);
  shots_[capture.token] = {room_, place_, capture.time_ns};
  require(sealed([&] { return sphc_pairer_push(pairer_, &capture) == SPHC_OK; }), "a capture in order is taken");
}

void Day::popAll() {
  for (;;) {
    sphc_capture color = {}, depth = {}, dropped = {};
    const sphc_status status = sealed([&] { return sphc_pairer_pop(pairer_, &color, &depth, &dropped); });
    if (status == SPHC_OK)
      frame(shots_[color.token], shots_[depth.token]);
    else if (dropped.stream == SPHC_STREAM_NONE)
      return;
  }
}

void Day::frame(const Shot &color, const Shot &depth) {
  const test::SceneImages &seen = world_.images(color.room, color.place);
  gray_ = seen.gray;
  depth_mm_ = world_.images(depth.room, depth.place).depth_mm;
  const sphc_camera &c = config_.rig.color_camera, &d = config_.rig.depth_camera;
  sphc_localizer_frame frame = {};
  frame.struct_size = sizeof frame;
  frame.sequence = static_cast<uint32_t>(totals_.frames);
  frame.color = {gray_.data(), c.width, c.height, c.width, SPHC_FORMAT_GRAY8};
  frame.depth = {depth_mm_.data(), d.width, d.height, 2 * d.width, SPHC_FORMAT_DEPTH16};
  require(sealed([&] {
            return sphc_clock_mapper_map(mapper_, color.time_ns, &frame.color_time_ns) == SPHC_OK &&
                   sphc_clock_mapper_map(mapper_, depth.time_ns, &frame.depth_time_ns) == SPHC_OK;
          }),
          "a time near a sample is mapped");
  require(color.time_ns > last_ns_, "times of pairs increase");
  last_ns_ = color.time_ns;
  const bool is_broken = chance(0.04) || color.room != depth.room;
  if (is_broken) breakFrame(&frame);
  if (chance(0.3)) addPrior(color, &frame);
  if (chance(0.1)) frame.deadline_us = 20 + random_.below(3000);
  totals_.broken += is_broken;
  totals_.deadlines += frame.deadline_us != 0;
  const sphc_status status = answer(frame);
  result_->camera_from_map.t_m[0] += added_m_;
  judge(color, frame, status, is_broken);
  checkGuards();
}

// As sensors break, and those who read them.
void Day::breakFrame(sphc_localizer_frame *frame) {
  switch (random_.below(8)) {
    case 0:
      for (uint8_t &pixel : gray_) pixel = static_cast<uint8_t>(random_.below(256));
      break;
    case 1:
      std::fill(gray_.begin(), gray_.end(), uint8_t{3});
      break;
    case 2:
      std::fill(depth_mm_.begin(), depth_mm_.end(), uint16_t{0});
      break;
    case 3:
      for (uint16_t &mm : depth_mm_) mm = static_cast<uint16_t>(random_.below(65536));
      break;
    case 4:  // half of the image did not arrive
      std::fill(gray_.begin() + static_cast<ptrdiff_t>(gray_.size() / 2), gray_.end(), uint8_t{0});
      break;
    case 5:
      depth_mm_ = world_.images(random_.below(kRooms), random_.below(kPlaces)).depth_mm;
      break;
    case 6:
      for (uint16_t &mm : depth_mm_) mm = static_cast<uint16_t>(mm + mm / 4);
      break;
    default:
      frame->color_time_ns -= kSecondNs * random_.below(100);
  }
}

// Of the truth, or of anything.
void Day::addPrior(const Shot &shot, sphc_localizer_frame *frame) {
  const uint32_t room = chance(0.8) ? shot.room : random_.below(kRooms), mapped = std::min(room, kMappedRooms - 1);
  const uint32_t place = chance(0.8) ? shot.place : random_.below(kPlaces);
  if (!has_map_[mapped]) return;  // a map that is not there is a mistake
  sphc_localizer_prior_init(prior_.get(), sizeof *prior_);
  const Rigid camera_from_map = world_.cameraFromMap(mapped, release_[mapped], place);
  prior_->flags = 1 + random_.below(7);
  prior_->map_id = mapped;
  prior_->camera_from_map = rigidToC(camera_from_map);
  prior_->rotation_sigma_rad = 0.02 + 0.5 * random_.uniform();
  prior_->translation_sigma_m = 0.02 + random_.uniform();
  const Vector3 up_camera = camera_from_map.rotation * Vector3(0, -1, 0);
  for (int i = 0; i < 3; ++i) {
    prior_->up_camera[i] = up_camera[i];
    prior_->up_map[i] = i == 1 ? -1 : 0;
  }
  prior_->up_sigma_rad = 0.02;
  prior_->odometry_from_camera = rigidToC(world_.cameraFromWorld(place).inverse());
  prior_->odometry_rotation_sigma_rad = 0.01;
  prior_->odometry_translation_sigma_m = 0.01;
  frame->prior = prior_.get();
  ++totals_.priors;
}

sphc_status Day::answer(const sphc_localizer_frame &frame) {
  sphc_localizer_result_init(result_.get(), sizeof *result_);
  if (chance(0.3)) return answerInHalves(frame);
  return sealed([&] { return sphc_localizer_process(localizer_, &frame, result_.get()); });
}

sphc_status Day::answerInHalves(const sphc_localizer_frame &frame) {
  ++totals_.halves;
  const bool from_elsewhere = chance(0.3);
  return sealed([&] {
    sphc_status status = sphc_localizer_extract(localizer_, &frame, features_);
    sphc_features_arrays arrays = {};
    arrays.struct_size = sizeof arrays;
    if (status == SPHC_OK && from_elsewhere) status = sphc_features_get(features_, &arrays);
    if (status == SPHC_OK && from_elsewhere) status = sphc_features_set(features_, &frame, &arrays);
    return status == SPHC_OK ? sphc_localizer_locate(localizer_, &frame, features_, result_.get()) : status;
  });
}

void Day::judge(const Shot &shot, const sphc_localizer_frame &frame, sphc_status status, bool is_broken) {
  const char *fault = status < 0 ? sphc_localizer_message(localizer_) : faultOf(status, frame, *result_);
  if (fault) fail(fault);
  totals_.digest = digestOf(&*result_, sizeof *result_, totals_.digest);
  ++totals_.frames;
  totals_.elsewhere += shot.room >= kMappedRooms;
  totals_.tracked += result_->state == SPHC_STATE_TRACKING;
  contradictions_ = result_->outcome == SPHC_OUTCOME_CONTRADICTION ? contradictions_ + 1 : 0;
  if (contradictions_ == kContradictionsToReset) reset();
  if (status != SPHC_OK) return;
  ++totals_.localized;
  const bool wrong_room = result_->map_id != shot.room;
  totals_.wrong_room += wrong_room;
  require(!wrong_room, "a pose is in the room that the camera is in");
  const Rigid truth = world_.cameraFromMap(shot.room, release_[shot.room], shot.place);
  const Rigid error = rigidFromC(result_->camera_from_map) * truth.inverse();
  const double angle_rad = std::acos(std::min(1.0, std::max(-1.0, (error.rotation.trace() - 1) / 2)));
  totals_.wrong_pose += !is_broken && (error.translation_m.norm() > kWrongM || angle_rad > kWrongRad);
}

void Day::reset() {
  sealed([&] { return sphc_localizer_reset(localizer_), true; });
  contradictions_ = 0;
  ++totals_.resets;
}

void Day::ask() {
  const int64_t at_ns = last_ns_ + int64_t{1000000} * random_.below(2000) - kSecondNs / 2;
  sphc_localizer_prediction_init(prediction_.get(), sizeof *prediction_);
  const sphc_status status = sealed([&] { return sphc_localizer_predict(localizer_, at_ns, prediction_.get()); });
  if (const char *fault = faultOf(status, *prediction_)) fail(fault);
  uint32_t count = 0;
  sealed([&] {
    return sphc_localizer_hypotheses(localizer_, *hypotheses_.get(), sizeof(sphc_localizer_hypothesis),
                                     SPHC_HYPOTHESES_MAX, &count);
  });
  if (const char *fault = faultOf(*hypotheses_, count)) fail(fault);
  sealed([&] {
    return sphc_localizer_observations(localizer_, *observations_.get(), sizeof(sphc_localizer_observation),
                                       random_.below(65), &count);
  });
  require(count <= config_.max_keypoints, "there are no more observations than keypoints");
  checkGuards();
}

// A caller's mistake: refused, with outputs as they were and a localizer that goes on.
void Day::refusedCall() {
  const test::SceneImages &images = world_.images(0, 0);
  const sphc_camera &c = config_.rig.color_camera, &d = config_.rig.depth_camera;
  sphc_localizer_frame frame = {};
  frame.struct_size = sizeof frame;
  frame.color = {images.gray.data(), c.width, c.height, c.width, SPHC_FORMAT_GRAY8};
  frame.depth = {images.depth_mm.data(), d.width, d.height, 2 * d.width, SPHC_FORMAT_DEPTH16};
  const sphc_localizer_result before = *result_;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const sphc_status status = sealed([&]() -> sphc_status {
    switch (random_.below(8)) {
      case 0:
        frame.color.data = nullptr;
        break;
      case 1:
        frame.depth.width -= 1;
        break;
      case 2:
        frame.color.stride_bytes = 1;
        break;
      case 3:
        frame.struct_size = 8;
        break;
      case 4:
        frame.view_count = 3;
        break;
      case 5:
        return sphc_localizer_set_parameter(localizer_, SPHC_PARAMETER_MAX_RATIO, nan);
      case 6:
        return sphc_localizer_set_map(localizer_, SPHC_MAP_NONE, world_.release(0, 0).map);
      default:
        return sphc_localizer_process(localizer_, nullptr, result_.get());
    }
    return sphc_localizer_process(localizer_, &frame, result_.get());
  });
  require(status < 0 && sphc_localizer_message(localizer_)[0], "a mistake is refused with an explanation");
  require(std::memcmp(&before, &*result_, sizeof before) == 0, "a call that is refused leaves its outputs alone");
  ++totals_.refused_calls;
}

}  // namespace sphc::soak
