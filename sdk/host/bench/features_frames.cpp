#include "host/bench/features_frames.h"

#include <stdexcept>
#include <string>

#include "runtime/stages/features/gray.h"

namespace sphc::host {

GrayRecording readGray(sphc_replay *replay) {
  sphc_calibration calibration = {};
  calibration.struct_size = sizeof calibration;
  if (sphc_replay_calibration(replay, &calibration) != SPHC_OK)
    throw std::runtime_error("the recording's calibration cannot be read; check the calibration file");
  GrayRecording recording = {Camera(calibration.color_camera), {}};
  const int32_t width = recording.camera.width(), height = recording.camera.height();
  const uint32_t count = sphc_replay_frame_count(replay);
  for (uint32_t i = 0; i < count; ++i) {
    sphc_frame frame;
    sphc_message message;
    if (sphc_replay_read_frame(replay, i, &frame, &message) != SPHC_OK)
      throw std::runtime_error("frame " + std::to_string(i) + " cannot be read: " + message.text);
    GrayFrame gray;
    gray.pixels.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
    bgrToGray(static_cast<const uint8_t *>(frame.color.data), static_cast<int32_t>(frame.color.stride_bytes), width,
              height, gray.pixels.data(), width);
    sphc_rigid pose;
    gray.has_pose = sphc_replay_pose(replay, i, &pose) == SPHC_OK;
    if (gray.has_pose) gray.world_from_camera = rigidFromDoor(pose);
    recording.frames.push_back(std::move(gray));
  }
  return recording;
}

}  // namespace sphc::host
