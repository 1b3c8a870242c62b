#include "host/cli/map_report.h"

#include "host/cli/map_clock.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

std::string count(size_t n) { return std::to_string(n); }

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

nlohmann::ordered_json mapJson(const MapOutcome &outcome) {
  const MappedWalk &m = outcome.mapped;
  const MapClock clock(outcome);
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
