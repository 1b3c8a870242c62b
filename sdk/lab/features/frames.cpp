#include "lab/features/frames.h"

#include "host/frames/frame_images.h"

namespace sphc::host {

GrayRecording readGray(recording::RecordingReader *reader, const Unreadable &unreadable) {
  GrayRecording recording = {Camera(reader->calibration().color_camera), {}};
  forReadableFrames(reader, unreadable, [&](uint32_t i, const sphc_localizer_frame &frame) {
    GrayFrame gray;
    grayOf(frame.color, &gray.pixels);
    const std::optional<sphc_rigid> pose = reader->worldFromCamera(i);
    gray.has_pose = pose.has_value();
    if (pose) gray.world_from_camera = rigidFromC(*pose);
    recording.frames.push_back(std::move(gray));
  });
  return recording;
}

}  // namespace sphc::host
