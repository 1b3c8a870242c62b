#include "runtime/stages/pose/leverage.h"

#include <Eigen/LU>
#include <algorithm>

#include "runtime/stages/pose/refine.h"
#include "runtime/stages/pose/residual.h"
#include "runtime/stages/pose/symmetric.h"

namespace sphc {
namespace {

constexpr uint32_t kLeverageGrain = 64;  // correspondences between two looks at the clock
constexpr double kVague = 1e-3;          // information about a motion that nothing pins down

using Matrix36 = Eigen::Matrix<double, 3, 6>;

// Of the whitened distance to the ray, by a motion exp(xi) of the pose.
Matrix36 jacobianOf(const LiftedPoint &lifted, const Residual &r) {
  const Matrix3 across = acrossRay(lifted, r);
  Matrix36 jacobian;
  jacobian << across * crossMatrix(r.foot_m), -across;
  return jacobian;
}

// Of a correspondence at the pose: the square root of what it adds to the information; false where it says nothing.
bool rowOf(const Correspondence &given, const Estimate &estimate, Matrix36 *row) {
  Correspondence c = given;
  if (!c.lifted.hasDepth()) return false;
  c.lifted.along_m *= estimate.depth.noise_scale;
  const Residual r = residualOf(c, estimate.camera_from_map);
  if (!r.in_front) return false;
  *row = sqrtOf(finalInformation(r.squared)) * jacobianOf(c.lifted, r);
  return true;
}

Matrix6 covarianceOf(Span<const Correspondence> correspondences, const Estimate &estimate) {
  Matrix6 information = kVague * Matrix6::Identity();
  Matrix36 row;
  for (const Correspondence &c : correspondences)
    if (rowOf(c, estimate, &row)) information += row.transpose() * row;
  return symmetricInverse(information);
}

double centreVariance(const Matrix6 &covariance) { return covariance.bottomRightCorner<3, 3>().trace(); }

}  // namespace

Leverage highestLeverage(Span<const Correspondence> correspondences, const Estimate &estimate, uint32_t count,
                         const Deadline &deadline) {
  Leverage leverage;
  Watch watch(deadline, kLeverageGrain);
  const Matrix6 all = covarianceOf(correspondences, estimate);
  Matrix6 covariance = all;
  while (leverage.indices.size() < count) {
    uint32_t highest = 0;
    Matrix36 row;
    Matrix6 most = Matrix6::Zero();
    for (uint32_t i = 0; i < correspondences.size(); ++i) {
      if (watch.passed(1)) {
        leverage.is_known = false;
        return leverage;
      }
      const bool taken = std::find(leverage.indices.begin(), leverage.indices.end(), i) != leverage.indices.end();
      if (taken || !rowOf(correspondences[i], estimate, &row)) continue;
      const Eigen::Matrix<double, 6, 3> gain = covariance * row.transpose();
      const Matrix3 rest = Matrix3::Identity() - row * gain;
      const Matrix6 growth = gain * rest.inverse() * gain.transpose();  // of the covariance without it
      if (centreVariance(growth) > centreVariance(most)) highest = i, most = growth;
    }
    if (!(centreVariance(most) > 0)) break;
    covariance += most;
    leverage.indices.push(highest);
  }
  leverage.centre_sigma_ratio = sqrtOf(centreVariance(covariance) / centreVariance(all));
  return leverage;
}

}  // namespace sphc
