#include "replay.h"

#include <memory>

#include "host/recording/failure.h"
#include "host/recording/image_reader.h"
#include "host/recording/recording.h"
#include "player.h"

using namespace sphc::replay;
namespace fs = std::filesystem;

struct sphc_replay {
  sphc_replay(Recording &&opened, const sphc_calibration &its_calibration, const sphc_replay_config &its_config)
      : config(its_config),
        calibration(its_calibration),
        recording(std::move(opened)),
        frames(pairFrames(recording, config.pair_tolerance_ns)),
        reader(recording, calibration, config.color_format),
        player(recording, calibration, config) {}

  sphc_replay_config config;
  sphc_calibration calibration;
  Recording recording;
  std::vector<FramePair> frames;
  ImageReader reader;  // of read_frame; the player has its own
  std::vector<uint8_t> color_pixels, depth_pixels;
  Player player;
};

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

sphc_calibration readCalibration(const Recording &recording, const char *path, sphc_message *message) {
  if (!path && recording.calibration.struct_size != 0) return recording.calibration;
  if (!path && recording.layout == SPHC_REPLAY_MCAP)
    throw Failure(SPHC_E_ARGUMENT, shortPath(recording.path.string()) +
                                       ": no calibration in it; give a calibration file (docs/drivers.md)");
  sphc_calibration calibration;
  sphc_calibration_init(&calibration, sizeof calibration);
  sphc_message text{};
  const std::string file = path ? path : (recording.path / "calibration.json").string();
  const sphc_status status = sphc_calibration_read(file.c_str(), &calibration, message ? message : &text);
  if (status < 0) throw Failure(status, message ? message->text : text.text);
  return calibration;
}

// Null when the index is none.
const FramePair *frameAt(const sphc_replay *replay, uint32_t index) {
  return replay && index < replay->frames.size() ? &replay->frames[index] : nullptr;
}

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
    if (!path || !replay) throw Failure(SPHC_E_ARGUMENT, "path or replay is null");
    sphc_replay_config chosen;
    sphc_replay_config_init(&chosen, sizeof chosen);
    if (config && config->struct_size != sizeof *config)
      throw Failure(SPHC_E_STRUCT_SIZE,
                    "config.struct_size is none this library knows; use sphc_replay_config_init");
    if (config) chosen = *config;
    checkConfig(chosen);
    Recording recording = openRecording(path);
    const sphc_calibration calibration = readCalibration(recording, calibration_path, message);
    selectFrames(chosen, recording);
    *replay = std::make_unique<sphc_replay>(std::move(recording), calibration, chosen).release();
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
  const Recording &recording = replay->recording;
  info->layout = recording.layout;
  info->color_count = static_cast<uint32_t>(recording.color.size());
  info->depth_count = static_cast<uint32_t>(recording.depth.size());
  info->pose_count = static_cast<uint32_t>(recording.poses.poses().size());
  info->bad_pose_count = recording.bad_pose_count;
  info->lost_count = recording.lost_count;
  info->bad_chunk_count = recording.bad_chunk_count;
  info->is_cut = recording.is_cut;
  return SPHC_OK;
}

sphc_status sphc_replay_calibration(const sphc_replay *replay, sphc_calibration *calibration) {
  if (!replay || !calibration) return SPHC_E_ARGUMENT;
  if (calibration->struct_size != sizeof *calibration) return SPHC_E_STRUCT_SIZE;
  *calibration = replay->calibration;
  return SPHC_OK;
}

sphc_status sphc_replay_source(sphc_replay *replay, sphc_source *source) {
  if (!replay || !source) return SPHC_E_ARGUMENT;
  *source = replay->player.source();
  return SPHC_OK;
}

uint32_t sphc_replay_frame_count(const sphc_replay *replay) {
  return replay ? static_cast<uint32_t>(replay->frames.size()) : 0;
}

sphc_status sphc_replay_get_frame_info(const sphc_replay *replay, uint32_t index, sphc_replay_frame_info *info) {
  const FramePair *frame = frameAt(replay, index);
  if (!frame || !info) return SPHC_E_ARGUMENT;
  if (info->struct_size != sizeof *info) return SPHC_E_STRUCT_SIZE;
  const RecordedImage &color = replay->recording.color[frame->color];
  sphc_rigid pose;
  info->sequence = color.sequence;
  info->color_time_ns = color.time_ns;
  info->depth_time_ns = replay->recording.depth[frame->depth].time_ns;
  info->has_pose = sphc_replay_pose(replay, index, &pose) == SPHC_OK;
  info->reserved = 0;
  return SPHC_OK;
}

sphc_status sphc_replay_read_frame(sphc_replay *replay, uint32_t index, sphc_frame *frame, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!replay || !frame) throw Failure(SPHC_E_ARGUMENT, "replay or frame is null");
    const FramePair *pair = frameAt(replay, index);
    if (!pair)
      throw Failure(SPHC_E_ARGUMENT, "frame " + std::to_string(index) + ": there are " +
                                         std::to_string(replay->frames.size()) + ", counted from 0");
    const RecordedImage &color = replay->recording.color[pair->color];
    const RecordedImage &depth = replay->recording.depth[pair->depth];
    replay->color_pixels.resize(replay->reader.colorBytes());
    replay->depth_pixels.resize(replay->reader.depthBytes());
    const sphc_image color_image = replay->reader.read(SPHC_STREAM_COLOR, color, replay->color_pixels.data());
    const sphc_image depth_image = replay->reader.read(SPHC_STREAM_DEPTH, depth, replay->depth_pixels.data());
    *frame = {sizeof *frame, color.sequence, color.time_ns, depth.time_ns, color_image, depth_image, nullptr};
    return SPHC_OK;
  });
}

sphc_status sphc_replay_pose(const sphc_replay *replay, uint32_t index, sphc_rigid *world_from_camera) {
  const FramePair *frame = frameAt(replay, index);
  if (!frame) return SPHC_E_ARGUMENT;
  return sphc_replay_pose_at(replay, replay->recording.color[frame->color].time_ns, world_from_camera);
}

sphc_status sphc_replay_pose_at(const sphc_replay *replay, int64_t time_ns, sphc_rigid *world_from_camera) {
  if (!replay || !world_from_camera) return SPHC_E_ARGUMENT;
  const bool found = replay->recording.poses.at(time_ns, replay->config.pose_gap_ns, *world_from_camera);
  return found ? SPHC_OK : SPHC_NOT_LOCALIZED;
}

sphc_status sphc_replay_recorded_pose(const sphc_replay *replay, uint32_t index, int64_t *time_ns,
                                      sphc_rigid *world_from_camera) {
  if (!replay || !time_ns || !world_from_camera) return SPHC_E_ARGUMENT;
  const std::vector<TimedPose> &poses = replay->recording.poses.poses();
  if (index >= poses.size()) return SPHC_E_ARGUMENT;
  *time_ns = poses[index].time_ns;
  *world_from_camera = poses[index].pose;
  return SPHC_OK;
}

}  // extern "C"
