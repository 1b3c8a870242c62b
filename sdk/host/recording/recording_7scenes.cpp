// The layout of the 7-Scenes data set: one folder, three files a frame, numbered.
#include <algorithm>
#include <string_view>

#include "failure.h"
#include "file_reader.h"
#include "host/cameras/rigid_matrix.h"
#include "recording.h"
#include "text_field.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

constexpr int64_t kFramesPerSecond = 30;

struct FrameFile {
  uint32_t number;
  std::string_view kind;  // "color.png"
};

// frame-NNNNNN.KIND
bool parseFrameFile(std::string_view name, FrameFile &file) {
  constexpr std::string_view kPrefix = "frame-";
  constexpr size_t kMostDigits = 10;  // of an unsigned number of 32 bits, as sources count
  if (name.substr(0, kPrefix.size()) != kPrefix) return false;
  name.remove_prefix(kPrefix.size());
  const size_t dot = name.find('.');
  if (dot == std::string_view::npos || dot > kMostDigits || !parseUnsigned(name.substr(0, dot), file.number))
    return false;
  file.kind = name.substr(dot + 1);
  return true;
}

bool isColor(std::string_view kind) { return kind == "color.jpg" || kind == "color.png"; }

bool isOtherDepth(std::string_view kind) { return kind.substr(0, 6) == "depth." && kind != "depth.png"; }

int64_t timeOf(uint32_t number) { return (int64_t{number} * 1000000000 + kFramesPerSecond / 2) / kFramesPerSecond; }

void sortByNumber(const std::string &folder, std::vector<RecordedImage> &images) {
  std::sort(images.begin(), images.end(),
            [](const RecordedImage &a, const RecordedImage &b) { return a.sequence < b.sequence; });
  const auto twice =
      std::adjacent_find(images.begin(), images.end(),
                         [](const RecordedImage &a, const RecordedImage &b) { return a.sequence == b.sequence; });
  if (twice != images.end())
    throw Failure(SPHC_E_DEVICE, folder + ": both " + twice->file + " and " + (twice + 1)->file +
                                     " have one frame's number; remove one of them");
}

bool readPose(const fs::path &path, sphc_rigid &pose) {
  const std::string content = readText(path);
  std::string_view rest = content;
  double matrix[16];
  for (double &value : matrix)
    if (!parseDouble(takeWord(rest), value)) return false;
  return host::rigidFromRows(matrix, &pose);
}

// Frames whose tracking failed have a pose of NaN: they simply have none.
void readPoses(const fs::path &folder, std::vector<RecordedImage> &files, Recording &recording) {
  sortByNumber(shortPath(folder.string()), files);
  for (const RecordedImage &file : files) {
    sphc_rigid pose;
    if (readPose(folder / file.file, pose))
      recording.poses.add(file.time_ns, pose);
    else
      ++recording.bad_pose_count;
  }
  if (!files.empty() && recording.poses.poses().empty())
    recording.pose_fault = "not one of its *.pose.txt is a pose (" + files.front().file +
                           ", for example); write each as four rows of four numbers with spaces between them";
}

[[noreturn]] void refuseWithoutDepth(const std::string &folder, const std::string &other_depth) {
  throw Failure(SPHC_E_DEVICE,
                folder + (other_depth.empty() ? ": no frame-*.depth.png; copy them too"
                                              : ": depth must be PNG of 16 bits in millimetres, and " +
                                                    other_depth + " is none; write each as frame-*.depth.png"));
}

}  // namespace

bool is7Scenes(const fs::path &folder) {
  for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    FrameFile file;
    if (parseFrameFile(name, file) && (isColor(file.kind) || file.kind == "depth.png")) return true;
  }
  return false;
}

Recording open7Scenes(const fs::path &folder) {
  Recording recording;
  recording.layout = Layout::kSevenScenes;
  recording.path = folder;
  std::vector<RecordedImage> poses;
  std::string other_depth;  // the first by name
  for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    FrameFile file;
    if (!parseFrameFile(name, file)) continue;
    const RecordedImage image{timeOf(file.number), file.number, name};
    if (isColor(file.kind)) recording.color.push_back(image);
    if (file.kind == "depth.png") recording.depth.push_back(image);
    if (file.kind == "pose.txt") poses.push_back(image);
    if (isOtherDepth(file.kind) && (other_depth.empty() || name < other_depth)) other_depth = name;
  }
  const std::string name = shortPath(folder.string());
  sortByNumber(name, recording.color);
  sortByNumber(name, recording.depth);
  if (recording.color.empty()) throw Failure(SPHC_E_DEVICE, name + ": no frame-*.color.png or .jpg; copy them too");
  if (recording.depth.empty()) refuseWithoutDepth(name, other_depth);
  readPoses(folder, poses, recording);
  return recording;
}

}  // namespace sphc::recording
