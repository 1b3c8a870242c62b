#include "host/calibration/nearest_camera.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "host/cameras/camera_models.h"

namespace sphc::host {
namespace {

constexpr int kSampledColumns = 33, kSampledRows = 25;
constexpr int kMostSteps = 200;
constexpr double kRelativeStep = 1e-6;

// Differences in pixels, x and y of each sample; a ray that the camera does not see counts as a whole image away.
Eigen::VectorXd residuals(const std::vector<RaySample> &samples, const sphc_camera &camera_c) {
  const Camera camera(camera_c);
  Eigen::VectorXd result(2 * samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    Vector2 pixel;
    const bool seen = camera.project({samples[i].ray.x(), samples[i].ray.y(), 1}, &pixel);
    result.segment<2>(2 * i) =
        seen ? Vector2(pixel - samples[i].pixel_px) : Vector2(camera_c.width, camera_c.height);
  }
  return result;
}

Eigen::MatrixXd jacobian(const std::vector<RaySample> &samples, const sphc_camera &camera, uint32_t free_params,
                         const Eigen::VectorXd &at) {
  Eigen::MatrixXd result(at.size(), free_params);
  for (uint32_t i = 0; i < free_params; ++i) {
    sphc_camera moved = camera;
    const double step = kRelativeStep * std::max(1.0, std::fabs(camera.params[i]));
    moved.params[i] += step;
    result.col(i) = (residuals(samples, moved) - at) / step;
  }
  return result;
}

sphc_camera firstGuess(WantedModel wanted, const sphc_camera &start) {
  sphc_camera camera = {wanted.model, start.width, start.height, findModel(wanted.model)->param_count, {}};
  const bool related =
      (start.model == SPHC_CAMERA_KANNALA_BRANDT4) == (wanted.model == SPHC_CAMERA_KANNALA_BRANDT4);
  std::copy_n(start.params, related ? std::min(wanted.free_params, start.param_count) : 4, camera.params);
  return camera;
}

}  // namespace

std::vector<RaySample> sampleCamera(const sphc_camera &camera_c) {
  const Camera camera(camera_c);
  std::vector<RaySample> samples;
  for (int row = 0; row < kSampledRows; ++row) {
    for (int column = 0; column < kSampledColumns; ++column) {
      RaySample sample;
      sample.pixel_px = {0.5 + column * (camera_c.width - 1.0) / (kSampledColumns - 1),
                         0.5 + row * (camera_c.height - 1.0) / (kSampledRows - 1)};
      if (camera.unproject(sample.pixel_px, &sample.ray)) samples.push_back(sample);
    }
  }
  return samples;
}

double shareWithoutRay(const sphc_camera &camera) {
  return 1 - static_cast<double>(sampleCamera(camera).size()) / (kSampledColumns * kSampledRows);
}

std::string doubtOfField(const sphc_camera &camera) {
  const double percent = 100 * shareWithoutRay(camera);
  if (percent < 1) return {};
  return "no ray at " + std::to_string(std::lround(percent)) +
         " % of the pixels, where the distortion turns back or they look 89 degrees off the axis and more: nothing "
         "is seen there; check focal lengths and distortion, or calibrate with points up to the corners";
}

// Levenberg and Marquardt's damped least squares.
NearestCamera nearestCamera(const std::vector<RaySample> &samples, WantedModel wanted, const sphc_camera &start) {
  sphc_camera camera = firstGuess(wanted, start);
  Eigen::VectorXd error = residuals(samples, camera);
  double damping = 1e-3;
  for (int step = 0; step < kMostSteps && damping < 1e12; ++step) {
    const Eigen::MatrixXd j = jacobian(samples, camera, wanted.free_params, error);
    Eigen::MatrixXd normal = j.transpose() * j;
    normal.diagonal() *= 1 + damping;
    const Eigen::VectorXd change = normal.ldlt().solve(j.transpose() * error);
    sphc_camera moved = camera;
    for (uint32_t i = 0; i < wanted.free_params; ++i) moved.params[i] -= change[i];
    const bool usable = change.allFinite() && checkCamera(moved, "camera", nullptr);
    const Eigen::VectorXd moved_error = usable ? residuals(samples, moved) : error;
    const bool better = moved_error.squaredNorm() < error.squaredNorm();
    damping *= better ? 0.1 : 10;
    if (!better) continue;
    const bool settled = moved_error.squaredNorm() > (1 - 1e-10) * error.squaredNorm();
    camera = moved;
    error = moved_error;
    if (settled) break;
  }
  NearestCamera result = {camera, 0, std::sqrt(error.squaredNorm() / static_cast<double>(samples.size()))};
  for (size_t i = 0; i < samples.size(); ++i)
    result.largest_px = std::max(result.largest_px, error.segment<2>(2 * i).norm());
  return result;
}

}  // namespace sphc::host
