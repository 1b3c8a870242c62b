#include "tests/soak/checks.h"

#include <algorithm>
#include <cmath>

namespace sphc::soak {
namespace {

bool areFinite(const double *values, size_t count) {
  return std::all_of(values, values + count, [](double value) { return std::isfinite(value); });
}

bool isRigid(const sphc_rigid &pose) {
  double length2 = 0;
  for (const double q : pose.q_wxyz) length2 += q * q;
  return std::abs(length2 - 1) < 1e-6 && areFinite(pose.t_m, 3);
}

bool isZero(const double *values, size_t count) {
  return std::all_of(values, values + count, [](double value) { return value == 0; });
}

// Symmetric, and all pivots of its Cholesky decomposition are above 0.
bool isPositive(const double *covariance) {
  double lower[6][6] = {};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) {
      const double a = covariance[6 * i + j];
      const double scale = std::sqrt(covariance[7 * i] * covariance[7 * j]);
      if (!(std::abs(a - covariance[6 * j + i]) <= 1e-9 * scale)) return false;
      double rest = a;
      for (int k = 0; k < j; ++k) rest -= lower[i][k] * lower[j][k];
      if (i == j && !(rest > 0)) return false;
      lower[i][j] = i == j ? std::sqrt(rest) : rest / lower[j][j];
    }
  return true;
}

bool isState(sphc_localizer_state state) { return state >= SPHC_STATE_RELOCALIZING && state <= SPHC_STATE_LOST; }

}  // namespace

const char *faultOf(sphc_status status, const sphc_localizer_frame &frame, const sphc_localizer_result &result) {
  if (status != SPHC_OK && status != SPHC_NOT_LOCALIZED) return "a frame has an answer";
  if ((status == SPHC_OK) != (result.outcome == SPHC_OUTCOME_LOCALIZED)) return "status and outcome say the same";
  if (result.outcome < SPHC_OUTCOME_LOCALIZED || result.outcome > SPHC_OUTCOME_CONTRADICTION)
    return "an outcome is one of those that are stated";
  if (!isState(result.state)) return "a state is one of those that are stated";
  if (result.time_ns != frame.color_time_ns || result.sequence != frame.sequence)
    return "an answer is of its frame";
  if (!isRigid(result.camera_from_map)) return "a pose is finite and its rotation is one";
  if (!(result.confidence >= 0 && result.confidence <= 1)) return "a confidence is a probability";
  if (result.inliers > result.keypoints * std::max(result.frames, 1u) || result.lifted > result.keypoints)
    return "counts fit together";
  if (result.outcome == SPHC_OUTCOME_LOCALIZED)
    return isPositive(result.covariance) ? nullptr : "a covariance is symmetric and positive";
  if (result.confidence != 0 || !isZero(result.covariance, 36) || result.events != 0)
    return "without a pose nothing is said of one";
  return nullptr;
}

const char *faultOf(sphc_status status, const sphc_localizer_prediction &prediction) {
  if (status != SPHC_OK && status != SPHC_NOT_LOCALIZED) return "a prediction of any time is answered";
  if (!isRigid(prediction.camera_from_map)) return "a predicted pose is finite and its rotation is one";
  if (!areFinite(prediction.velocity_in_map_m_s, 3) || !areFinite(prediction.angular_velocity_in_map_rad_s, 3))
    return "predicted velocities are finite";
  if (status == SPHC_OK && !isPositive(prediction.covariance)) return "a predicted covariance is positive";
  return isState(prediction.state) ? nullptr : "a state is one of those that are stated";
}

const char *faultOf(const sphc_localizer_hypothesis *hypotheses, uint32_t count) {
  if (count > SPHC_HYPOTHESES_MAX) return "there are no more hypotheses than are stated";
  for (uint32_t i = 0; i < count; ++i) {
    if (!isRigid(hypotheses[i].camera_from_map)) return "a hypothesis is finite and its rotation is one";
    if (i > 0 && hypotheses[i].gain > hypotheses[i - 1].gain) return "hypotheses of most gain come first";
  }
  return nullptr;
}

const char *faultOf(const Totals &totals) {
  // A frame may be both broken and elsewhere.
  const uint64_t hopeless = std::min(totals.frames, totals.elsewhere + totals.broken);
  if (2 * totals.localized <= totals.frames - hopeless) return "most frames of rooms with a map are localized";
  return totals.wrong_pose ? "no pose of an unbroken frame is wrong" : nullptr;
}

uint64_t digestOf(const void *bytes, size_t count, uint64_t before) {
  for (size_t i = 0; i < count; ++i) before = (before ^ static_cast<const uint8_t *>(bytes)[i]) * 0x100000001B3u;
  return before;
}

}  // namespace sphc::soak
