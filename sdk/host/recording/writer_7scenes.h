// Writes the layout of the 7-Scenes data set, with a calibration file.
#pragma once

#include "calibration.h"
#include "encoded_image.h"
#include "unfinished_folder.h"

namespace sphc::recording {

// All throw Failure.  The folder counts as unfinished, and is read by nobody, until finish().
class SevenScenesWriter {
 public:
  // Makes the folder; its parent is there.  STATE when it holds a recording.
  SevenScenesWriter(const std::filesystem::path &folder, const sphc_rig &calibration);
  // frame-NNNNNN.color.png, .depth.png and, unless the pose (of the colour camera) is null, .pose.txt; NNNNNN is
  // frame.sequence, which no frame had before.  The layout keeps no times.
  void add(const sphc_localizer_frame &frame, const sphc_rigid *world_from_camera);
  void finish();

 private:
  std::filesystem::path fileOf(uint32_t number, const char *kind) const;

  UnfinishedFolder folder_;
  sphc_rig calibration_;
  ImageEncoder encoder_;
};

}  // namespace sphc::recording
