#include "recorder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "failure.h"
#include "pixels.h"
#include "pose_track.h"
#include "recorder_slot.h"
#include "recording_encoder.h"

using namespace sphc::recording;

namespace {

std::string timeFault(int64_t time_ns) {
  return "time_ns " + std::to_string(time_ns) +
         " is negative or not later than the one before; give increasing times";
}

void checkConfig(const sphc_recorder_config &config) {
  const auto require = [](bool fine, const char *text) {
    if (!fine) throw Failure(SPHC_E_ARGUMENT, std::string("config.") + text);
  };
  require(config.depth_codec >= SPHC_DEPTH_RAW && config.depth_codec <= SPHC_DEPTH_ZSTD,
          "depth_codec: must be SPHC_DEPTH_RAW, SPHC_DEPTH_RVL or SPHC_DEPTH_ZSTD");
  require(config.jpeg_quality <= 100, "jpeg_quality: must be 1 to 100, or 0 for raw colour");
  require(config.queue_slots >= 2 && config.queue_slots <= 1024, "queue_slots: must be 2 to 1024");
  require(config.sync_ms >= 10 && config.sync_ms <= 60000, "sync_ms: must be 10 to 60000");
  require(config.chunk_bytes >= 65536 && config.chunk_bytes <= (1u << 28), "chunk_bytes: must be 65536 to 2^28");
}

// Of colour, or of depth and its amplitudes.
size_t slotBytes(const sphc_rig &calibration) {
  const sphc_camera &color = calibration.color_camera;
  const sphc_camera &depth = calibration.depth_camera;
  return std::max(size_t{color.width} * color.height * 3, size_t{depth.width} * depth.height * 4);
}

std::vector<Slot> slotsFor(const sphc_rig &calibration, const sphc_recorder_config &config) {
  std::vector<Slot> slots(config.queue_slots);
  for (Slot &slot : slots) slot.pixels.resize(slotBytes(calibration));
  return slots;
}

}  // namespace

struct sphc_recorder {
  sphc_recorder(const char *path, const sphc_rig &its_calibration, const sphc_recorder_config &its_config);
  ~sphc_recorder();

  sphc_status add(const sphc_capture &capture);
  sphc_status addPose(int64_t time_ns, const sphc_rigid &world_from_camera);
  sphc_status addAcceleration(const TimedAcceleration &acceleration);
  void drain();
  void close();

  // The caller's side.
  void noteGap(const sphc_capture &capture, const StreamState &state);
  template <typename Fill>
  sphc_status push(const Drop &drop, Fill &&fill);
  // The writer's side.
  void run();
  Slot *waitForSlot(std::chrono::steady_clock::time_point until);
  void write(const Slot &slot);
  void giveBack(const Slot &slot);
  void fail();
  void noteWritten();

  const sphc_rig calibration;
  const sphc_recorder_config config;
  std::vector<Slot> slots;   // a ring; `first` and the `used` behind it are the thread's
  RecordingEncoder encoder;  // the thread's, until it is joined; its file is made when there is all other memory

  StreamState color, depth, poses, felt;
  Accelerations accelerations;
  DropList drops;

  mutable std::mutex mutex;  // of what follows
  std::condition_variable came, went;
  size_t first = 0, used = 0;
  bool ends = false;
  sphc_status failure = SPHC_OK;
  sphc_message failure_message = {};
  sphc_recorder_statistics statistics = {};
  sphc_recorder_statistics gathered = {};  // counts of what is not in the file yet

  std::thread thread;
};

sphc_recorder::sphc_recorder(const char *path, const sphc_rig &its_calibration,
                             const sphc_recorder_config &its_config)
    : calibration(its_calibration),
      config(its_config),
      slots(slotsFor(its_calibration, its_config)),
      encoder(path, its_calibration, its_config) {
  statistics.struct_size = sizeof statistics;
  thread = std::thread([this] { run(); });
}

sphc_recorder::~sphc_recorder() {
  {
    const std::lock_guard lock(mutex);
    ends = true;
  }
  came.notify_one();
  if (thread.joinable()) thread.join();
}

