#include "lab/negative/run.h"

#include <algorithm>
#include <cmath>

#include "host/evaluate/localize_run.h"
#include "host/report/statistics.h"

namespace sphc::host {

PoseError errorOf(const sphc_rigid &camera_from_map, const std::array<double, 3> &centre_in_world_m,
                  const sphc_rigid &truth_world_from_camera) {
  sphc_rigid world_from_camera = spherecloud::inverse(camera_from_map);
  for (size_t i = 0; i < 3; ++i) world_from_camera.t_m[i] += centre_in_world_m[i];
  return {translationErrorM(world_from_camera, truth_world_from_camera),
          rotationErrorDeg(world_from_camera, truth_world_from_camera)};
}

bool isGood(const PoseError &error) {
  return error.translation_m <= kGoodTranslationM && error.rotation_deg <= kGoodRotationDeg;
}

bool isWrong(const PoseError &error) {
  return error.translation_m > kWrongTranslationM || error.rotation_deg > kWrongRotationDeg;
}

namespace {

class FaultRun {
 public:
  FaultRun(const NegativeInput &input, const SensorFault &fault, sphc_localizer_mode mode)
      : input_(input), fault_(fault), mode_(mode) {
    row_.fault = fault.name;
    row_.mode = mode == SPHC_MODE_SINGLE ? "single" : "tracking";
  }

  NegativeRow run() {
    for (const Sequence &healthy : input_.sequences) {
      Sequence sequence = healthy;
      if (!fault_.with_odometry)
        for (Shot &shot : sequence.shots) shot.prior = {};
      fault_.apply(&sequence);
      runSequence(sequence);
    }
    return row_;
  }

 private:
  void runSequence(const Sequence &sequence) {
    if (sequence.shots.empty()) return;
    sphc_localizer_config config = spherecloud::defaultConfig();
    setCameras(sequence.rig, &config);
    config.mode = mode_;
    spherecloud::Localizer localizer = makeLocalizer(config, *input_.maps);
    const uint32_t named_before = row_.named;
    for (uint32_t i = 0; i < sequence.shots.size(); ++i) {
      sphc_localizer_result result = spherecloud::emptyResult();
      const spherecloud::Status status = localizer.process(frameOf(sequence, sequence.shots[i], i), &result);
      if (status.failed()) throw std::runtime_error(fault_.name + ": " + status.text());
      count(result, sequence.shots[i]);
    }
    ++row_.sequences;
    row_.sequences_named += row_.named > named_before;
  }

  void count(const sphc_localizer_result &result, const Shot &shot) {
    ++row_.tried;
    row_.seen |= result.faults;
    row_.named += (result.faults & (fault_.named_by ? fault_.named_by : ~0u)) != 0;
    if (result.outcome != SPHC_OUTCOME_LOCALIZED) return;
    ++row_.accepted;
    PoseError error = {INFINITY, 180};
    if (!fault_.is_elsewhere && !input_.elsewhere) {
      if (!shot.world_from_camera) return;
      error = errorOf(result.camera_from_map, input_.centre_in_world_m, *shot.world_from_camera);
    }
    if (!isWrong(error)) return;
    ++row_.wrong;
    if (!(result.confidence > kSureConfidence)) return;
    ++row_.wrong_sure;
    row_.worst_m = std::max(row_.worst_m, error.translation_m);
    row_.worst_deg = std::max(row_.worst_deg, error.rotation_deg);
  }

  const NegativeInput &input_;
  const SensorFault &fault_;
  sphc_localizer_mode mode_;
  NegativeRow row_;
};

}  // namespace

std::vector<NegativeRow> runNegative(const NegativeInput &input, const std::vector<SensorFault> &faults,
                                     const RowDone &done) {
  std::vector<NegativeRow> rows;
  const auto total = static_cast<uint32_t>(2 * faults.size());
  for (const SensorFault &fault : faults)
    for (const sphc_localizer_mode mode : {SPHC_MODE_SINGLE, SPHC_MODE_TRACKING}) {
      rows.push_back(FaultRun(input, fault, mode).run());
      done(static_cast<uint32_t>(rows.size()), total);
    }
  return rows;
}

}  // namespace sphc::host
