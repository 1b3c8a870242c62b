#include "writer_7scenes.h"

#include <cstdio>
#include <string>

#include "calibration_json.h"
#include "failure.h"
#include "file_writer.h"
#include "pixels.h"
#include "pose_track.h"
#include "text_field.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

// Four rows of four.
std::string matrixText(const sphc_rigid &pose) {
  const double w = pose.q_wxyz[0], x = pose.q_wxyz[1], y = pose.q_wxyz[2], z = pose.q_wxyz[3];
  const double *t = pose.t_m;
  return formatNumbers({1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), t[0]}) + "\n" +
         formatNumbers({2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), t[1]}) + "\n" +
         formatNumbers({2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), t[2]}) + "\n0 0 0 1\n";
}

UnfinishedFolder begin7Scenes(const fs::path &folder, const sphc_rig &calibration) {
  requireNoRecording(folder, {"calibration.json", "rgb.txt", "depth.txt"});
  UnfinishedFolder begun(folder);
  writeCalibration(folder / "calibration.json", calibration);
  return begun;
}

}  // namespace

SevenScenesWriter::SevenScenesWriter(const fs::path &folder, const sphc_rig &calibration)
    : folder_(begin7Scenes(folder, calibration)), calibration_(calibration) {}

fs::path SevenScenesWriter::fileOf(uint32_t number, const char *kind) const {
  char name[40];
  std::snprintf(name, sizeof name, "frame-%06u.%s", number, kind);
  return folder_.path() / name;
}

void SevenScenesWriter::add(const sphc_localizer_frame &frame, const sphc_rigid *world_from_camera) {
  checkImage(frame.color, calibration_.color_camera, true);
  checkImage(frame.depth, calibration_.depth_camera, false);
  const std::string pose = world_from_camera ? matrixText(checkedPose(*world_from_camera)) : "";
  const fs::path color = fileOf(frame.sequence, "color.png");
  if (fs::exists(color)) throw Failure(SPHC_E_STATE, shortPath(color.string()) + ": is there already; remove it");
  writeFile(color, encoder_.png(frame.color));
  writeFile(fileOf(frame.sequence, "depth.png"), encoder_.png(frame.depth));
  if (world_from_camera)
    writeFile(fileOf(frame.sequence, "pose.txt"), {reinterpret_cast<const uint8_t *>(pose.data()), pose.size()});
}

void SevenScenesWriter::finish() { folder_.finish(); }

}  // namespace sphc::recording
