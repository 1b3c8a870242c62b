// A raw recording, which is made for devices, on the workstation.
#include <string>

#include "failure.h"
#include "file_reader.h"
#include "raw_file.h"
#include "recording.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

RecordedImage imageOf(const sphc_localizer_frame &frame, int64_t time_ns, uint32_t index) {
  RecordedImage image;
  image.time_ns = time_ns;
  image.sequence = frame.sequence;
  image.place.start = index;
  return image;
}

// False when the times go back, or are below 0.  Two frames may share a depth image.
bool addFrame(const sphc_raw_frame &recorded, uint32_t index, Recording &recording) {
  const sphc_localizer_frame &frame = recorded.frame;
  const bool has_depth = !recording.depth.empty();
  if (frame.color_time_ns < 0 || frame.depth_time_ns < 0) return false;
  if (!recording.color.empty() && frame.color_time_ns <= recording.color.back().time_ns) return false;
  if (has_depth && frame.depth_time_ns < recording.depth.back().time_ns) return false;
  recording.color.push_back(imageOf(frame, frame.color_time_ns, index));
  recording.color.back().depth_after_ns = frame.depth_time_ns - frame.color_time_ns;
  if (!has_depth || frame.depth_time_ns > recording.depth.back().time_ns)
    recording.depth.push_back(imageOf(frame, frame.depth_time_ns, index));
  if (recorded.has_pose) recording.poses.add(frame.color_time_ns, recorded.world_from_camera);
  return true;
}

}  // namespace

Recording openRaw(const fs::path &path) {
  const RawFile file(path);
  const std::string name = shortPath(path.string());
  Recording recording;
  recording.layout = Layout::kRaw;
  recording.path = path;
  recording.calibration = file.raw().rig;
  recording.is_by_frame = true;
  for (uint32_t i = 0; i < file.raw().frame_count; ++i)
    if (!addFrame(file.head(i), i, recording))
      throw Failure(SPHC_E_ARGUMENT,
                    name + ", frame " + std::to_string(i) + ": times go back, or are below 0; convert it again");
  if (recording.color.empty())
    throw Failure(SPHC_E_DEVICE, name + ": holds no frame; convert a recording with frames");
  return recording;
}

bool isRaw(const fs::path &path) { return beginsWith(path, "SPHC-RAW"); }

}  // namespace sphc::recording
