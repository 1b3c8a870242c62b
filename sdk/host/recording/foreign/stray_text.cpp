#include "host/recording/foreign/stray_text.h"

#include <algorithm>
#include <string>

#include "host/base/median.h"
#include "host/cameras/rigid_matrix.h"
#include "host/recording/failure.h"
#include "host/recording/foreign/comma_text.h"
#include "host/recording/pose_track.h"
#include "host/recording/text_field.h"

namespace sphc::recording {

namespace {

[[noreturn]] void failStray(uint32_t line, const std::string &cause) {
  throw Failure(SPHC_E_ARGUMENT, "line " + std::to_string(line) + ": " + cause + "; copy the recording again");
}

constexpr std::string_view kNames[] = {"timestamp", "frame", "x",  "y",  "z",  "qx", "qy",
                                       "qz",        "qw",    "fx", "fy", "cx", "cy"};
constexpr size_t kNeeded = 9, kAll = 13;

// Where each name's column is; versions differ in what stands behind qw.
class Columns {
 public:
  explicit Columns(const Fields &header) {
    for (size_t i = 0; i < kAll; ++i) {
      at_[i] = static_cast<size_t>(std::find(header.begin(), header.end(), kNames[i]) - header.begin());
      if (at_[i] == header.size() && i < kNeeded) failStray(1, "no column \"" + std::string(kNames[i]) + "\"");
      has_camera_ = has_camera_ && at_[i] < header.size();
    }
  }
  bool hasCamera() const { return has_camera_; }
  std::string_view field(const Fields &fields, size_t name) const {
    return at_[name] < fields.size() ? fields[at_[name]] : std::string_view();
  }

 private:
  size_t at_[kAll];
  bool has_camera_ = true;
};

std::optional<sphc_rigid> poseOf(const double value[7]) {
  sphc_rigid pose = {{value[6], value[3], value[4], value[5]}, {value[0], value[1], value[2]}};
  if (!isFinite(pose) || !host::normalizeQuaternion(pose.q_wxyz, 1e-2)) return {};
  return pose;
}

}  // namespace

StrayOdometry strayOdometryFrom(std::string_view text) {
  StrayOdometry odometry;
  const Columns columns(fieldsOf(takeLine(text)));
  std::array<std::vector<double>, 4> params;
  for (uint32_t number = 2; !text.empty(); ++number) {
    const bool is_whole = text.find('\n') != std::string_view::npos;
    const std::string_view line = takeLine(text);
    if (line.empty()) continue;
    const Fields fields = fieldsOf(line);
    StrayFrame frame = {};
    double value[7 + 4] = {};
    bool is_good = parseSeconds(columns.field(fields, 0), frame.time_ns) &&
                   parseUnsigned(columns.field(fields, 1), frame.number);
    for (size_t i = 0; i < (columns.hasCamera() ? 11u : 7u); ++i)
      is_good = is_good && parseDouble(columns.field(fields, 2 + i), value[i]);
    if (!is_good && !is_whole) break;  // what a crash leaves behind
    if (!is_good) failStray(number, "expected a number for each of the first line's names");
    const StrayFrame *before = odometry.frames.empty() ? nullptr : &odometry.frames.back();
    if (before && (frame.time_ns <= before->time_ns || frame.number <= before->number))
      failStray(number, "time or frame does not increase");
    frame.world_from_camera = poseOf(value);
    odometry.frames.push_back(frame);
    for (size_t i = 0; columns.hasCamera() && i < 4; ++i) params[i].push_back(value[7 + i]);
  }
  if (odometry.frames.empty()) failStray(1, "no line of a frame follows");
  if (columns.hasCamera())
    odometry.params = {host::median(params[0]), host::median(params[1]), host::median(params[2]),
                       host::median(params[3])};
  return odometry;
}

PinholeParams strayCameraFrom(std::string_view text) {
  double matrix[9];
  for (uint32_t row = 0; row < 3; ++row) {
    const Fields fields = fieldsOf(takeLine(text));
    for (uint32_t column = 0; column < 3; ++column)
      if (fields.size() != 3 || !parseDouble(fields[column], matrix[3 * row + column]))
        failStray(row + 1, "expected three numbers with commas between them");
  }
  if (matrix[1] != 0 || matrix[3] != 0 || matrix[6] != 0 || matrix[7] != 0)
    failStray(1, "expected a camera matrix: fx 0 cx, 0 fy cy, 0 0 1");
  return {matrix[0], matrix[4], matrix[2], matrix[5]};
}

}  // namespace sphc::recording
