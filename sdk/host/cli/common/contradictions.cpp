#include "host/cli/common/contradictions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/base/counted.h"
#include "host/report/fault_words.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

constexpr uint32_t kFewestFrames = 10;  // that contradict each other
// Keypoints with depth that lie where another frame sees them: 2 % in the thinnest sound walk of 10 frames, a third
// and more where they come from step to step.
constexpr double kHardlyMerged = 0.001, kThinlyMerged = 0.1;
// Of depth; 0.4 % in sound recordings, and half of this where the sensor and the poses of a telephone are off in
// scale.
constexpr double kMostDisagreement = 0.08, kMostOfThin = 0.06;
// Of keypoints that two frames share, 60 to 97 % of sound recordings lie where the poses say.
constexpr uint32_t kFewestMatches = 40, kManyMatches = 100;
constexpr double kMostOfOtherScale = 0.5, kLeastOfAnyScale = 0.2;
constexpr double kSomeFrames = 0.1, kMostFrames = 0.75;

std::string inFrames(uint32_t frames, const RgbdImportSummary &summary, const BitWords &words) {
  return std::string(words.name) + " in " + std::to_string(frames) + " of " +
         counted(summary.frames_used, "frame") + ": " + words.cure;
}

std::vector<std::string> faultsAbove(double share, const RgbdImportSummary &summary) {
  std::vector<std::string> sentences;
  for (const BitWords &words : kFaultWords) {
    const uint32_t frames = summary.frames_with_fault.of(words.bit);
    if (frames > share * summary.frames_used) sentences.push_back(inFrames(frames, summary, words));
  }
  return sentences;
}

constexpr char kPoses[] =
    "are poses in metres, world_from_camera and not its inverse, with x right, y down and z ahead, the quaternion "
    "in "
    "the order of the file, and of these images; is depth_unit_m right?";

// Keypoints that two frames share know nothing of the poses, so they tell wrong poses from what moves.
std::string mistakeOf(const PoseScale &scale) {
  if (scale.agree_corrected < kFewestMatches || scale.agree_most >= kMostOfOtherScale * scale.agree_corrected)
    return "";
  return scale.mistake + (". Then " + std::to_string(scale.agree_corrected)) + " of " +
         counted(scale.matches, "keypoint") + " that two frames share lie where the poses say, and now " +
         std::to_string(scale.agree);
}

std::string contradictionOfScale(const PoseScale &scale) {
  if (scale.matches >= kManyMatches && scale.agree_most < kLeastOfAnyScale * scale.matches)
    return "of " + counted(scale.matches, "keypoint") + " that two frames share, only " +
           std::to_string(scale.agree_most) + " lie where the poses say: " + kPoses;
  if (scale.agree_most >= kFewestMatches && scale.agree < kMostOfOtherScale * scale.agree_most)
    return "the camera goes about " + fixed(1 / scale.multiple, 1) +
           " times as far by the poses as by depth: depth_unit_m of the calibration, or the unit of the poses, is "
           "another";
  return "";
}

}  // namespace

std::vector<std::string> faultsOfFrames(const RgbdImportSummary &summary) {
  return faultsAbove(kSomeFrames, summary);
}

std::vector<std::string> contradictionsOf(const RgbdImportSummary &summary) {
  if (summary.frames_used < kFewestFrames) return {};
  std::vector<std::string> sentences = faultsAbove(kMostFrames, summary);
  for (std::string &sentence : contradictionsOfPoses(summary)) sentences.push_back(std::move(sentence));
  return sentences;
}

std::vector<std::string> contradictionsOfPoses(const RgbdImportSummary &summary) {
  if (summary.frames_used < kFewestFrames) return {};
  const std::string mistake = mistakeOf(summary.scale);
  if (!mistake.empty()) return {mistake};
  std::vector<std::string> sentences;
  const double merged =
      static_cast<double>(summary.merged) / static_cast<double>(std::max<uint64_t>(1, summary.lifted));
  const double disagreement = summary.moving.disagreement;
  if (merged < kHardlyMerged)
    sentences.push_back("hardly a point of " + counted(summary.frames_used, "frame") +
                        " lies where another frame sees it: " + kPoses);
  else if (disagreement > (merged < kThinlyMerged ? kMostOfThin : kMostDisagreement))
    sentences.push_back("the frames disagree on where things are, by " +
                        std::to_string(std::lround(100 * disagreement)) + " % of the depth: " + kPoses);
  const std::string of_scale = contradictionOfScale(summary.scale);
  if (!of_scale.empty()) sentences.push_back(of_scale);
  return sentences;
}

std::string uncheckedOf(const RgbdImportSummary &summary) {
  if (summary.frames_used >= kFewestFrames) return "";
  const uint32_t all = summary.frames_used + summary.frames_without_pose + summary.frames_unreadable;
  return "scale and consistency could not be checked: " + std::to_string(summary.frames_used) + " of " +
         counted(all, "frame") + (summary.frames_used == 1 ? " has" : " have") +
         " a pose and can be read, and that takes " + std::to_string(kFewestFrames) +
         "; give more frames a pose, or measure in the room whether the map is right";
}

}  // namespace sphc::host
