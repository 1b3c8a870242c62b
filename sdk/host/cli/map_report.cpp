#include "host/cli/map_report.h"

#include <algorithm>
#include <cmath>

#include "host/base/counted.h"
#include "host/base/in_seconds.h"
#include "host/guide/stretch_causes.h"
#include "host/guide/time_words.h"
#include "host/report/hint_words.h"
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

nlohmann::ordered_json causesJson(const Stretch &stretch) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const StretchCause &cause : causesOf(stretch))
    json.push_back({{"name", cause.name}, {"measured", cause.measured}, {"cure", cause.cure}});
  return json;
}

// Stretches as seconds since their recording's first frame.
class Clock {
 public:
  explicit Clock(const MapOutcome &outcome) : outcome_(outcome) {}

  const MappedRecording &recordingOf(const Stretch &s) const {
    return outcome_.recordings[outcome_.walk.keyframes[s.first].recording];
  }
  double secondsOf(uint32_t keyframe) const {
    const WalkFrame &frame = outcome_.walk.keyframes[keyframe];
    return inSeconds(frame.time_ns - outcome_.recordings[frame.recording].reader->colorOf(0).time_ns);
  }
  std::string timesOf(const std::vector<Stretch> &stretches) const {
    std::string text;
    for (const Stretch &s : stretches)
      text += (text.empty() ? "" : ", ") + (outcome_.recordings.size() > 1 ? recordingOf(s).name + " " : "") +
              fixed(secondsOf(s.first), 1) + " to " + fixed(secondsOf(s.last), 1) + " s";
    return text;
  }
  nlohmann::ordered_json jsonOf(const std::vector<Stretch> &stretches) const {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Stretch &s : stretches)
      json.push_back({{"recording", recordingOf(s).name},
                      {"from_s", secondsOf(s.first)},
                      {"to_s", secondsOf(s.last)},
                      {"frames", s.frames},
                      {"hints", hintNames(s.hints)},
                      {"causes", causesJson(s)}});
    return json;
  }

 private:
  const MapOutcome &outcome_;
};

uint32_t framesOf(const std::vector<Stretch> &stretches) {
  uint32_t frames = 0;
  for (const Stretch &s : stretches) frames += s.frames;
  return frames;
}

// What is known of why the stretches of a part met nothing else.
std::string causesOfPart(const std::vector<Stretch> &part) {
  std::string text;
  for (const Stretch &stretch : part)
    if (const auto causes = causesOf(stretch); !causes.empty()) text += " Measured: " + causesText(causes) + ".";
  return text;
}

