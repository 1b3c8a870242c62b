#include "host/cli/map_warnings.h"

#include <algorithm>
#include <cmath>

#include "host/base/counted.h"
#include "host/cli/map_clock.h"
#include "host/guide/stretch_causes.h"
#include "host/guide/time_words.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

// Residuals that a sound recording does not have.  Depths far off: redkitchen 2.7 %, hololens 0.8 %; redkitchen as
// if its depth lay on the image 12.8 %, with a focal length 10 % off 10.8 %.  Keypoints, median: 0.2 to 0.9 sigma.
constexpr double kMostFarDepths = 0.06, kMostRaySigmas = 2;
// A metre of the recording's poses may differ so much from one of the depths, or more where that explains less than
// half of what the path is off (squared): a short path has no scale of its own.
constexpr double kMostScale = 0.02, kExplained = 0.7;

// What is wrong with poses of which most are wrong.
const char kAskOfPoses[] = ": are they of this recording, world_from_camera, and in metres?";

std::string count(size_t n) { return std::to_string(n); }

// What is known of why the stretches of a part met nothing else.
std::string causesOfPart(const std::vector<Stretch> &part) {
  std::string text;
  for (const Stretch &stretch : part)
    if (const auto causes = causesOf(stretch); !causes.empty()) text += " Measured: " + causesText(causes) + ".";
  return text;
}

void warnOfRecordings(const MapOutcome &outcome, const MapClock &clock, const Console &console) {
  for (const MappedRecording &recording : outcome.recordings) {
    if (recording.framesMapped() > 0) continue;
    std::vector<Stretch> of_it;
    for (const std::vector<Stretch> &part : outcome.stretches.apart)
      for (const Stretch &s : part)
        if (&clock.recordingOf(s) == &recording) of_it.push_back(s);
    console.warn(recording.name + " never met the others: none of its " + count(recording.poses.size()) +
                 " frames is in the map. Record it once more, and begin at a place that one of the others shows." +
                 causesOfPart(of_it));
  }
}

// But for parts of recordings of which nothing is in the map: warnOfRecordings() tells of these.
void warnOfParts(const MapOutcome &outcome, const MapClock &clock, const Console &console) {
  Stretches s = outcome.stretches;
  const auto is_of_strangers = [&](const std::vector<Stretch> &part) {
    return std::all_of(part.begin(), part.end(),
                       [&](const Stretch &stretch) { return clock.recordingOf(stretch).framesMapped() == 0; });
  };
  s.apart.erase(std::remove_if(s.apart.begin(), s.apart.end(), is_of_strangers), s.apart.end());
  if (s.apart.empty()) return;
  console.warn("The walk falls apart. The map is of its largest part alone, " + count(framesOf(s.mapped)) + " of " +
               count(outcome.walk.frameCount()) + " frames: " + clock.timesOf(s.mapped) + ".");
  for (const std::vector<Stretch> &part : s.apart)
    console.warn("It never met " + clock.timesOf(part) + " (" + counted(framesOf(part), "frame") +
                 "). Walk from what is seen there to what is seen at " + clock.timesOf(s.mapped) +
                 " once more, slowly, in one recording with the rest." + causesOfPart(part));
}

void noteUnreadable(const MapOutcome &outcome, const Console &console) {
  if (outcome.walk.unreadable)
    console.warn("note: " + counted(outcome.walk.unreadable, "frame") +
                 " could not be read; the first: " + outcome.walk.first_fault);
}

void warnOfTimes(const MapOutcome &outcome, const Console &console) {
  for (const MappedRecording &recording : outcome.recordings)
    for (const std::string &said : complaintsOf(recording.times))
      console.warn("note: " + (outcome.recordings.size() > 1 ? recording.name + ": " : "") + said);
}

void warnOfResiduals(const MapOutcome &outcome, const Console &console) {
  const AdjustmentSummary &residuals = outcome.mapped.residuals;
  if (residuals.far_depths > kMostFarDepths)
    console.warn(
        "note: " + fixed(100 * residuals.far_depths, 0) +
        " % of the depths contradict the images: is the calibration right, and does depth lie where it says "
        "(both cameras, color_from_depth)? spherecloud doctor shows it");
  if (residuals.ray_sigmas > kMostRaySigmas)
    console.warn("note: keypoints are off by " + fixed(residuals.ray_sigmas, 1) +
                 " sigma: is the calibration of the colour camera right?");
}

