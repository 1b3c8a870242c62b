#include "replay.h"

#include <algorithm>
#include <memory>

#include "host/recording/failure.h"
#include "host/recording/recording_reader.h"
#include "player.h"
#include "reader.h"

using namespace sphc::recording;

static_assert(static_cast<int>(Layout::kSevenScenes) == SPHC_REPLAY_7SCENES);
static_assert(static_cast<int>(Layout::kTum) == SPHC_REPLAY_TUM);
static_assert(static_cast<int>(Layout::kMcap) == SPHC_REPLAY_MCAP);
static_assert(static_cast<int>(Layout::kRaw) == SPHC_REPLAY_RAW);
static_assert(static_cast<int>(Layout::kStrayScanner) == SPHC_REPLAY_STRAY_SCANNER);
static_assert(static_cast<int>(Layout::kRos2) == SPHC_REPLAY_ROS2);
static_assert(static_cast<int>(Layout::kAzureKinect) == SPHC_REPLAY_AZURE_KINECT);
static_assert(static_cast<int>(Layout::kHl2ss) == SPHC_REPLAY_HL2SS);

struct sphc_replay {
  sphc_replay(const char *path, const ReaderOptions &options, const sphc_replay_config &config)
      : reader(path, options), player(reader.recording(), reader.calibration(), config) {}

  RecordingReader reader;
  sphc::replay::Player player;  // with buffers of its own
};

namespace sphc::replay {

RecordingReader *readerOf(sphc_replay *replay) { return &replay->reader; }

}  // namespace sphc::replay

namespace {

void checkConfig(const sphc_replay_config &config) {
  const auto require = [](bool fine, const char *text) {
    if (!fine) throw Failure(SPHC_E_ARGUMENT, std::string("config.") + text);
  };
  require(config.mode == SPHC_REPLAY_FAST || config.mode == SPHC_REPLAY_REAL_TIME,
          "mode: must be SPHC_REPLAY_FAST or SPHC_REPLAY_REAL_TIME");
  require(config.streams >= 1 && config.streams <= 3,
          "streams: must be SPHC_REPLAY_STREAM_COLOR, SPHC_REPLAY_STREAM_DEPTH or both");
  require(config.color_format == SPHC_FORMAT_BGR8 || config.color_format == SPHC_FORMAT_RGB8 ||
              config.color_format == SPHC_FORMAT_GRAY8,
          "color_format: must be BGR8, RGB8 or GRAY8");
  require(config.first <= config.last, "first: is greater than last");
  require(config.step >= 1, "step: is 0; must be 1 or more");
  require(config.loan_limit >= 1 && config.loan_limit <= 64, "loan_limit: must be 1 to 64");
  require(config.pair_tolerance_ns >= 0, "pair_tolerance_ns: is negative");
  require(config.pose_gap_ns >= 0, "pose_gap_ns: is negative");
}

ReaderOptions optionsOf(const char *calibration_path, const sphc_replay_config &config) {
  ReaderOptions options;
  if (calibration_path) options.calibration = calibration_path;
  options.selection = {config.first, config.last, config.step};
  options.color_format = config.color_format;
  options.pair_tolerance_ns = config.pair_tolerance_ns;
  options.pose_gap_ns = config.pose_gap_ns;
  return options;
}

bool hasFrame(const sphc_replay *replay, uint32_t index) { return replay && index < replay->reader.frameCount(); }

}  // namespace

extern "C" {

sphc_status sphc_replay_config_init(sphc_replay_config *config, size_t struct_size) {
  if (!config) return SPHC_E_ARGUMENT;
  if (struct_size != sizeof *config) return SPHC_E_STRUCT_SIZE;
  *config = {};
  config->struct_size = sizeof *config;
  config->mode = SPHC_REPLAY_FAST;
  config->streams = SPHC_REPLAY_STREAM_COLOR | SPHC_REPLAY_STREAM_DEPTH;
  config->color_format = SPHC_FORMAT_BGR8;
  config->last = UINT32_MAX;
  config->step = 1;
  config->loan_limit = 8;
  config->pair_tolerance_ns = 20000000;
  config->pose_gap_ns = 50000000;
  return SPHC_OK;
}

sphc_status sphc_replay_open(const char *path, const char *calibration_path, const sphc_replay_config *config,
                             sphc_replay **replay, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!path || !replay) throw Failure(SPHC_E_ARGUMENT, "path or replay is null; give both");
    sphc_replay_config chosen;
    sphc_replay_config_init(&chosen, sizeof chosen);
    if (config && config->struct_size != sizeof *config)
      throw Failure(SPHC_E_STRUCT_SIZE,
                    "config.struct_size is none this library knows; use sphc_replay_config_init");
    if (config) chosen = *config;
    checkConfig(chosen);
    *replay = std::make_unique<sphc_replay>(path, optionsOf(calibration_path, chosen), chosen).release();
    return SPHC_OK;
  });
}

