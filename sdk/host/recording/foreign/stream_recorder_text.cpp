#include "host/recording/foreign/stream_recorder_text.h"

#include <charconv>
#include <cstdint>

#include "host/base/median.h"
#include "host/cameras/rigid_matrix.h"
#include "host/recording/failure.h"
#include "host/recording/foreign/camera_axes.h"
#include "host/recording/foreign/comma_text.h"
#include "host/recording/text_field.h"

namespace sphc::recording {

namespace {

constexpr size_t kMatrixFields = 16;

[[noreturn]] void failLine(uint32_t line, const std::string &cause) {
  throw Failure(SPHC_E_ARGUMENT, "line " + std::to_string(line) + ": " + cause + "; copy the recording again");
}

// A 4 x 4 matrix row by row, from `first` on.  False where it is no pose.
bool poseIn(const Fields &fields, size_t first, sphc_rigid &pose) {
  double matrix[kMatrixFields];
  for (size_t i = 0; i < kMatrixFields; ++i)
    if (first + i >= fields.size() || !parseDouble(fields[first + i], matrix[i])) return false;
  return host::rigidFromRows(matrix, &pose);
}

// What a crash leaves behind: a last line without its end, and with fewer fields than a line has.
bool isCutOff(const Fields &fields, size_t whole, bool has_end) { return !has_end && fields.size() < whole; }

// Time, focal lengths, world_from_camera with axes right, up, back.
PvFrame pvFrameOf(const Fields &fields, uint32_t line, std::vector<double> (&focal)[2]) {
  PvFrame frame = {};
  double value[2];
  if (fields.size() < 3 + kMatrixFields || !parseTicks(fields[0], frame.time_ns) ||
      !parseDouble(fields[1], value[0]) || !parseDouble(fields[2], value[1]))
    failLine(line, "expected a time, two focal lengths and 16 numbers of a matrix");
  frame.name = fields[0];
  for (size_t i = 0; i < 2; ++i) focal[i].push_back(value[i]);
  sphc_rigid pose;
  if (poseIn(fields, 3, pose)) frame.world_from_camera = fromUpBackAxes(pose);
  return frame;
}

}  // namespace

bool parseTicks(std::string_view field, int64_t &time_ns) {
  constexpr uint64_t kTicksTo1970 = 116444736000000000;
  uint64_t ticks = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), ticks);
  if (error != std::errc() || end != field.data() + field.size() || ticks < kTicksTo1970) return false;
  ticks -= kTicksTo1970;
  if (ticks > INT64_MAX / 100) return false;
  time_ns = static_cast<int64_t>(ticks) * 100;
  return true;
}

PvFile pvFileFrom(std::string_view text) {
  PvFile file = {};
  const Fields head = fieldsOf(takeLine(text));
  if (head.size() < 4 || !parseDouble(head[0], file.params[2]) || !parseDouble(head[1], file.params[3]) ||
      !parseUnsigned(head[2], file.width) || !parseUnsigned(head[3], file.height))
    failLine(1, "expected the principal point and the size of the images");
  std::vector<double> focal[2];
  for (uint32_t number = 2; !text.empty(); ++number) {
    const bool has_end = text.find('\n') != std::string_view::npos;
    const Fields fields = fieldsOf(takeLine(text));
    if (fields.size() == 1 && fields[0].empty()) continue;
    if (isCutOff(fields, 3 + kMatrixFields, has_end)) break;
    PvFrame frame = pvFrameOf(fields, number, focal);
    if (!file.frames.empty() && frame.time_ns <= file.frames.back().time_ns)
      failLine(number, "time does not increase");
    file.frames.push_back(std::move(frame));
  }
  if (file.frames.empty()) failLine(1, "no line of a frame follows");
  for (size_t i = 0; i < 2; ++i) file.params[i] = host::median(focal[i]);
  return file;
}

PoseTrack rigTrackFrom(std::string_view text) {
  PoseTrack track;
  int64_t last_ns = -1;
  for (uint32_t number = 1; !text.empty(); ++number) {
    const bool has_end = text.find('\n') != std::string_view::npos;
    const Fields fields = fieldsOf(takeLine(text));
    if (fields.size() == 1 && fields[0].empty()) continue;
    if (isCutOff(fields, 1 + kMatrixFields, has_end)) break;
    int64_t time_ns = 0;
    if (!parseTicks(fields[0], time_ns)) failLine(number, "expected a time");
    if (time_ns <= last_ns) failLine(number, "time does not increase");
    last_ns = time_ns;
    sphc_rigid pose;
    if (poseIn(fields, 1, pose)) track.add(time_ns, pose);
  }
  return track;
}

sphc_rigid sensorFromRigFrom(std::string_view text) {
  std::string joined(text);  // one line or four
  for (char &each : joined)
    if (each == '\n') each = ',';
  Fields fields;
  for (const std::string_view field : fieldsOf(joined))
    if (!field.empty()) fields.push_back(field);
  sphc_rigid pose;
  if (!poseIn(fields, 0, pose)) failLine(1, "expected the 16 numbers of a rigid transform");
  return pose;
}

}  // namespace sphc::recording
