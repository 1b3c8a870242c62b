#include "host/recording/foreign/record3d_metadata.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "host/base/median.h"
#include "host/cameras/rigid_matrix.h"
#include "host/recording/failure.h"
#include "host/recording/foreign/camera_axes.h"
#include "host/recording/foreign/comma_text.h"
#include "host/recording/pose_track.h"

namespace sphc::recording {

namespace {

using nlohmann::json;

// An hour of 60 frames a second has 250 bytes and 14 values a frame; a value takes many times its bytes in memory.
constexpr size_t kMostBytes = size_t{1} << 26, kMostValues = 5000000;
constexpr int kDeepest = 4;  // a list of poses has three levels

[[noreturn]] void failKey(const std::string &key, const std::string &cause) {
  throw Failure(SPHC_E_ARGUMENT, key + ": " + cause + "; export the recording again");
}

json parseLimited(std::string_view text) {
  if (text.size() > kMostBytes) failKey("metadata", "is over " + std::to_string(kMostBytes >> 20) + " MiB");
  size_t values = 0;
  const auto watch = [&values](int depth, json::parse_event_t, const json &) {
    if (depth > kDeepest) failKey("metadata", "is nested too deeply");
    if (++values > kMostValues) failKey("metadata", "holds more than an hour of frames has");
    return true;
  };
  return json::parse(text.begin(), text.end(), watch, false);
}

std::vector<double> numbersOf(const json &value, size_t count, const std::string &key) {
  const bool is_list = value.is_array() && value.size() == count;
  if (!is_list || !std::all_of(value.begin(), value.end(), [](const json &each) { return each.is_number(); }))
    failKey(key, "expected " + std::to_string(count) + " numbers");
  return value.get<std::vector<double>>();
}

double positiveOf(const json &root, const char *key) {
  const auto found = root.find(key);
  if (found == root.end() || !found->is_number() || !(found->get<double>() > 0))
    failKey(key, "expected a number over 0");
  return found->get<double>();
}

const json &listOf(const json &root, const char *key) {
  const auto found = root.find(key);
  if (found == root.end() || !found->is_array() || found->empty())
    failKey(key, "expected a list with an entry for every frame");
  return *found;
}

// The quaternion x, y, z, w, then the place.
std::optional<sphc_rigid> record3dPose(const json &entry) {
  const std::vector<double> value = numbersOf(entry, 7, "poses");
  sphc_rigid pose = {{value[3], value[0], value[1], value[2]}, {value[4], value[5], value[6]}};
  if (!isFinite(pose) || !host::normalizeQuaternion(pose.q_wxyz, 1e-2)) return {};
  return fromUpBackAxes(pose);
}

// K column by column; or the middle of the frames' own, where there are some.
std::array<double, 4> paramsOf(const json &root) {
  const auto frames = root.find("perFrameIntrinsicCoeffs");
  if (frames == root.end() || !frames->is_array() || frames->empty()) {
    const auto matrix = root.find("K");
    const std::vector<double> k = numbersOf(matrix == root.end() ? json() : *matrix, 9, "K");
    return {k[0], k[4], k[6], k[7]};
  }
  std::array<std::vector<double>, 4> columns;
  for (const json &entry : *frames) {
    const std::vector<double> value = numbersOf(entry, 4, "perFrameIntrinsicCoeffs");
    for (size_t i = 0; i < 4; ++i) columns[i].push_back(value[i]);
  }
  return {host::median(columns[0]), host::median(columns[1]), host::median(columns[2]), host::median(columns[3])};
}

int64_t nanosecondsOf(double seconds, const char *key) {
  if (!(seconds >= 0 && seconds < 9e9)) failKey(key, "expected seconds");
  return static_cast<int64_t>(std::llround(seconds * 1e9));
}

std::vector<int64_t> timesOf(const json &root, size_t count) {
  std::vector<int64_t> times;
  const auto told = root.find("frameTimestamps");
  if (told == root.end() || !told->is_array() || told->empty()) {
    const double rate = positiveOf(root, "fps");
    for (size_t i = 0; i < count; ++i) times.push_back(nanosecondsOf(static_cast<double>(i) / rate, "fps"));
  } else {
    for (const double seconds : numbersOf(*told, count, "frameTimestamps"))
      times.push_back(nanosecondsOf(seconds, "frameTimestamps"));
  }
  const auto stuck = std::adjacent_find(times.begin(), times.end(), [](int64_t a, int64_t b) { return a >= b; });
  if (stuck != times.end())
    failKey("frameTimestamps", "time does not increase at frame " + std::to_string(stuck - times.begin() + 1));
  return times;
}

}  // namespace

Record3dMetadata record3dMetadataFrom(std::string_view text) {
  const json root = parseLimited(text);
  if (!root.is_object()) failKey("metadata", "is no JSON object");
  Record3dMetadata metadata;
  metadata.params = paramsOf(root);
  metadata.width = positiveOf(root, "w");
  metadata.height = positiveOf(root, "h");
  if (root.contains("dw") && root.contains("dh")) {
    metadata.depth_width = positiveOf(root, "dw");
    metadata.depth_height = positiveOf(root, "dh");
  }
  const json &poses = listOf(root, "poses");
  for (const json &entry : poses) metadata.world_from_camera.push_back(record3dPose(entry));
  metadata.time_ns = timesOf(root, poses.size());
  return metadata;
}

}  // namespace sphc::recording
