#include "recording.h"

#include <algorithm>

#include "failure.h"
#include "unfinished_folder.h"

namespace sphc::recording {

namespace fs = std::filesystem;

namespace {

// Index of the image nearest in time; of two equally near the earlier.  `images` is not empty.
size_t nearestInTime(const std::vector<RecordedImage> &images, int64_t time_ns) {
  const auto after =
      std::lower_bound(images.begin(), images.end(), time_ns,
                       [](const RecordedImage &image, int64_t time) { return image.time_ns < time; });
  const size_t index = static_cast<size_t>(after - images.begin());
  if (index == 0) return 0;
  if (index == images.size()) return index - 1;
  return time_ns - images[index - 1].time_ns <= images[index].time_ns - time_ns ? index - 1 : index;
}

bool isChosen(const Selection &selection, uint32_t sequence) {
  return sequence >= selection.first && sequence <= selection.last &&
         (sequence - selection.first) % selection.step == 0;
}

// What goes with a chosen colour image, and what a chosen frame has, though another colour image be nearer to it.
std::vector<RecordedImage> chosenDepth(const Selection &selection, int64_t tolerance_ns,
                                       const Recording &recording) {
  const auto is_chosen = [&](size_t color) { return isChosen(selection, recording.color[color].sequence); };
  std::vector<bool> kept;
  for (const RecordedImage &image : recording.depth)
    kept.push_back(is_chosen(nearestInTime(recording.color, image.time_ns)));
  for (const FramePair &pair : pairFrames(recording, tolerance_ns))
    if (is_chosen(pair.color)) kept[pair.depth] = true;
  std::vector<RecordedImage> depth;
  for (size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) depth.push_back(recording.depth[i]);
  return depth;
}

bool holdsSequences(const fs::path &folder) {
  for (const fs::directory_entry &entry : fs::directory_iterator(folder))
    if (entry.is_directory() && entry.path().filename().string().rfind("seq-", 0) == 0) return true;
  return false;
}

Recording openAny(const fs::path &folder) {
  if (fs::is_regular_file(folder)) {
    refuseForeignFile(folder);
    if (isRaw(folder)) return openRaw(folder);
    if (isRecord3d(folder)) return openRecord3d(folder);
    if (isMatroska(folder)) return openAzureKinect(folder);
    return isRos1Bag(folder) ? openRos1Bag(folder) : openMcap(folder);
  }
  const std::string name = shortPath(folder.string());
  if (!fs::exists(folder)) throw Failure(SPHC_E_DEVICE, name + ": no such folder or file; give a recording");
  if (!fs::is_directory(folder))
    throw Failure(SPHC_E_DEVICE, name + ": is a device or a pipe; give a recording, a folder or a file");
  if (isUnfinished(folder))
    throw Failure(SPHC_E_DEVICE, name + ": was not finished (unfinished.txt is in it); write it again, or remove " +
                                     "that file to read what is there");
  if (isTum(folder)) return openTum(folder);
  if (isRecord3d(folder)) return openRecord3d(folder);
  if (isRosBag(folder)) return openRosBag(folder);
  if (isStreamRecorder(folder)) return openStreamRecorder(folder);
  if (isHl2ss(folder)) return openHl2ss(folder);
  if (isStrayScanner(folder)) return openStrayScanner(folder);
  if (is7Scenes(folder)) return open7Scenes(folder);
  if (holdsSequences(folder))
    throw Failure(SPHC_E_DEVICE, name + ": holds several sequences; give one of its seq-* folders");
  throw Failure(SPHC_E_DEVICE, name +
                                   ": no recording here; expected rgb.txt and depth.txt (TUM), "
                                   "frame-000000.color.png and so on (7-Scenes), or what another program recorded "
                                   "(docs/imports.md)");
}

}  // namespace

Recording openRecording(const fs::path &folder) {
  try {
    return openAny(folder);
  } catch (const fs::filesystem_error &error) {  // of a folder that may not be looked into, say
    const bool is_denied = error.code() == std::errc::permission_denied;
    const bool is_in_folder = error.path1().parent_path() == folder;  // a name that may not be looked up
    throw Failure(SPHC_E_DEVICE,
                  shortPath((is_in_folder ? folder : error.path1()).string()) +
                      ": cannot be read: " + error.code().message() +
                      (is_denied ? "; check its permissions and those of its folders" : "; check its name"));
  }
}

void selectFrames(const Selection &selection, int64_t tolerance_ns, Recording &recording) {
  const uint32_t lowest = recording.color.front().sequence;
  const uint32_t highest = recording.color.back().sequence;
  std::vector<RecordedImage> depth = chosenDepth(selection, tolerance_ns, recording);
  std::vector<RecordedImage> color;
  for (const RecordedImage &image : recording.color)
    if (isChosen(selection, image.sequence)) color.push_back(image);
  if (color.empty())
    throw Failure(SPHC_E_ARGUMENT,
                  shortPath(recording.path.string()) + ": first " + std::to_string(selection.first) +
                      (selection.last < UINT32_MAX ? ", last " + std::to_string(selection.last) : "") +
                      (selection.step > 1 ? ", step " + std::to_string(selection.step) : "") +
                      " chooses no frame; the recording has numbers " + std::to_string(lowest) + " to " +
                      std::to_string(highest));
  recording.color = std::move(color);
  recording.depth = std::move(depth);
}

std::vector<FramePair> pairFrames(const Recording &recording, int64_t tolerance_ns) {
  std::vector<FramePair> pairs;
  if (recording.depth.empty()) return pairs;
  if (recording.is_by_frame) tolerance_ns = 0;
  pairs.reserve(recording.color.size());
  for (size_t i = 0; i < recording.color.size(); ++i) {
    const int64_t wanted_ns = recording.color[i].time_ns + recording.color[i].depth_after_ns;
    const size_t nearest = nearestInTime(recording.depth, wanted_ns);
    if (std::abs(recording.depth[nearest].time_ns - wanted_ns) <= tolerance_ns)
      pairs.push_back({static_cast<uint32_t>(i), static_cast<uint32_t>(nearest)});
  }
  return pairs;
}

}  // namespace sphc::recording
