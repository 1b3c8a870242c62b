#include "lab/pose/peers.h"

#if SPHC_HAVE_OPENCV_CALIB3D
#include <opencv2/calib3d.hpp>

namespace sphc::host {
namespace {

constexpr int kMaxIterations = 10000;
constexpr size_t kFewestPoints = 6;
constexpr float kGatePx = 4;
constexpr double kConfidence = 0.9999;

PoseAnswer solve(const PoseCase &c) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (const Vector3 &p : c.true_points_map_m) points.emplace_back(p.x(), p.y(), p.z());
  for (const Vector2 &p : c.true_pixels_px) pixels.emplace_back(p.x(), p.y());
  const cv::Matx33d camera(c.camera.fx_px, 0, c.camera.cx_px, 0, c.camera.fy_px, c.camera.cy_px, 0, 0, 1);
  cv::Vec3d turn, shift;
  std::vector<int> inliers;
  PoseAnswer answer;
  if (points.size() < kFewestPoints) return answer;  // which OpenCV throws at
  const double begin = clockSeconds();
  answer.found = cv::solvePnPRansac(points, pixels, camera, cv::noArray(), turn, shift, false, kMaxIterations,
                                    kGatePx, kConfidence, inliers, cv::SOLVEPNP_ITERATIVE);
  answer.seconds = clockSeconds() - begin;
  answer.inliers = static_cast<uint32_t>(inliers.size());
  answer.camera_from_map = {rotationFromVector({turn[0], turn[1], turn[2]}), {shift[0], shift[1], shift[2]}};
  return answer;
}

}  // namespace

PoseVariant openCvPeer() {
  cv::setNumThreads(1);
  return {"opencv pnp", true, [](const PoseCase &c, uint64_t) { return solve(c); }, ""};
}

}  // namespace sphc::host

#else

namespace sphc::host {

PoseVariant openCvPeer() {
  return {"opencv pnp", true, nullptr,
          "built without OpenCV's calib3d: apt-get install libopencv-dev, build again"};
}

}  // namespace sphc::host
#endif
