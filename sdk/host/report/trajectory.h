// A path in the TUM RGB-D benchmark's format, which evo and most tools read: "time tx ty tz qx qy qz qw" a line.
#pragma once
#include <string>

#include "host/report/run.h"

namespace sphc::host {

// The first line: what the poses are, "world" or "map" from camera, and which command wrote them.
std::string tumHead(const std::string &base, const std::string &command);
// Its part that is the same whatever the poses are.
std::string tumMark(const std::string &command);

std::string tumLine(int64_t time_ns, const sphc_rigid &base_from_camera);
// The localized frames of a run, in order of time, under a line that says what the poses are.
std::string tumTrajectory(const Run &run);

}  // namespace sphc::host
