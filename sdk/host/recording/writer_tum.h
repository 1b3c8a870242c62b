// Writes the TUM layout, with a calibration file (docs/drivers.md).
#pragma once

#include <cstdio>
#include <memory>
#include <string>

#include "calibration.h"
#include "encoded_image.h"
#include "spherecloud/spherecloud_capture.h"
#include "unfinished_folder.h"

namespace sphc::recording {

// A list of a recording: a line an entry, each handed over at once, times increasing.
class TimedList {
 public:
  TimedList(const std::filesystem::path &path, const char *heading);
  uint32_t count() const { return count_; }
  void checkTime(int64_t time_ns) const;
  void add(int64_t time_ns, const std::string &rest);

 private:
  struct CloseFile {
    void operator()(std::FILE *file) const { std::fclose(file); }
  };
  void writeLine(const std::string &line);

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  int64_t last_ns_ = -1;
  uint32_t count_ = 0;
};

// All throw Failure.  The folder counts as unfinished, and is read by nobody, until finish().
class TumWriter {
 public:
  // Makes the folder; its parent is there.  STATE when it holds a recording.
  TumWriter(const std::filesystem::path &folder, const sphc_rig &calibration);
  // Times of a stream increase.  The image is borrowed.
  void add(sphc_stream stream, int64_t time_ns, const sphc_image &image);
  void addFrame(const sphc_localizer_frame &frame);  // both images or none
  void addPose(int64_t time_ns, const sphc_rigid &world_from_camera);
  void finish();

 private:
  TimedList &listOf(sphc_stream stream);
  void checkImageOf(sphc_stream stream, const sphc_image &image) const;

  UnfinishedFolder folder_;
  sphc_rig calibration_;
  TimedList color_, depth_, poses_;
  ImageEncoder encoder_;
};

}  // namespace sphc::recording