void sphc_recorder::noteGap(const sphc_capture &capture, const StreamState &state) {
  const uint32_t gap = capture.sequence - state.last_sequence - 1;
  if (!config.gaps_are_losses || !state.has_any() || gap == 0) return;
  if (gap > INT32_MAX) return;  // one that counts anew is no gap
  drops.add(capture.stream, DropCause::kBefore, state.last_sequence + 1, gap, capture.time_ns);
  const std::lock_guard lock(mutex);
  statistics.missing_count += gap;
}

// Fills a slot and hands it over; what finds none becomes `drop`.
template <typename Fill>
sphc_status sphc_recorder::push(const Drop &drop, Fill &&fill) {
  std::unique_lock lock(mutex);
  const auto can_go_on = [this] { return used < slots.size() || failure < 0; };
  went.wait_for(lock, std::chrono::microseconds(config.wait_us), can_go_on);
  if (failure < 0) throw Failure(failure, failure_message.text);
  if (used == slots.size()) {
    drops.add(drop.stream, drop.cause, drop.first_sequence, drop.count, drop.time_ns);
    ++statistics.dropped_count;
    return SPHC_AGAIN;
  }
  Slot &slot = slots[(first + used) % slots.size()];
  lock.unlock();  // the slot is the caller's until it is counted
  fill(slot);
  accelerations.moveTo(slot.accelerations);
  slot.drops = drops;
  drops.clear();
  lock.lock();
  if (failure < 0) throw Failure(failure, failure_message.text);
  ++used;
  statistics.queue_most = std::max(statistics.queue_most, static_cast<uint32_t>(used));
  lock.unlock();
  came.notify_one();
  return SPHC_OK;
}

sphc_status sphc_recorder::add(const sphc_capture &capture) {
  const bool is_color = capture.stream == SPHC_STREAM_COLOR;
  if (!is_color && capture.stream != SPHC_STREAM_DEPTH)
    throw Failure(SPHC_E_ARGUMENT, "capture.stream is " + std::to_string(capture.stream) + "; give COLOR or DEPTH");
  checkImage(capture.image, is_color ? calibration.color_camera : calibration.depth_camera, is_color);
  const bool has_amplitude = capture.amplitude.data != nullptr;
  if (has_amplitude && is_color)
    throw Failure(SPHC_E_IMAGE, "amplitude image: belongs to a colour capture; give it with the depth image");
  if (has_amplitude) checkAmplitude(capture.amplitude, calibration.depth_camera);
  StreamState &state = is_color ? color : depth;
  if (capture.time_ns <= state.last_ns) throw Failure(SPHC_E_ARGUMENT, "capture: " + timeFault(capture.time_ns));
  noteGap(capture, state);
  state = {capture.time_ns, capture.sequence};
  return push({capture.stream, capture.sequence, 1, capture.time_ns, DropCause::kQueueFull}, [&](Slot &slot) {
    slot.what = Slot::What::kImage;
    slot.note = {capture.time_ns,       capture.arrival_ns, capture.sequence,  capture.exposure_us,
                 capture.time_sigma_us, capture.clock,      capture.time_point};
    slot.image = capture.image;
    slot.image.data = slot.pixels.data();
    slot.image.stride_bytes = capture.image.width * sphc_format_bytes(capture.image.format);
    packPixels(capture.image, capture.image.format, slot.pixels.data());
    slot.amplitude = {};
    if (!has_amplitude) return;
    auto *const behind = reinterpret_cast<uint16_t *>(slot.pixels.data() + packedBytes(slot.image));
    packAmplitude(capture.amplitude, behind);
    slot.amplitude = {behind, slot.image.width, slot.image.height, slot.image.width * 2, SPHC_FORMAT_GRAY16};
  });
}

sphc_status sphc_recorder::addPose(int64_t time_ns, const sphc_rigid &world_from_camera) {
  const sphc_rigid pose = checkedPose(world_from_camera);
  if (time_ns <= poses.last_ns) throw Failure(SPHC_E_ARGUMENT, "pose: " + timeFault(time_ns));
  poses = {time_ns, poses.last_sequence + 1};
  return push({SPHC_STREAM_NONE, poses.last_sequence, 1, time_ns, DropCause::kQueueFull}, [&](Slot &slot) {
    slot.what = Slot::What::kPose;
    slot.note = {};
    slot.note.time_ns = time_ns;
    slot.note.sequence = poses.last_sequence;
    slot.pose = pose;
  });
}