void sphc_replay_close(sphc_replay **replay) {
  if (!replay) return;
  delete *replay;
  *replay = nullptr;
}

sphc_status sphc_replay_get_info(const sphc_replay *replay, sphc_replay_info *info) {
  if (!replay || !info) return SPHC_E_ARGUMENT;
  if (info->struct_size != sizeof *info) return SPHC_E_STRUCT_SIZE;
  const Recording &recording = replay->reader.recording();
  info->layout = static_cast<sphc_replay_layout>(recording.layout);
  info->color_count = static_cast<uint32_t>(recording.color.size());
  info->depth_count = static_cast<uint32_t>(recording.depth.size());
  info->pose_count = static_cast<uint32_t>(recording.poses.poses().size());
  info->bad_pose_count = recording.bad_pose_count;
  info->lost_count = recording.lost_count;
  info->bad_chunk_count = recording.bad_chunk_count;
  info->is_cut = recording.is_cut;
  info->acceleration_count = static_cast<uint32_t>(recording.accelerations.size());
  info->bad_acceleration_count = recording.bad_acceleration_count;
  return SPHC_OK;
}

sphc_status sphc_replay_rig(const sphc_replay *replay, sphc_rig *rig) {
  if (!replay || !rig) return SPHC_E_ARGUMENT;
  *rig = replay->reader.calibration();
  return SPHC_OK;
}

sphc_status sphc_replay_source(sphc_replay *replay, sphc_source *source) {
  if (!replay || !source) return SPHC_E_ARGUMENT;
  *source = replay->player.source();
  return SPHC_OK;
}

uint32_t sphc_replay_frame_count(const sphc_replay *replay) { return replay ? replay->reader.frameCount() : 0; }

sphc_status sphc_replay_get_frame_info(const sphc_replay *replay, uint32_t index, sphc_replay_frame_info *info) {
  if (!hasFrame(replay, index) || !info) return SPHC_E_ARGUMENT;
  if (info->struct_size != sizeof *info) return SPHC_E_STRUCT_SIZE;
  const RecordedImage &color = replay->reader.colorOf(index);
  info->sequence = color.sequence;
  info->color_time_ns = color.time_ns;
  info->depth_time_ns = replay->reader.depthOf(index).time_ns;
  info->has_pose = replay->reader.worldFromCamera(index).has_value();
  info->reserved = 0;
  return SPHC_OK;
}

sphc_status sphc_replay_read_frame(sphc_replay *replay, uint32_t index, sphc_localizer_frame *frame,
                                   sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!replay || !frame) throw Failure(SPHC_E_ARGUMENT, "replay or frame is null; give both");
    *frame = replay->reader.read(index);
    return SPHC_OK;
  });
}

sphc_status sphc_replay_pose(const sphc_replay *replay, uint32_t index, sphc_rigid *world_from_camera) {
  if (!hasFrame(replay, index)) return SPHC_E_ARGUMENT;
  return sphc_replay_pose_at(replay, replay->reader.colorOf(index).time_ns, world_from_camera);
}

sphc_status sphc_replay_pose_at(const sphc_replay *replay, int64_t time_ns, sphc_rigid *world_from_camera) {
  if (!replay || !world_from_camera) return SPHC_E_ARGUMENT;
  const std::optional<sphc_rigid> pose = replay->reader.worldFromCameraAt(time_ns);
  if (!pose) return SPHC_NOT_LOCALIZED;
  *world_from_camera = *pose;
  return SPHC_OK;
}

sphc_status sphc_replay_recorded_pose(const sphc_replay *replay, uint32_t index, int64_t *time_ns,
                                      sphc_rigid *world_from_camera) {
  if (!replay || !time_ns || !world_from_camera) return SPHC_E_ARGUMENT;
  const std::vector<TimedPose> &poses = replay->reader.recording().poses.poses();
  if (index >= poses.size()) return SPHC_E_ARGUMENT;
  *time_ns = poses[index].time_ns;
  *world_from_camera = poses[index].pose;
  return SPHC_OK;
}

sphc_status sphc_replay_acceleration(const sphc_replay *replay, uint32_t index, int64_t *time_ns,
                                     double felt_mps2[3]) {
  if (!replay || !time_ns || !felt_mps2) return SPHC_E_ARGUMENT;
  const std::vector<TimedAcceleration> &all = replay->reader.recording().accelerations;
  if (index >= all.size()) return SPHC_E_ARGUMENT;
  *time_ns = all[index].time_ns;
  std::copy_n(all[index].felt_mps2, 3, felt_mps2);
  return SPHC_OK;
}

}  // extern "C"
