// The text files of a HoloLens 2's StreamRecorder (https://github.com/microsoft/HoloLens2ForCV).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "host/recording/pose_track.h"

namespace sphc::recording {

// Times there are steps of 100 ns since 1601, of which we keep nanoseconds since 1970.  False beyond the year 2262.
bool parseTicks(std::string_view field, int64_t &time_ns);

struct PvFrame {
  int64_t time_ns;
  std::string name;  // of its image, the ticks
  std::optional<sphc_rigid> world_from_camera;
};

// NAME_pv.txt: the colour camera ("photo and video").
struct PvFile {
  uint32_t width, height;
  std::array<double, 4> params;  // fx, fy, cx, cy: the median of the frames
  std::vector<PvFrame> frames;   // times increase
};

// Each throws Failure (ARGUMENT); its text begins with the line.
PvFile pvFileFrom(std::string_view text);
// SENSOR_rig2world.txt: world_from_rig at the times of the sensor's images; lines without a pose are left out, and
// so is a last one that a crash cut off.
PoseTrack rigTrackFrom(std::string_view text);
// SENSOR_extrinsics.txt: sensor_from_rig.
sphc_rigid sensorFromRigFrom(std::string_view text);

}  // namespace sphc::recording
