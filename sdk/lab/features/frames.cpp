#include "lab/features/frames.h"

#include <stdexcept>
#include <string>

#include "host/frames/frame_images.h"
#include "host/frames/recording.h"

namespace sphc::host {

GrayRecording readGray(sphc_replay *replay) {
  GrayRecording recording = {Camera(calibrationOf(replay).color_camera), {}};
  const uint32_t count = sphc_replay_frame_count(replay);
  for (uint32_t i = 0; i < count; ++i) {
    sphc_frame frame;
    sphc_message message;
    if (sphc_replay_read_frame(replay, i, &frame, &message) != SPHC_OK)
      throw std::runtime_error("frame " + std::to_string(i) + " cannot be read: " + message.text);
    GrayFrame gray;
    grayOf(frame.color, &gray.pixels);
    sphc_rigid pose;
    gray.has_pose = sphc_replay_pose(replay, i, &pose) == SPHC_OK;
    if (gray.has_pose) gray.world_from_camera = rigidFromDoor(pose);
    recording.frames.push_back(std::move(gray));
  }
  return recording;
}

}  // namespace sphc::host
