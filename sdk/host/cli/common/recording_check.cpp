#include "host/cli/common/recording_check.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/base/counted.h"
#include "host/cli/common/contradictions.h"
#include "host/frames/recording.h"
#include "host/recording/failure.h"
#include "host/recording/image_reader.h"

namespace sphc::host {
namespace {

using recording::ImageReader;
using recording::Layout;
using recording::RecordedImage;
using recording::Recording;
using recording::RecordingReader;
using Grade = Finding::Grade;

constexpr size_t kTried = 5;  // images of a stream
// Frames are compared with those that follow them, so some stretches are looked at, at the pace of a walk.
constexpr uint32_t kStretches = 8, kOfStretch = 12;
constexpr int64_t kApartNs = 100000000;

// Reads images of a recording as if they were of the one stream or of the other.
class TrialReader {
 public:
  explicit TrialReader(const RecordingReader &reader)
      : images_(reader.recording(), reader.calibration(), SPHC_FORMAT_BGR8),
        pixels_(std::max(images_.colorBytes(), images_.depthBytes())) {}

  // Of images from all over the list: why the first cannot be used; none where one can.
  std::optional<recording::Failure> failure(sphc_stream as, const std::vector<RecordedImage> &list) {
    std::optional<recording::Failure> first;
    for (size_t i = 0; i < std::min(kTried, list.size()); ++i) {
      try {
        images_.read(as, list[i * list.size() / kTried], pixels_.data());
        return std::nullopt;
      } catch (const recording::Failure &failure) {
        if (!first) first = failure;
      }
    }
    return first;
  }

 private:
  ImageReader images_;
  std::vector<uint8_t> pixels_;
};

// A file is of one kind, whichever list names it.  A colour image never reads as depth; depth may read as grey.
bool areSwapped(const Recording &recording, TrialReader *images) {
  if (recording.layout != Layout::kTum && recording.layout != Layout::kSevenScenes) return false;
  return images->failure(SPHC_STREAM_DEPTH, recording.depth) &&
         !images->failure(SPHC_STREAM_DEPTH, recording.color);
}

// Of those with a pose; the others cost nothing, and are counted where not many have one.
std::vector<bool> framesToCompare(const RecordingReader &reader) {
  std::vector<uint32_t> posed;
  for (uint32_t i = 0; i < reader.frameCount(); ++i)
    if (reader.worldFromCamera(i)) posed.push_back(i);
  const bool are_few = !posed.empty() && posed.size() <= kStretches * kOfStretch;
  std::vector<bool> chosen(reader.frameCount(), are_few);
  for (uint32_t k = 0; k < kStretches && !are_few; ++k) {
    std::optional<int64_t> last_ns;
    uint32_t taken = 0;
    for (size_t i = k * posed.size() / kStretches; i < posed.size() && taken < kOfStretch; ++i) {
      const int64_t time_ns = reader.colorOf(posed[i]).time_ns;
      if (last_ns && time_ns - *last_ns < kApartNs) continue;
      last_ns = time_ns;
      chosen[posed[i]] = true;
      ++taken;
    }
  }
  return chosen;
}

}  // namespace

Findings findingsOfImages(const RecordingReader &reader) {
  const Recording &recording = reader.recording();
  TrialReader images(reader);
  if (areSwapped(recording, &images))
    return {{Grade::kWrong, "images",
             "colour and depth are swapped: " + recording.color.front().file + " is a depth image, and " +
                 recording.depth.front().file +
                 " is none; exchange the two lists of images, or the names of the files"}};
  Findings findings;
  for (const sphc_stream stream : {SPHC_STREAM_COLOR, SPHC_STREAM_DEPTH}) {
    const bool is_color = stream == SPHC_STREAM_COLOR;
    const auto failure = images.failure(stream, is_color ? recording.color : recording.depth);
    if (failure && failure->status() == SPHC_E_IMAGE)
      findings.push_back(
          {Grade::kWrong, is_color ? "colour images" : "depth images",
           std::string("not one fits the calibration, which is for images of another size or kind: ") +
               failure->what()});
  }
  return findings;
}

Findings findingsOfPoses(RecordingReader *reader, const RgbdImportOptions &import, const Progress &progress) {
  const size_t poses = reader->recording().poses.poses().size();
  const std::string &fault = reader->recording().pose_fault;
  if (!fault.empty()) return {{Grade::kDoubtful, "poses", fault}};
  if (poses == 0)
    return {{Grade::kDoubtful, "poses", "there are none, and build needs them; spherecloud map finds them"}};
  const std::vector<bool> chosen = framesToCompare(*reader);
  if (std::find(chosen.begin(), chosen.end(), true) == chosen.end())
    return {{Grade::kWrong, "poses",
             "none of " + counted(poses, "pose") + ofOtherTimes(*reader, reader->recording().poses)}};
  RgbdImportSummary summary;
  try {
    importRgbd({{reader, [&chosen](uint32_t i) { return chosen[i]; }}}, import, progress, &summary);
  } catch (const std::runtime_error &error) {
    return {{Grade::kDoubtful, "poses", error.what()}};
  }
  Findings findings;
  for (const std::string &sentence : contradictionsOfPoses(summary))
    findings.push_back({Grade::kWrong, "poses", sentence});
  for (const std::string &sentence : doubtsOfPoses(summary))
    findings.push_back({Grade::kDoubtful, "poses", sentence});
  if (findings.empty())
    findings.push_back({Grade::kFine, "poses",
                        "of " + counted(summary.scale.ofThePlace(), "keypoint") + " that two of " +
                            counted(summary.frames_used, "frame") + " share, " +
                            std::to_string(summary.scale.agree) + " lie where poses and depth say"});
  return findings;
}

}  // namespace sphc::host