sphc_status sphc_recorder::addAcceleration(const TimedAcceleration &acceleration) {
  const double *a = acceleration.felt_mps2;
  const double norm2 = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  if (!(norm2 > 0) || !std::isfinite(norm2))  // readers take no others
    throw Failure(SPHC_E_ARGUMENT, "felt_mps2 is zero or not finite; give what the sensor measured, in m/s^2");
  if (acceleration.time_ns <= felt.last_ns)
    throw Failure(SPHC_E_ARGUMENT, "acceleration: " + timeFault(acceleration.time_ns));
  felt = {acceleration.time_ns, felt.last_sequence + 1};
  if (accelerations.isFull()) {
    const Drop drop = {SPHC_STREAM_NONE, felt.last_sequence, 1, acceleration.time_ns, DropCause::kQueueFull};
    const sphc_status status = push(drop, [&](Slot &slot) {
      slot.what = Slot::What::kAccelerations;
      slot.note = {};
      slot.note.time_ns = acceleration.time_ns;
    });
    if (status != SPHC_OK) return status;
  }
  accelerations.add(acceleration);
  return SPHC_OK;
}

// Null when there is none until then, or none will come any more.
Slot *sphc_recorder::waitForSlot(std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(mutex);
  came.wait_until(lock, until, [this] { return used > 0 || ends; });
  return used > 0 ? &slots[first] : nullptr;
}

void sphc_recorder::write(const Slot &slot) {
  for (const Drop &drop : slot.drops) encoder.addDrop(drop, slot.note.time_ns);
  for (const TimedAcceleration &acceleration : slot.accelerations) encoder.addAcceleration(acceleration);
  if (slot.what == Slot::What::kPose)
    encoder.addPose(slot.note.sequence, slot.note.time_ns, slot.pose);
  else if (slot.what == Slot::What::kImage)
    encoder.add(slot.note, slot.image, slot.amplitude);
}

void sphc_recorder::giveBack(const Slot &slot) {
  {
    const std::lock_guard lock(mutex);
    if (slot.what == Slot::What::kImage) {
      ++(slot.image.format == SPHC_FORMAT_DEPTH16 ? gathered.depth_count : gathered.color_count);
      gathered.raw_bytes += packedBytes(slot.image) + packedBytes(slot.amplitude);
    }
    first = (first + 1) % slots.size();
    --used;
  }
  went.notify_one();
}

void sphc_recorder::noteWritten() {
  if (!encoder.isWritten()) return;
  const uint64_t file_bytes = encoder.fileBytes();
  const std::lock_guard lock(mutex);
  statistics.color_count += gathered.color_count;
  statistics.depth_count += gathered.depth_count;
  statistics.raw_bytes += gathered.raw_bytes;
  statistics.file_bytes = file_bytes;
  gathered = {};
}

// What is in the chunk and in the queue is lost with it.
void sphc_recorder::fail() {
  const std::lock_guard lock(mutex);
  failure = explainException(&failure_message);
  statistics.dropped_count += gathered.color_count + gathered.depth_count + used;
  used = 0;
  went.notify_one();
}

void sphc_recorder::run() {
  const auto period = std::chrono::milliseconds(config.sync_ms);
  auto due = std::chrono::steady_clock::now() + period;
  const auto is_over = [this] {
    const std::lock_guard lock(mutex);
    return ends && used == 0;
  };
  try {
    while (!is_over()) {
      if (const Slot *slot = waitForSlot(due)) {
        write(*slot);
        giveBack(*slot);
      }
      if (std::chrono::steady_clock::now() >= due) {
        encoder.sync();
        due = std::chrono::steady_clock::now() + period;
      }
      noteWritten();
    }
  } catch (...) {
    fail();
  }
}

