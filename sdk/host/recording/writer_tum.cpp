#include "writer_tum.h"

#include <algorithm>

#include "calibration_json.h"
#include "failure.h"
#include "file_writer.h"
#include "pixels.h"
#include "pose_track.h"
#include "text_field.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

std::string poseText(const sphc_rigid &pose) {
  return formatNumbers(
      {pose.t_m[0], pose.t_m[1], pose.t_m[2], pose.q_wxyz[1], pose.q_wxyz[2], pose.q_wxyz[3], pose.q_wxyz[0]});
}

UnfinishedFolder beginTum(const fs::path &folder, const sphc_rig &calibration) {
  requireNoRecording(folder, {"rgb.txt", "depth.txt", "groundtruth.txt", "calibration.json"});
  UnfinishedFolder begun(folder);
  fs::create_directory(folder / "rgb");
  fs::create_directory(folder / "depth");
  writeCalibration(folder / "calibration.json", calibration);
  return begun;
}

}  // namespace

TimedList::TimedList(const fs::path &path, const char *heading)
    : path_(path), file_(std::fopen(path.string().c_str(), "wb")) {
  if (!file_) failWrite(path_);
  writeLine(heading);
}

void TimedList::checkTime(int64_t time_ns) const {
  if (time_ns <= last_ns_)
    throw Failure(SPHC_E_ARGUMENT, path_.filename().string() + ": time " +
                                       formatSeconds(std::max<int64_t>(time_ns, 0)) +
                                       " s is negative or not later than the one before; give increasing times");
}

void TimedList::add(int64_t time_ns, const std::string &rest) {
  writeLine(formatSeconds(time_ns) + " " + rest);
  last_ns_ = time_ns;
  ++count_;
}

void TimedList::writeLine(const std::string &line) {
  if (std::fputs((line + "\n").c_str(), file_.get()) < 0 || std::fflush(file_.get()) != 0) failWrite(path_);
}

TumWriter::TumWriter(const fs::path &folder, const sphc_rig &calibration)
    : folder_(beginTum(folder, calibration)),
      calibration_(calibration),
      color_(folder / "rgb.txt", "# colour images: seconds file"),
      depth_(folder / "depth.txt", "# depth images: seconds file"),
      poses_(folder / "groundtruth.txt", "# world_from_camera: seconds tx ty tz qx qy qz qw") {}

TimedList &TumWriter::listOf(sphc_stream stream) {
  if (stream != SPHC_STREAM_COLOR && stream != SPHC_STREAM_DEPTH)
    throw Failure(SPHC_E_ARGUMENT, "capture.stream is " + std::to_string(stream) + "; give COLOR or DEPTH");
  return stream == SPHC_STREAM_COLOR ? color_ : depth_;
}

void TumWriter::checkImageOf(sphc_stream stream, const sphc_image &image) const {
  const bool is_color = stream == SPHC_STREAM_COLOR;
  checkImage(image, is_color ? calibration_.color_camera : calibration_.depth_camera, is_color);
}

void TumWriter::add(sphc_stream stream, int64_t time_ns, const sphc_image &image) {
  TimedList &list = listOf(stream);
  checkImageOf(stream, image);
  list.checkTime(time_ns);
  const ByteView png = encoder_.png(image);
  char name[32];
  std::snprintf(name, sizeof name, "%s/%06u.png", stream == SPHC_STREAM_COLOR ? "rgb" : "depth", list.count());
  writeFile(folder_.path() / name, png);
  list.add(time_ns, name);
}

void TumWriter::addFrame(const sphc_localizer_frame &frame) {
  checkImageOf(SPHC_STREAM_DEPTH, frame.depth);
  depth_.checkTime(frame.depth_time_ns);
  add(SPHC_STREAM_COLOR, frame.color_time_ns, frame.color);
  add(SPHC_STREAM_DEPTH, frame.depth_time_ns, frame.depth);
}

void TumWriter::addPose(int64_t time_ns, const sphc_rigid &world_from_camera) {
  const sphc_rigid pose = checkedPose(world_from_camera);
  poses_.checkTime(time_ns);
  poses_.add(time_ns, poseText(pose));
}

void TumWriter::finish() { folder_.finish(); }

}  // namespace sphc::recording
