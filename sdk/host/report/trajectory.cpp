#include "host/report/trajectory.h"

#include <cinttypes>
#include <cstdio>

namespace sphc::host {

std::string tumMark(const std::string &command) { return "_from_camera, metres, by spherecloud " + command + ")"; }

std::string tumHead(const std::string &base, const std::string &command) {
  return "# timestamp tx ty tz qx qy qz qw (" + base + tumMark(command) + "\n";
}

std::string tumLine(int64_t time_ns, const sphc_rigid &base_from_camera) {
  const double *t = base_from_camera.t_m, *q = base_from_camera.q_wxyz;
  const bool negative = time_ns < 0;
  const uint64_t ns = negative ? uint64_t{0} - static_cast<uint64_t>(time_ns) : static_cast<uint64_t>(time_ns);
  char text[256];
  // Seconds are printed as two integers: a double would lose nanoseconds of an absolute time.
  std::snprintf(text, sizeof text, "%s%" PRIu64 ".%09" PRIu64 " %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n",
                negative ? "-" : "", ns / 1000000000u, ns % 1000000000u, t[0], t[1], t[2], q[1], q[2], q[3], q[0]);
  return text;
}

std::string tumTrajectory(const Run &run) {
  std::string text = tumHead(run.base, "localize");
  for (const FrameRecord &frame : run.frames) {
    if (frame.localized) text += tumLine(frame.time_ns, frame.base_from_camera);
  }
  return text;
}

}  // namespace sphc::host
