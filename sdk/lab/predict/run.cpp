#include "lab/predict/run.h"

#include <cmath>

#include "host/evaluate/localize_run.h"
#include "host/evaluate/played_odometry.h"
#include "host/report/statistics.h"
#include "lab/common/pose_error.h"

namespace sphc::host {
namespace {

constexpr double kDegree = M_PI / 180;

// The errors at one time ahead.
struct Errors {
  std::vector<double> m, deg, still_m, still_deg, shift_sigmas, turn_sigmas;
};

double turnDeg(const Rigid &found, const Rigid &truth) { return turnRad(found, truth) / kDegree; }

void add(const sphc_localizer_prediction &prediction, const Rigid &still, const Rigid &truth, Errors *errors) {
  const Rigid found = rigidFromC(prediction.camera_from_map), off = truth * found.inverse();
  const Vector3 turn = vectorFromRotation(off.rotation);
  for (int i = 0; i < 3; ++i) {
    errors->turn_sigmas.push_back(std::abs(turn[i]) / std::sqrt(prediction.covariance[7 * i]));
    errors->shift_sigmas.push_back(std::abs(off.translation_m[i]) / std::sqrt(prediction.covariance[7 * (i + 3)]));
  }
  errors->m.push_back(shiftM(found, truth));
  errors->deg.push_back(turnDeg(found, truth));
  errors->still_m.push_back(shiftM(still, truth));
  errors->still_deg.push_back(turnDeg(still, truth));
}

std::optional<Rigid> truthAt(const PredictInput &input, int64_t time_ns) {
  const std::optional<sphc_rigid> world_from_camera = input.reader->worldFromCameraAt(time_ns);
  if (!world_from_camera) return std::nullopt;
  Rigid map_from_camera = rigidFromC(*world_from_camera);  // world_from_map is a translation
  map_from_camera.translation_m -= Vector3(input.centre_in_world_m.data());
  return map_from_camera.inverse();
}

PredictRow rowOf(int64_t ahead_ns, bool odometry, const Errors &errors) {
  PredictRow row;
  row.ahead_ns = ahead_ns;
  row.odometry = odometry;
  row.predictions = static_cast<uint32_t>(errors.m.size());
  row.error_m = percentile(errors.m, 0.5), row.error_deg = percentile(errors.deg, 0.5);
  row.still_m = percentile(errors.still_m, 0.5), row.still_deg = percentile(errors.still_deg, 0.5);
  row.shift_sigmas = percentile(errors.shift_sigmas, 0.6827),
  row.turn_sigmas = percentile(errors.turn_sigmas, 0.6827);
  row.shift_sigmas95 = percentile(errors.shift_sigmas, 0.9545);
  row.turn_sigmas95 = percentile(errors.turn_sigmas, 0.9545);
  return row;
}

}  // namespace

std::vector<PredictRow> runPredict(const PredictInput &input, bool odometry, const Unreadable &unreadable) {
  sphc_localizer_config config = spherecloud::defaultConfig();
  setCameras(input.reader->calibration(), &config);
  spherecloud::Localizer localizer = makeLocalizer(config, *input.maps);
  PlayedOdometry played(input.reader);
  std::vector<Errors> errors(input.ahead_ns.size());
  forReadableFrames(input.reader, unreadable, [&](uint32_t i, sphc_localizer_frame frame) {
    if (odometry) frame.prior = played.at(i);
    sphc_localizer_result result = spherecloud::emptyResult();
    localizer.process(frame, &result).orThrow();
    if (result.outcome != SPHC_OUTCOME_LOCALIZED || result.state != SPHC_STATE_TRACKING) return;
    for (size_t at = 0; at < errors.size(); ++at) {
      const int64_t time_ns = result.time_ns + input.ahead_ns[at];
      const std::optional<Rigid> truth = truthAt(input, time_ns);
      sphc_localizer_prediction prediction = spherecloud::emptyPrediction();
      if (truth && localizer.predict(time_ns, &prediction).ok())
        add(prediction, rigidFromC(result.camera_from_map), *truth, &errors[at]);
    }
  });
  std::vector<PredictRow> rows;
  for (size_t at = 0; at < errors.size(); ++at) rows.push_back(rowOf(input.ahead_ns[at], odometry, errors[at]));
  return rows;
}

}  // namespace sphc::host
