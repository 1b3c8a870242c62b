#include "recording_reader.h"

#include <spherecloud/spherecloud.hpp>

#include "calibration_json.h"
#include "failure.h"

namespace sphc::recording {

namespace {

// In place of the recording's own.
void takePoses(const std::filesystem::path &file, Recording *recording) {
  recording->bad_pose_count = 0;
  recording->poses = readTumPoses(file, &recording->bad_pose_count);
  if (recording->poses.poses().empty())
    throw Failure(SPHC_E_ARGUMENT,
                  shortPath(file.string()) + ": no pose in it; a line of each is \"seconds tx ty tz qx qy qz qw\"");
  recording->pose_fault.clear();
}

Recording openSelected(const std::filesystem::path &path, const ReaderOptions &options) {
  Recording recording = openRecording(path);
  if (!options.poses.empty()) takePoses(options.poses, &recording);
  selectFrames(options.selection, options.pair_tolerance_ns, recording);
  return recording;
}

sphc_rig calibrationFor(const Recording &recording, const std::filesystem::path &given) {
  if (!given.empty()) return readCalibration(given);
  if (recording.calibration) return *recording.calibration;
  if (!recording.calibration_fault.empty()) throw Failure(SPHC_E_ARGUMENT, recording.calibration_fault);
  if (std::filesystem::is_directory(recording.path)) return readCalibration(recording.path / "calibration.json");
  throw Failure(SPHC_E_ARGUMENT, shortPath(recording.path.string()) +
                                     ": no calibration in it; give a calibration file (docs/drivers.md)");
}

}  // namespace

RecordingReader::RecordingReader(const std::filesystem::path &path, const ReaderOptions &options)
    : recording_(openSelected(path, options)),
      calibration_(calibrationFor(recording_, options.calibration)),
      pose_gap_ns_(options.pose_gap_ns),
      frames_(pairFrames(recording_, options.pair_tolerance_ns)),
      images_(recording_, calibration_, options.color_format) {}

sphc_localizer_frame RecordingReader::read(uint32_t index) {
  if (index >= frameCount())
    throw Failure(SPHC_E_ARGUMENT, "frame " + std::to_string(index) + ": there are " +
                                       std::to_string(frameCount()) + ", counted from 0; choose one of them");
  const RecordedImage &color = colorOf(index);
  const RecordedImage &depth = depthOf(index);
  color_pixels_.resize(images_.colorBytes());
  depth_pixels_.resize(images_.depthBytes());
  const sphc_image color_image = images_.read(SPHC_STREAM_COLOR, color, color_pixels_.data());
  const sphc_image depth_image = images_.read(SPHC_STREAM_DEPTH, depth, depth_pixels_.data());
  sphc_localizer_frame frame =
      spherecloud::frame(color.sequence, color.time_ns, color_image, depth.time_ns, depth_image);
  if (depth.amplitude.kind != Kind::kNone) amplitude_pixels_.resize(images_.depthBytes());
  frame.amplitude = images_.readAmplitude(depth, amplitude_pixels_.data());
  return frame;
}

std::optional<sphc_localizer_frame> RecordingReader::tryRead(uint32_t index, std::string *why) {
  try {
    return read(index);
  } catch (const Failure &failure) {
    if (why) *why = failure.what();
    return {};
  }
}

std::optional<sphc_rigid> RecordingReader::worldFromCameraAt(int64_t time_ns) const {
  return recording_.poses.at(time_ns, pose_gap_ns_);
}

}  // namespace sphc::recording