// What became of a world that was to be told.
std::string worldInstead(const MapOutcome &outcome) {
  if (outcome.use == PoseUse::kOdometry && !outcome.wants_told_axes) return "";
  return outcome.vertical.isKnown() ? ", and the world has its up from the accelerations alone"
                                    : ", and the world is the first frame's camera";
}

// None of what was told is wrong, but none is of a frame that has a place.
bool isToldElsewhere(const MapOutcome &outcome) {
  const MappedWalk &m = outcome.mapped;
  if (m.is_unbelieved) return outcome.use == PoseUse::kApproximate && m.told_wrong == 0;
  return outcome.wants_told_axes && !m.has_told_axes;
}

void warnOfPoses(const MapOutcome &outcome, const Console &console) {
  const MappedWalk &m = outcome.mapped;
  if (isToldElsewhere(outcome))
    console.warn("note: the poses are of frames that are not in the map, so none was used" + worldInstead(outcome) +
                 ": give poses of all of the walk, or map the part that has them by --first and --last");
  else if (m.is_unbelieved)
    console.warn("note: the images contradict the recording's poses altogether, so none was used" +
                 worldInstead(outcome) + kAskOfPoses);
  else if (m.told_wrong)
    console.warn("note: " + count(m.told_wrong) + " of " + count(m.told) + " " + toldWord(outcome) +
                 " are off by more than 4 sigma of what was stated; the images were believed more" +
                 (2 * m.told_wrong > m.told ? kAskOfPoses : ""));
}

// No image says whether they are right there.
void noteByToldAlone(const MapOutcome &outcome, const MapClock &clock, const Console &console) {
  const std::vector<Stretch> &alone = outcome.by_told_alone;
  if (alone.empty()) return;
  console.warn(std::string("note: only the ") +
               (outcome.use == PoseUse::kOdometry ? "odometry joins " : "poses join ") + clock.timesOf(alone) +
               " (" + counted(framesOf(alone), "frame") +
               ") to the rest of the map, and no image says whether that is right; look at the map there, or walk "
               "from there to the rest once more, so that images join them");
}

void warnOfTruth(const MapOutcome &outcome, const Console &console) {
  for (const MappedRecording &recording : outcome.recordings) {
    const auto &s = recording.score;
    if (recording.is_truth_inverse)
      console.warn("note: the poses of " + recording.name +
                   " are inverses, camera_from_world; the score expects world_from_camera, so invert each of them");
    else if (s && std::abs(s->scale - 1) > kMostScale && s->similarity_rmse_m < kExplained * s->rigid_rmse_m)
      console.warn("note: a metre of the poses of " + recording.name + " is " + fixed(s->scale, 3) +
                   " m of its depths: check depth_unit_m, the focal lengths, and the unit of the poses");
  }
}

}  // namespace

void noteStretchesLeftOut(const MapOutcome &outcome, const Console &console) {
  const MapClock clock(outcome);
  for (const Stretch &s : outcome.stretches.left_out)
    console.warn("note: left out: " + clock.timesOf({s}) + " (" + counted(s.frames, "frame") +
                 "): " + causesText(causesOf(s)));
}

void warnOfMap(const MapOutcome &outcome, const Console &console) {
  const MapClock clock(outcome);
  for (const std::string &warning : outcome.import.warnings) console.warn("note: " + warning);
  for (const std::string &doubt : outcome.import.doubts) console.warn("Warning: " + doubt);
  warnOfTimes(outcome, console);
  noteStretchesLeftOut(outcome, console);
  noteUnreadable(outcome, console);
  warnOfResiduals(outcome, console);
  warnOfPoses(outcome, console);
  noteByToldAlone(outcome, clock, console);
  if (!outcome.vertical.doubt.empty())
    console.warn("note: the accelerations do not tell the vertical: " + outcome.vertical.doubt);
  warnOfTruth(outcome, console);
  warnOfParts(outcome, clock, console);
  warnOfRecordings(outcome, clock, console);
}

}  // namespace sphc::host
