#include "recording_writer.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "encoded_image.h"
#include "failure.h"
#include "file_writer.h"
#include "pixels.h"
#include "pose_track.h"
#include "text_field.h"

using namespace sphc::replay;
namespace fs = std::filesystem;

namespace {

struct CloseFile {
  void operator()(std::FILE *file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// A list of the recording: a line an entry, each handed over at once, times increasing.
class List {
 public:
  List(const fs::path &path, const char *heading) : path_(path), file_(std::fopen(path.string().c_str(), "wb")) {
    if (!file_) failWrite(path_);
    writeLine(heading);
  }

  uint32_t count() const { return count_; }

  void checkTime(int64_t time_ns) const {
    if (time_ns <= last_ns_)
      throw Failure(SPHC_E_ARGUMENT, path_.filename().string() + ": time " +
                                         formatSeconds(std::max<int64_t>(time_ns, 0)) +
                                         " s is negative or not later than the one before; give increasing times");
  }

  void add(int64_t time_ns, const std::string &rest) {
    writeLine(formatSeconds(time_ns) + " " + rest);
    last_ns_ = time_ns;
    ++count_;
  }

 private:
  void writeLine(const std::string &line) {
    if (std::fputs((line + "\n").c_str(), file_.get()) < 0 || std::fflush(file_.get()) != 0) failWrite(path_);
  }

  fs::path path_;
  File file_;
  int64_t last_ns_ = -1;
  uint32_t count_ = 0;
};

std::string poseText(const sphc_rigid &pose) {
  return formatNumbers(
      {pose.t_m[0], pose.t_m[1], pose.t_m[2], pose.q_wxyz[1], pose.q_wxyz[2], pose.q_wxyz[3], pose.q_wxyz[0]});
}

}  // namespace

struct sphc_recording_writer {
  sphc_recording_writer(const fs::path &where, const sphc_calibration &its_calibration)
      : folder(where),
        calibration(its_calibration),
        color(where / "rgb.txt", "# colour images: seconds file"),
        depth(where / "depth.txt", "# depth images: seconds file"),
        poses(where / "groundtruth.txt", "# world_from_camera: seconds tx ty tz qx qy qz qw") {}

  void add(sphc_stream stream, int64_t time_ns, const sphc_image &image);

  fs::path folder;
  sphc_calibration calibration;
  List color, depth, poses;
  ImageEncoder encoder;
  bool is_broken = false;  // a list may end in half a line: no more lines
};

void sphc_recording_writer::add(sphc_stream stream, int64_t time_ns, const sphc_image &image) {
  const bool is_color = stream == SPHC_STREAM_COLOR;
  if (!is_color && stream != SPHC_STREAM_DEPTH)
    throw Failure(SPHC_E_ARGUMENT, "capture.stream is " + std::to_string(stream) + "; give COLOR or DEPTH");
  List &list = is_color ? color : depth;
  checkImage(image, is_color ? calibration.color_camera : calibration.depth_camera, is_color);
  list.checkTime(time_ns);
  const ByteView png = encoder.png(image);
  char name[32];
  std::snprintf(name, sizeof name, "%s/%06u.png", is_color ? "rgb" : "depth", list.count());
  writeFile(folder / name, png);
  list.add(time_ns, name);
}

namespace {

// Runs one append; after a failure to write, the recording is closed to further ones.
template <typename Body>
sphc_status append(sphc_recording_writer *writer, sphc_message *message, Body &&body) {
  const sphc_status status = guarded(message, [&]() -> sphc_status {
    if (!writer) throw Failure(SPHC_E_ARGUMENT, "writer is null");
    if (writer->is_broken) throw Failure(SPHC_E_STATE, "an earlier write failed; close the recording");
    return body();
  });
  if (status == SPHC_E_DEVICE) writer->is_broken = true;
  return status;
}

}  // namespace

extern "C" {

sphc_status sphc_recording_create(const char *folder, const sphc_calibration *calibration,
                                  sphc_recording_writer **writer, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!folder || !writer) throw Failure(SPHC_E_ARGUMENT, "folder or writer is null");
    const sphc_status status = sphc_calibration_check(calibration, message);
    if (status < 0) return status;
    const fs::path path(folder);
    for (const char *name : {"rgb.txt", "depth.txt", "groundtruth.txt", "calibration.json"})
      if (fs::exists(path / name))
        throw Failure(SPHC_E_STATE, shortPath(folder) + ": holds a " + name +
                                        " already; remove it or record into another folder");
    for (const fs::path &each : {path, path / "rgb", path / "depth"}) fs::create_directory(each);
    const sphc_status written =
        sphc_calibration_write((path / "calibration.json").string().c_str(), calibration, message);
    if (written < 0) return written;
    *writer = std::make_unique<sphc_recording_writer>(path, *calibration).release();
    return SPHC_OK;
  });
}

sphc_status sphc_recording_add(sphc_recording_writer *writer, const sphc_capture *capture, sphc_message *message) {
  return append(writer, message, [&]() -> sphc_status {
    if (!capture) throw Failure(SPHC_E_ARGUMENT, "capture is null");
    if (capture->struct_size != sizeof *capture) throw Failure(SPHC_E_STRUCT_SIZE, "capture.struct_size");
    writer->add(capture->stream, capture->time_ns, capture->image);
    return SPHC_OK;
  });
}

sphc_status sphc_recording_add_frame(sphc_recording_writer *writer, const sphc_frame *frame,
                                     sphc_message *message) {
  return append(writer, message, [&]() -> sphc_status {
    if (!frame) throw Failure(SPHC_E_ARGUMENT, "frame is null");
    if (frame->struct_size != sizeof *frame) throw Failure(SPHC_E_STRUCT_SIZE, "frame.struct_size");
    checkImage(frame->depth, writer->calibration.depth_camera, false);  // both or none
    writer->depth.checkTime(frame->depth_time_ns);
    writer->add(SPHC_STREAM_COLOR, frame->color_time_ns, frame->color);
    writer->add(SPHC_STREAM_DEPTH, frame->depth_time_ns, frame->depth);
    return SPHC_OK;
  });
}

sphc_status sphc_recording_add_pose(sphc_recording_writer *writer, int64_t time_ns,
                                    const sphc_rigid *world_from_camera, sphc_message *message) {
  return append(writer, message, [&]() -> sphc_status {
    if (!world_from_camera) throw Failure(SPHC_E_ARGUMENT, "world_from_camera is null");
    sphc_rigid pose = *world_from_camera;
    if (!isFinite(pose)) throw Failure(SPHC_E_ARGUMENT, "pose: not finite");
    if (!normalizeQuaternion(pose.q_wxyz, 1e-3))
      throw Failure(SPHC_E_ARGUMENT, "pose: q_wxyz is not of unit length; divide by its length");
    writer->poses.checkTime(time_ns);
    writer->poses.add(time_ns, poseText(pose));
    return SPHC_OK;
  });
}

void sphc_recording_close(sphc_recording_writer **writer) {
  if (!writer) return;
  delete *writer;
  *writer = nullptr;
}

}  // extern "C"
