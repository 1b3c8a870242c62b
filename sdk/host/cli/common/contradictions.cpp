#include "host/cli/common/contradictions.h"

#include <algorithm>
#include <cmath>
#include <string_view>
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
// Below these the poses of some frames are doubtful: 55 % of all, and half of a part that shares many keypoints.
// Parts that share fewer, of frames far apart, go down to 39 % in sound recordings.
constexpr double kLeastOfSound = 0.55, kLeastOfSoundPart = 0.5;
constexpr uint32_t kMatchesOfSurePart = 250;
constexpr double kOneScale = 0.2;  // of the logarithms of two multiples
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
enum class Contradiction { kNone, kMistake, kAnyScale, kOtherScale };

Contradiction contradictionOfScale(const PoseScale &scale) {
  // A few keypoints agree by chance under one correction of many.
  if (scale.agree_corrected >= kFewestMatches && scale.agree_corrected >= kLeastOfAnyScale * scale.ofThePlace() &&
      scale.agree_most < kMostOfOtherScale * scale.agree_corrected)
    return Contradiction::kMistake;
  // A menu over the image may be most of what is seen; then the others agree.
  if (scale.matches >= kManyMatches && scale.agree_most < kLeastOfAnyScale * scale.matches &&
      scale.agree_most < kLeastOfSoundPart * scale.ofThePlace())
    return Contradiction::kAnyScale;
  if (scale.agree_most >= kFewestMatches && scale.agree < kMostOfOtherScale * scale.agree_most)
    return Contradiction::kOtherScale;
  return Contradiction::kNone;
}

std::string sharedKeypoints(const PoseScale &scale) {
  return counted(scale.matches, "keypoint") + " that two frames share";
}

constexpr char kScaleOfAll[] = "depth_unit_m of the calibration, or the unit of the poses, is another";
// A recording has one unit for all frames; a wrong focal length shows more in some.
constexpr char kScaleOfPart[] =
    "poses there are of another scale, or focal lengths of the calibration are wrong; leave these frames out "
    "(--first, --last), or calibrate again";

std::string wordsOf(Contradiction contradiction, const PoseScale &scale, const char *of_scale) {
  switch (contradiction) {
    case Contradiction::kNone:
      break;
    case Contradiction::kMistake:
      return scale.mistake + (". Then " + std::to_string(scale.agree_corrected)) + " of " + sharedKeypoints(scale) +
             " lie where the poses say, and now " + std::to_string(scale.agree);
    case Contradiction::kAnyScale:
      return "of " + sharedKeypoints(scale) + ", only " + std::to_string(scale.agree_most) +
             " lie where the poses say: " + kPoses;
    case Contradiction::kOtherScale:
      return "the camera goes about " + fixed(1 / scale.multiple, 1) +
             " times as far by the poses as by depth: " + of_scale;
  }
  return "";
}

// Neighbours that contradict in the same way are one.
bool areAlike(const PoseScalePart &a, const PoseScalePart &b) {
  const Contradiction of_a = contradictionOfScale(a.scale);
  return a.recording == b.recording && of_a == contradictionOfScale(b.scale) &&
         (of_a != Contradiction::kMistake || std::string_view(a.scale.mistake) == b.scale.mistake) &&
         (of_a != Contradiction::kOtherScale ||
          std::abs(std::log(a.scale.multiple / b.scale.multiple)) < kOneScale);
}

void join(const PoseScalePart &next, PoseScalePart *part) {
  PoseScale &scale = part->scale;
  if (next.scale.matches > scale.matches) scale.multiple = next.scale.multiple;
  scale.matches += next.scale.matches;
  scale.agree += next.scale.agree;
  scale.fixed_in_image += next.scale.fixed_in_image;
  scale.agree_most += next.scale.agree_most;
  scale.agree_corrected += next.scale.agree_corrected;
  part->last_sequence = next.last_sequence;
}

// Those that share keypoints enough to be judged.
std::vector<PoseScalePart> judgedParts(const RgbdImportSummary &summary) {
  std::vector<PoseScalePart> parts;
  for (const PoseScalePart &part : summary.scale_parts) {
    if (part.scale.matches < kManyMatches) continue;
    if (!parts.empty() && areAlike(parts.back(), part))
      join(part, &parts.back());
    else
      parts.push_back(part);
  }
  return parts;
}

std::string nameOf(const PoseScalePart &part, const RgbdImportSummary &summary) {
  const std::string of_recording =
      summary.scale_parts.back().recording > 0 ? " of recording " + std::to_string(part.recording + 1) : "";
  return "about frames " + std::to_string(part.first_sequence) + " to " + std::to_string(part.last_sequence) +
         of_recording;
}

