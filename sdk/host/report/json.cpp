#include "host/report/json.h"

#include <cmath>

#include "host/report/reliability.h"

namespace sphc::host {

std::string jsonText(const nlohmann::ordered_json &value, int indent) {
  return value.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

namespace {

using Json = nlohmann::ordered_json;

Json rigidJson(const sphc_rigid &rigid) { return {{"q_wxyz", rigid.q_wxyz}, {"t_m", rigid.t_m}}; }

// JSON knows no NaN; what could not be measured is null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json spreadJson(const Spread &spread) {
  return {{"median", number(spread.median)}, {"p90", number(spread.p90)}, {"worst", number(spread.worst)}};
}

}  // namespace

Json frameJson(const FrameRecord &frame, const std::string &base) {
  Json json = {{"sequence", frame.sequence},
               {"time_ns", frame.time_ns},
               {"outcome", outcomeName(frame.outcome)},
               {"localized", frame.localized},
               {"keypoints", frame.keypoints},
               {"lifted", frame.lifted},
               {"matches", frame.matches},
               {"inliers", frame.inliers},
               {"iterations", frame.iterations},
               {"state", stateName(frame.state)},
               {"map", frame.map == SPHC_MAP_NONE ? Json() : Json(frame.map)},
               {"guided", frame.guided},
               {"frames_together", frame.frames_together},
               {"faults", faultNames(frame.faults)},
               {"cuts", cutNames(frame.cuts)},
               {"hints", hintNames(frame.hints)}};
  if (frame.localized) {
    json[base + "_from_camera"] = rigidJson(frame.base_from_camera);
    json["sigma"] = {{"rotation_deg", number(frame.sigma_rotation_deg)},
                     {"translation_m", number(frame.sigma_translation_m)}};
    json["events"] = eventNames(frame.events);
    json["jump"] = {{"rotation_deg", number(frame.jump_rad * 180 / M_PI)}, {"translation_m", number(frame.jump_m)}};
    if (frame.confidence) json["confidence"] = number(*frame.confidence);
  }
  if (frame.has_truth) json["truth_" + base + "_from_camera"] = rigidJson(frame.truth_base_from_camera);
  if (frame.localized && frame.has_truth) {
    json["error"] = {{"rotation_deg", number(frame.rotation_error_deg)},
                     {"translation_m", number(frame.translation_error_m)}};
  }
  json["depth_bias"] = {{"mid_m", number(frame.depth.mid_m)},
                        {"offset_m", number(frame.depth.offset_m)},
                        {"slope", number(frame.depth.slope)},
                        {"offset_sigma_m", number(frame.depth.offset_sigma_m)},
                        {"slope_sigma", number(frame.depth.slope_sigma)},
                        {"noise_scale", number(frame.depth.noise_scale)}};
  json["time_us"] = {{"features", frame.features_us},
                     {"align", frame.align_us},
                     {"match", frame.match_us},
                     {"pose", frame.pose_us},
                     {"total", frame.total_us}};
  return json;
}

Json unreadableJson(const UnreadableFrame &frame) {
  return {{"sequence", frame.sequence},
          {"time_ns", frame.time_ns},
          {"outcome", "unreadable"},
          {"localized", false},
          {"why", frame.why}};
}

std::string framesJsonLines(const Run &run) {
  std::string text;
  auto unreadable = run.unreadable.begin();
  const auto addUnreadable = [&](uint32_t before) {
    for (; unreadable != run.unreadable.end() && unreadable->index < before; ++unreadable)
      text += jsonText(unreadableJson(*unreadable)) + "\n";
  };
  for (const FrameRecord &frame : run.frames) {
    addUnreadable(frame.index);
    text += jsonText(frameJson(frame, run.base)) + "\n";
  }
  addUnreadable(UINT32_MAX);
  return text;
}

Json summaryJson(const Run &run, const Summary &s) {
  Json json = {{"recording", run.recording},
               {"maps", Json::array()},
               {"base", run.base},
               {"frames", s.frames},
               {"unreadable", run.unreadable.size()},
               {"localized", s.localized},
               {"localized_percent", percent(s.localized, s.frames)}};
  const std::vector<size_t> answers = answersByMap(run);
  for (size_t i = 0; i < run.maps.size(); ++i)
    json["maps"].push_back({{"path", run.maps[i].path},
                            {"map_id", run.maps[i].id},
                            {"points", run.maps[i].points},
                            {"localized", answers[i]}});
  json["tracking"] = s.tracking;
  json["guided"] = s.guided;
  for (const char *name : {"outcomes", "faults", "hints"}) json[name] = Json::object();
  for (size_t i = 0; i < s.outcomes.size(); ++i) {
    json["outcomes"][outcomeName(static_cast<sphc_localizer_outcome>(i))] = s.outcomes[i];
  }
  for (size_t i = 0; i < s.faults.size(); ++i) json["faults"][kFaultWords[i].name] = s.faults[i];
  for (size_t i = 0; i < s.hints.size(); ++i) json["hints"][kHintWords[i].name] = s.hints[i];
  json["cut"] = s.cut;
  if (run.aligned_frames) json["aligned_frames"] = run.aligned_frames;
  json["with_truth"] = s.with_truth;
  json["within_5cm_5deg"] = s.good;
  json["within_5cm_5deg_percent"] = s.with_truth ? Json(percent(s.good, s.with_truth)) : Json(nullptr);
  json["wrong_accepted"] = s.with_truth ? Json(s.wrong) : Json(nullptr);
  json["rotation_error_deg"] = spreadJson(s.rotation_deg);
  json["translation_error_m"] = spreadJson(s.translation_m);
  json["calibration_error"] = nullptr;
  if (const auto graded = gradedFrames(run); !graded.empty())
    json["calibration_error"] = {{"equal_width", number(calibrationError(equalWidthBins(graded)))},
                                 {"equal_count", number(calibrationError(equalCountBins(graded)))}};
  json["time_ms"] = Json::object();
  for (size_t i = 0; i < kStageCount; ++i) {
    json["time_ms"][kStageNames[i]] = {{"median", number(s.stage_median_ms[i])},
                                       {"p90", number(s.stage_p90_ms[i])}};
  }
  json["memory_bytes"] = {{"state", run.state_bytes}, {"scratch", run.scratch_bytes}, {"map", mapBytes(run)}};
  json["median"] = {{"keypoints", number(s.median_keypoints)},
                    {"matches", number(s.median_matches)},
                    {"inliers", number(s.median_inliers)}};
  json["settings"] = Json::object();
  for (const Setting &setting : run.settings) json["settings"][setting.name] = setting.value;
  return json;
}

}  // namespace sphc::host
