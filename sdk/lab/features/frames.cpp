#include "lab/features/frames.h"

#include "host/frames/frame_images.h"

namespace sphc::host {

GrayRecording readGray(recording::RecordingReader *reader) {
  GrayRecording recording = {Camera(reader->calibration().color_camera), {}};
  const uint32_t count = reader->frameCount();
  for (uint32_t i = 0; i < count; ++i) {
    GrayFrame gray;
    grayOf(reader->read(i).color, &gray.pixels);
    const std::optional<sphc_rigid> pose = reader->worldFromCamera(i);
    gray.has_pose = pose.has_value();
    if (pose) gray.world_from_camera = rigidFromC(*pose);
    recording.frames.push_back(std::move(gray));
  }
  return recording;
}

}  // namespace sphc::host