// Ends the thread, and brings what was added into the file.
void sphc_recorder::drain() {
  {
    const std::lock_guard lock(mutex);
    ends = true;
  }
  came.notify_one();
  thread.join();
  if (failure < 0) throw Failure(failure, failure_message.text);
  for (const TimedAcceleration &acceleration : accelerations) encoder.addAcceleration(acceleration);
  for (const Drop &drop : drops) encoder.addDrop(drop, drop.time_ns);
  encoder.sync();
  noteWritten();
}

void sphc_recorder::close() {
  drain();
  encoder.finish(statistics);
}

extern "C" {

sphc_status sphc_recorder_config_init(sphc_recorder_config *config, size_t struct_size) {
  if (!config) return SPHC_E_ARGUMENT;
  if (struct_size != sizeof *config) return SPHC_E_STRUCT_SIZE;
  *config = {};
  config->struct_size = sizeof *config;
  config->depth_codec = SPHC_DEPTH_ZSTD;
  config->queue_slots = 16;
  config->sync_ms = 1000;
  config->chunk_bytes = 4 << 20;
  config->gaps_are_losses = 1;
  return SPHC_OK;
}

sphc_status sphc_recorder_open(const char *path, const sphc_rig *rig, const sphc_recorder_config *config,
                               sphc_recorder **recorder, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!path || !recorder) throw Failure(SPHC_E_ARGUMENT, "path or recorder is null; give both");
    const sphc_status status = sphc_rig_check(rig, message);
    if (status < 0) return status;
    sphc_recorder_config chosen;
    sphc_recorder_config_init(&chosen, sizeof chosen);
    if (config && config->struct_size != sizeof *config)
      throw Failure(SPHC_E_STRUCT_SIZE, "config.struct_size; sphc_recorder_config_init sets it");
    if (config) chosen = *config;
    checkConfig(chosen);
    *recorder = std::make_unique<sphc_recorder>(path, *rig, chosen).release();
    return SPHC_OK;
  });
}

sphc_status sphc_recorder_add(sphc_recorder *recorder, const sphc_capture *capture, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!recorder || !capture) throw Failure(SPHC_E_ARGUMENT, "recorder or capture is null; give both");
    if (capture->struct_size != sizeof *capture)
      throw Failure(SPHC_E_STRUCT_SIZE, "capture.struct_size; set it to sizeof(sphc_capture)");
    return recorder->add(*capture);
  });
}

sphc_status sphc_recorder_add_pose(sphc_recorder *recorder, int64_t time_ns, const sphc_rigid *world_from_camera,
                                   sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!recorder || !world_from_camera)
      throw Failure(SPHC_E_ARGUMENT, "recorder or world_from_camera is null; give both");
    return recorder->addPose(time_ns, *world_from_camera);
  });
}

sphc_status sphc_recorder_add_acceleration(sphc_recorder *recorder, int64_t time_ns, const double felt_mps2[3],
                                           sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!recorder || !felt_mps2) throw Failure(SPHC_E_ARGUMENT, "recorder or felt_mps2 is null; give both");
    return recorder->addAcceleration({time_ns, {felt_mps2[0], felt_mps2[1], felt_mps2[2]}});
  });
}

sphc_status sphc_recorder_get_statistics(const sphc_recorder *recorder, sphc_recorder_statistics *statistics) {
  if (!recorder || !statistics) return SPHC_E_ARGUMENT;
  if (statistics->struct_size != sizeof *statistics) return SPHC_E_STRUCT_SIZE;
  const std::lock_guard lock(recorder->mutex);
  *statistics = recorder->statistics;
  return SPHC_OK;
}

sphc_status sphc_recorder_close(sphc_recorder **recorder, sphc_message *message) {
  if (!recorder || !*recorder) return SPHC_OK;
  const sphc_status status = guarded(message, [&] {
    (*recorder)->close();
    return SPHC_OK;
  });
  delete *recorder;
  *recorder = nullptr;
  return status;
}

void sphc_recorder_abandon(sphc_recorder **recorder) {
  if (!recorder || !*recorder) return;
  guarded(nullptr, [&] {
    (*recorder)->drain();
    return SPHC_OK;
  });
  delete *recorder;
  *recorder = nullptr;
}

}  // extern "C"
