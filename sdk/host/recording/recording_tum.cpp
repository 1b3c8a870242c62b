// The layout of the TUM RGB-D benchmark: lists of times and files.
#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "failure.h"
#include "file_reader.h"
#include "host/cameras/rigid_matrix.h"
#include "recording.h"
#include "text_field.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void failLine(const fs::path &path, uint32_t line, const std::string &cause) {
  throw Failure(SPHC_E_ARGUMENT, shortPath(path.string()) + ", line " + std::to_string(line) + ": " + cause);
}

// A list names files of its own folder: neither by a path from the root, nor upwards, nor through a link that
// leaves.
std::string pathFault(const fs::path &folder, const fs::path &file) {
  const std::string cure = "; copy the image into the folder and name it there";
  if (file.is_absolute()) return "the file's path is absolute" + cure;
  if (std::find(file.begin(), file.end(), "..") != file.end()) return "the file's path goes upwards (..)" + cure;
  const fs::path real = fs::weakly_canonical(folder / file);  // an image that is missing is told when it is read
  const auto left = std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first;
  return left == folder.end() ? "" : "the file is a link out of the recording" + cure;
}

// A time before the clock's own beginning, or one that is too large for seconds and so of another unit.  In any,
// times since 1970 begin with 1 until 2033; others of as many digits count from when a machine or a recording
// began.
std::string faultOfTime(std::string_view time) {
  int64_t unused_ns = 0;
  if (!time.empty() && time[0] == '-' && parseSeconds(time.substr(1), unused_ns))
    return ", and " + std::string(time.substr(0, 24)) +
           " is below 0; add the same to the times of images and poses, until none is";
  const size_t digits = std::min(time.find_first_not_of("0123456789"), time.size());
  const bool is_number = digits == time.size() || time[digits] == '.';
  if (digits < 10 || !is_number || parseSeconds(time, unused_ns)) return "";
  const bool is_since_1970 = time[0] == '1';
  const auto [unit, parts] = is_since_1970 && digits == 13   ? std::pair("milliseconds", "1000")
                             : is_since_1970 && digits == 16 ? std::pair("microseconds", "1000000")
                                                             : std::pair("nanoseconds", "1000000000");
  return ", and " + std::string(time.substr(0, 24)) + " is too large for seconds: it looks like " + unit +
         "; divide the times by " + parts;
}

// Gives `parse` each line that is neither empty nor a comment; parse says false when the line is malformed.
// A malformed last line without its newline is what an interrupted recording leaves behind: it is not there.
using LineParser = std::function<bool(std::string_view line, uint32_t number)>;
void forEachLine(const fs::path &path, const char *expected, const LineParser &parse) {
  const std::string text = readText(path);
  std::string_view rest = text;
  for (uint32_t number = 1; !rest.empty(); ++number) {
    const size_t end = rest.find('\n');
    const bool complete = end != std::string_view::npos;
    std::string_view line = trimmed(rest.substr(0, end));
    rest.remove_prefix(complete ? end + 1 : rest.size());
    if (line.empty() || line[0] == '#' || parse(line, number) || !complete) continue;
    failLine(path, number,
             std::string("expected \"") + expected + "\"" + faultOfTime(withoutExponent(takeWord(line))));
  }
}

std::vector<RecordedImage> readImageList(const fs::path &path) {
  std::vector<RecordedImage> images;
  const fs::path folder = fs::canonical(path.parent_path());
  forEachLine(path, "seconds file", [&](std::string_view line, uint32_t number) {
    RecordedImage image{};
    if (!parseSeconds(takeWord(line), image.time_ns)) return false;
    image.file = trimmed(line);
    if (image.file.empty()) return false;
    const std::string fault = pathFault(folder, image.file);
    if (!fault.empty()) failLine(path, number, image.file.substr(0, 60) + ": " + fault);
    image.sequence = static_cast<uint32_t>(images.size());
    if (!images.empty() && image.time_ns <= images.back().time_ns)
      failLine(path, number, "time does not increase; sort the list and remove doubles");
    images.push_back(std::move(image));
    return true;
  });
  if (images.empty())
    throw Failure(SPHC_E_DEVICE, shortPath(path.string()) + ": names no image; expected \"seconds file\" lines");
  return images;
}

}  // namespace

PoseTrack readTumPoses(const fs::path &path, uint32_t *bad_count) {
  PoseTrack poses;
  int64_t last_ns = INT64_MIN;
  forEachLine(path, "seconds tx ty tz qx qy qz qw", [&](std::string_view line, uint32_t number) {
    int64_t time_ns = 0;
    double value[7];
    if (!parseSeconds(takeWord(line), time_ns)) return false;
    for (double &field : value)
      if (!parseDouble(takeWord(line), field)) return false;
    if (!trimmed(line).empty())
      failLine(path, number,
               "has more than 8 numbers, as KITTI's 12 without a time; expected \"seconds tx ty tz qx qy qz qw\"");
    if (time_ns < last_ns) failLine(path, number, "time decreases; sort the list");
    last_ns = time_ns;
    sphc_rigid pose{{value[6], value[3], value[4], value[5]}, {value[0], value[1], value[2]}};
    const bool is_first = poses.poses().empty() || poses.poses().back().time_ns < time_ns;  // of its time
    if (is_first && isFinite(pose) && host::normalizeQuaternion(pose.q_wxyz, 1e-2))
      poses.add(time_ns, pose);
    else
      ++*bad_count;
    return true;
  });
  return poses;
}

bool isTum(const fs::path &folder) { return fs::exists(folder / "rgb.txt") || fs::exists(folder / "depth.txt"); }

Recording openTum(const fs::path &folder) {
  Recording recording;
  recording.layout = Layout::kTum;
  recording.path = folder;
  recording.color = readImageList(folder / "rgb.txt");
  recording.depth = readImageList(folder / "depth.txt");
  if (fs::exists(folder / "groundtruth.txt"))
    recording.poses = readTumPoses(folder / "groundtruth.txt", &recording.bad_pose_count);
  return recording;
}

}  // namespace sphc::recording
