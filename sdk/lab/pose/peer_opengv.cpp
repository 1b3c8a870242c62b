#include "lab/pose/peers.h"

#if SPHC_HAVE_OPENGV
#include <cmath>
#include <memory>
#include <opengv/absolute_pose/CentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/methods.hpp>
#include <opengv/sac/Ransac.hpp>
#include <opengv/sac_problems/absolute_pose/AbsolutePoseSacProblem.hpp>

namespace sphc::host {
namespace {

using opengv::absolute_pose::CentralAbsoluteAdapter;
using Problem = opengv::sac_problems::absolute_pose::AbsolutePoseSacProblem;

constexpr int kMostRansacSteps = 10000;
constexpr double kProbability = 0.99;
constexpr double kTruePointGatePx = 4;
constexpr double kLiftedGateDeg = 1;  // of a lifted keypoint, seen from the sphere centre

// What OpenGV measures errors in: 1 - cos of the angle between bearings.
double gateOf(double angle_rad) { return 1 - std::cos(angle_rad); }

// Bearings are of the frame that the answer maps points from.
PoseAnswer solve(const opengv::bearingVectors_t &bearings, const opengv::points_t &points, double gate) {
  PoseAnswer answer;
  if (points.size() < 4) return answer;
  const double begin = clockSeconds();
  CentralAbsoluteAdapter adapter(bearings, points);
  opengv::sac::Ransac<Problem> ransac;
  ransac.sac_model_ = std::make_shared<Problem>(adapter, Problem::KNEIP, false);
  ransac.threshold_ = gate;
  ransac.max_iterations_ = kMostRansacSteps;
  ransac.probability_ = kProbability;
  answer.found = ransac.computeModel();
  if (answer.found) {
    opengv::transformation_t refined;
    ransac.sac_model_->optimizeModelCoefficients(ransac.inliers_, ransac.model_coefficients_, refined);
    answer.camera_from_map = {refined.leftCols<3>(), refined.col(3)};
  }
  answer.seconds = clockSeconds() - begin;
  answer.iterations = static_cast<uint32_t>(ransac.iterations_);
  answer.inliers = static_cast<uint32_t>(ransac.inliers_.size());
  return answer;
}

PoseAnswer onTruePoints(const PoseCase &c) {
  opengv::bearingVectors_t bearings;
  for (const Vector2 &pixel : c.true_pixels_px)
    bearings.push_back(
        Vector3((pixel.x() - c.camera.cx_px) / c.camera.fx_px, (pixel.y() - c.camera.cy_px) / c.camera.fy_px, 1)
            .normalized());
  const opengv::points_t points(c.true_points_map_m.begin(), c.true_points_map_m.end());
  PoseAnswer answer = solve(bearings, points, gateOf(kTruePointGatePx / c.focalPx()));
  answer.camera_from_map = answer.camera_from_map.inverse();  // map_from_camera came out
  return answer;
}

// The sphere is the camera: its bearings are the map's directions, its points the lifted keypoints.
PoseAnswer onDirections(const PoseCase &c) {
  opengv::bearingVectors_t bearings;
  opengv::points_t points;
  for (const Correspondence &row : c.correspondences) {
    bearings.push_back(row.direction);
    points.push_back(row.lifted.point_m);
  }
  return solve(bearings, points, gateOf(kLiftedGateDeg * kPi / 180));
}

}  // namespace

std::vector<PoseVariant> openGvPeers() {
  return {{"opengv p3p", true, [](const PoseCase &c, uint64_t) { return onTruePoints(c); }, ""},
          {"opengv directions", false, [](const PoseCase &c, uint64_t) { return onDirections(c); }, ""}};
}

}  // namespace sphc::host

#else

namespace sphc::host {

std::vector<PoseVariant> openGvPeers() {
  const char cure[] = "built without OpenGV: toolchains/install_packages.sh bench, build again";
  return {{"opengv p3p", true, nullptr, cure}, {"opengv directions", false, nullptr, cure}};
}

}  // namespace sphc::host
#endif