// Where other parts are sound; else the whole is what contradicts.  A part that agrees with nothing is doubted, not
// refused: a camera that was shaken there may be why.
std::vector<std::string> contradictionsOfParts(const RgbdImportSummary &summary) {
  std::vector<std::string> sentences;
  const std::vector<PoseScalePart> parts = judgedParts(summary);
  const bool one_unit = summary.scale_parts.empty() || summary.scale_parts.back().recording == 0;
  const char *of_scale = one_unit ? kScaleOfPart : kScaleOfAll;
  for (const PoseScalePart &part : parts) {
    const Contradiction contradiction = contradictionOfScale(part.scale);
    if (contradiction == Contradiction::kMistake || contradiction == Contradiction::kOtherScale)
      sentences.push_back(nameOf(part, summary) +
                          ", unlike others: " + wordsOf(contradiction, part.scale, of_scale));
  }
  return sentences.size() < parts.size() ? sentences : std::vector<std::string>();
}

// Empty where they agree as in sound recordings, or where too few are compared.
std::string doubtOf(const PoseScale &scale, uint32_t fewest, double least, const std::string &where) {
  const uint32_t compared = scale.ofThePlace();
  if (compared < fewest || scale.agree >= least * compared) return "";
  return "of " + counted(compared, "keypoint") + " that two frames share, only " +
         std::to_string(100 * scale.agree / compared) + " % lie where poses and depth say" + where +
         ", and of sound recordings 60 to 97 %: poses of some frames may be wrong, or depth late; look at the path "
         "of the camera for jumps and mirrored stretches, and leave such frames out (--first, --last)";
}

// Of too few frames.
std::string uncheckedOf(const RgbdImportSummary &summary) {
  const uint32_t all = summary.frames_used + summary.frames_without_pose + summary.frames_unreadable;
  return "scale and consistency could not be checked: " + std::to_string(summary.frames_used) + " of " +
         counted(all, "frame") + (summary.frames_used == 1 ? " has" : " have") +
         " a pose and can be read, and that takes " + std::to_string(kFewestFrames) +
         "; give more frames a pose, or measure in the room whether the map is right";
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

std::string contradictionLines(const std::vector<std::string> &contradictions) {
  std::string lines;
  for (const std::string &contradiction : contradictions) lines += "\n  " + contradiction;
  return lines;
}

std::vector<std::string> contradictionsOfPoses(const RgbdImportSummary &summary) {
  if (summary.frames_used < kFewestFrames) return {};
  std::vector<std::string> sentences = contradictionsOfParts(summary);
  if (!sentences.empty()) return sentences;
  const Contradiction of_scale = contradictionOfScale(summary.scale);
  if (of_scale == Contradiction::kMistake) return {wordsOf(of_scale, summary.scale, kScaleOfAll)};
  const double merged =
      static_cast<double>(summary.merged) / static_cast<double>(std::max<uint64_t>(1, summary.lifted));
  const double disagreement = summary.moving.disagreement;
  if (merged < kHardlyMerged)
    sentences.push_back("hardly a point of " + counted(summary.frames_used, "frame") +
                        " lies where another frame sees it: " + kPoses);
  else if (disagreement > (merged < kThinlyMerged ? kMostOfThin : kMostDisagreement))
    sentences.push_back("the frames disagree on where things are, by " +
                        std::to_string(std::lround(100 * disagreement)) + " % of the depth: " + kPoses);
  if (of_scale != Contradiction::kNone) sentences.push_back(wordsOf(of_scale, summary.scale, kScaleOfAll));
  return sentences;
}

std::vector<std::string> doubtsOfPoses(const RgbdImportSummary &summary) {
  if (summary.frames_used < kFewestFrames) return {uncheckedOf(summary)};
  if (!contradictionsOfPoses(summary).empty()) return {};
  std::vector<std::string> sentences;
  size_t judged = 0;
  for (const PoseScalePart &part : summary.scale_parts) {
    judged += part.scale.ofThePlace() >= kMatchesOfSurePart;
    const bool agrees_with_nothing = contradictionOfScale(part.scale) == Contradiction::kAnyScale;
    const std::string of_part = doubtOf(part.scale, agrees_with_nothing ? 0 : kMatchesOfSurePart, kLeastOfSoundPart,
                                        " in " + nameOf(part, summary));
    if (!of_part.empty()) sentences.push_back(of_part);
  }
  const std::string of_whole = doubtOf(summary.scale, kManyMatches, kLeastOfSound, "");
  if (!of_whole.empty() && (sentences.empty() || 2 * sentences.size() > judged)) return {of_whole};
  return sentences;
}

}  // namespace sphc::host