void warnOfRecordings(const MapOutcome &outcome, const Clock &clock, const Console &console) {
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
void warnOfParts(const MapOutcome &outcome, const Clock &clock, const Console &console) {
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

const char *toldWord(const MapOutcome &outcome) {
  return outcome.use == PoseUse::kOdometry ? "steps of the odometry" : "poses";
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
void noteByToldAlone(const MapOutcome &outcome, const Clock &clock, const Console &console) {
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

nlohmann::ordered_json residualsJson(const AdjustmentSummary &residuals) {
  return {{"ray_sigmas", residuals.ray_sigmas},
          {"depth_sigmas", residuals.depth_sigmas},
          {"depth_m", residuals.depth_off_m},
          {"far_depths", residuals.far_depths}};
}

nlohmann::ordered_json timesJson(const WalkTimes &times) {
  nlohmann::ordered_json pauses = nlohmann::ordered_json::array();
  for (const Pause &pause : times.pauses) pauses.push_back({{"from_s", pause.from_s}, {"to_s", pause.to_s}});
  return {{"backward", times.backward},
          {"unpaired", times.unpaired},
          {"apart_s", times.apart_s},
          {"drift_s_per_s", times.drift_s_per_s},
          {"pauses", pauses}};
}

nlohmann::ordered_json scoreJson(const MapOutcome &outcome, const MappedRecording &recording) {
  const TrajectoryScore &s = *recording.score;
  nlohmann::ordered_json json = {{"frames", s.frames},
                                 {"rigid_rmse_m", s.rigid_rmse_m},
                                 {"rigid_worst_m", s.rigid_worst_m},
                                 {"similarity_rmse_m", s.similarity_rmse_m},
                                 {"scale", s.scale},
                                 {"rotation_median_deg", s.rotation_median_deg},
                                 {"rotation_worst_deg", s.rotation_worst_deg}};
  if (s.revisit_worst_m) json["revisit_worst_m"] = *s.revisit_worst_m;
  if (outcome.mapped.is_in_told_world) json["unaligned_rmse_m"] = recording.unaligned_rmse_m;
  return json;
}

void addScore(const MapOutcome &outcome, const MappedRecording &recording, std::vector<Row> *rows) {
  const auto &s = recording.score;
  if (!s) return;
  const std::string of = outcome.recordings.size() > 1 ? " of " + recording.name : "";
  rows->push_back({"path error, RMSE" + of, fixed(100 * s->rigid_rmse_m, 2) + " cm",
                   "beside the recording's poses, after a rigid alignment; worst " +
                       fixed(100 * s->rigid_worst_m, 2) + " cm; worst turn " + fixed(s->rotation_worst_deg, 2) +
                       " deg, median " + fixed(s->rotation_median_deg, 2)});
  if (s->revisit_worst_m)
    rows->push_back({"where it came back", fixed(100 * *s->revisit_worst_m, 2) + " cm",
                     "at worst, of two places less than 0.5 m apart and 5 m or more of the way"});
  if (outcome.mapped.is_in_told_world)
    rows->push_back({"without alignment", fixed(100 * recording.unaligned_rmse_m, 2) + " cm", "of the same"});
  rows->push_back(
      {"scale", fixed(s->scale, 4), "after it the path error is " + fixed(100 * s->similarity_rmse_m, 2) + " cm"});
}

}  // namespace

uint32_t MappedRecording::framesMapped() const { return static_cast<uint32_t>(placedCount(poses)); }

recording::PoseTrack MappedRecording::path() const {
  recording::PoseTrack path;
  for (uint32_t i = 0; i < poses.size(); ++i)
    if (poses[i]) path.add(reader->colorOf(i).time_ns, rigidToC(*poses[i]));
  return path;
}

bool MapOutcome::isApart() const {
  return !stretches.apart.empty() ||
         std::any_of(recordings.begin(), recordings.end(), [](const auto &r) { return r.framesMapped() == 0; });
}

std::vector<Row> mapTable(const MapOutcome &outcome) {
  const MappedWalk &m = outcome.mapped;
  const size_t parts = 1 + outcome.stretches.apart.size();
  std::vector<Row> rows = {
      {"frames", count(framesOf(outcome.stretches.mapped)),
       "of " + count(outcome.walk.frameCount()) + "; " + count(outcome.walk.keyframes.size()) + " keyframes"},
      {"parts", count(parts),
       parts == 1 ? "all that was connected is in the map" : "only the largest is in the map"},
      {"links", count(m.links),
       "between frames near in time; " + count(m.loops) + " loops, " + count(m.contradicting) +
           " left out as contradicting"},
      {"points adjusted", count(m.residuals.points), "seen " + count(m.residuals.sightings) + " times"},
      {"residuals, median", fixed(m.residuals.ray_sigmas, 2),
       "sigma, of keypoints; of depths " + fixed(m.residuals.depth_sigmas, 2) + ", " +
           fixed(1000 * m.residuals.depth_off_m, 1) + " mm"},
      {"depth bias", fixed(1000 * m.depth.mean[0], 1) + " mm",
       "at " + fixed(m.depth.mid_m, 2) + " m, and " + fixed(1000 * m.depth.mean[1], 1) + " mm more a metre"},
      {"time", fixed(outcome.seconds, 1) + " s",
       fixed(outcome.processor_seconds, 1) + " s of a processor for poses"}};
  if (const auto &told = m.residuals_of_told)
    rows.push_back({"with the poses of the recording", fixed(told->ray_sigmas, 2),
                    "sigma, of keypoints; of depths " + fixed(told->depth_sigmas, 2) + ", " +
                        fixed(1000 * told->depth_off_m, 1) + " mm: the same sightings, points adjusted"});
  if (outcome.vertical.isKnown())
    rows.push_back({"vertical", fixed(outcome.vertical.sigma_rad * 180 / kPi, 2) + " deg",
                    "1 sigma, by " + count(outcome.vertical.accelerations) + " accelerations; up is +z"});
  if (outcome.use != PoseUse::kNone)
    rows.push_back({toldWord(outcome), count(m.told), count(m.told_wrong) + " of them off by more than 4 sigma"});
  if (outcome.recordings.size() > 1)
    for (const MappedRecording &recording : outcome.recordings)
      rows.push_back(
          {recording.name, count(recording.framesMapped()), "of " + count(recording.poses.size()) + " frames"});
  for (const MappedRecording &recording : outcome.recordings) addScore(outcome, recording, &rows);
  return rows;
}

void noteStretchesLeftOut(const MapOutcome &outcome, const Console &console) {
  const Clock clock(outcome);
  for (const Stretch &s : outcome.stretches.left_out)
    console.warn("note: left out: " + clock.timesOf({s}) + " (" + counted(s.frames, "frame") +
                 "): " + causesText(causesOf(s)));
}

void warnOfMap(const MapOutcome &outcome, const Console &console) {
  const Clock clock(outcome);
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

nlohmann::ordered_json mapJson(const MapOutcome &outcome) {
  const MappedWalk &m = outcome.mapped;
  const Clock clock(outcome);
  nlohmann::ordered_json json = {
      {"frames", outcome.walk.frameCount()},
      {"frames_mapped", framesOf(outcome.stretches.mapped)},
      {"keyframes", outcome.walk.keyframes.size()},
      {"unreadable", outcome.walk.unreadable},
      {"parts", 1 + outcome.stretches.apart.size()},
      {"mapped", clock.jsonOf(outcome.stretches.mapped)},
      {"apart", nlohmann::ordered_json::array()},
      {"left_out", clock.jsonOf(outcome.stretches.left_out)},
      {"links", m.links},
      {"loops", m.loops},
      {"contradicting", m.contradicting},
      {"points_adjusted", m.residuals.points},
      {"sightings", m.residuals.sightings},
      {"residuals", residualsJson(m.residuals)},
      {"depth_bias", {{"offset_m", m.depth.mean[0]}, {"slope", m.depth.mean[1]}, {"mid_m", m.depth.mid_m}}}};
  if (m.residuals_of_told) json["residuals_of_poses"] = residualsJson(*m.residuals_of_told);
  if (outcome.vertical.accelerations > 0)
    json["vertical"] = {{"accelerations", outcome.vertical.accelerations},
                        {"sigma_rad", outcome.vertical.sigma_rad},
                        {"used", outcome.vertical.isKnown()}};
  for (const std::vector<Stretch> &part : outcome.stretches.apart) json["apart"].push_back(clock.jsonOf(part));
  if (outcome.use != PoseUse::kNone)
    json["poses"] = {{"told", m.told},
                     {"off", m.told_wrong},
                     {"used", !m.is_unbelieved},
                     {"alone", clock.jsonOf(outcome.by_told_alone)}};
  json["recordings"] = nlohmann::ordered_json::array();
  for (const MappedRecording &recording : outcome.recordings) {
    nlohmann::ordered_json one = {{"recording", recording.name},
                                  {"frames", recording.poses.size()},
                                  {"frames_mapped", recording.framesMapped()}};
    one["times"] = timesJson(recording.times);
    if (recording.score) one["score"] = scoreJson(outcome, recording);
    json["recordings"].push_back(one);
  }
  if (outcome.recordings.size() == 1 && outcome.recordings[0].score)
    json["score"] = scoreJson(outcome, outcome.recordings[0]);
  json["points"] = outcome.import.facts;
  json["seconds"] = outcome.seconds;
  json["processor_seconds"] = outcome.processor_seconds;
  return json;
}

}  // namespace sphc::host
