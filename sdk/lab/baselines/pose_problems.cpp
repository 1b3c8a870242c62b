#include "lab/baselines/pose_problems.h"

#include <algorithm>
#include <limits>

#include "lab/baselines/p6l.h"
#include "runtime/stages/pose/p3p.h"

namespace sphc::host {
namespace {

using Gradient = Eigen::Matrix<double, 6, 1>;

// Depth along the ray at which it comes nearest to the line, both in the camera frame.
double depthWhereRayMeets(const Vector3 &ray, const Vector3 &point_m, const Vector3 &direction) {
  const Vector3 normal = direction.cross(ray.cross(direction));  // in the plane of both, across the line
  return point_m.dot(normal) / ray.dot(normal);
}

}  // namespace

std::vector<Rigid> PointPoseProblem::solve(const std::vector<uint32_t> &sample) const {
  Vector3 bearing[3], point_m[3];
  for (size_t i = 0; i < 3; ++i) {
    bearing[i] = matches_[sample[i]].keypoint.homogeneous().normalized();
    point_m[i] = matches_[sample[i]].point_m;
  }
  std::vector<Rigid> poses;
  for (const Rigid &pose : solveP3p(bearing, point_m)) poses.push_back(pose);
  return poses;
}

double PointPoseProblem::squaredError(uint32_t match, const Rigid &pose) const {
  const Vector3 p = pose * matches_[match].point_m;
  if (!(p.z() > 0)) return std::numeric_limits<double>::infinity();
  return focal_px_ * focal_px_ * (p.hnormalized() - matches_[match].keypoint).squaredNorm();
}

void PointPoseProblem::addEquations(uint32_t match, const Rigid &pose, PoseEquations *equations) const {
  const Vector3 turned = pose.rotation * matches_[match].point_m, p = turned + pose.translation_m;
  const Vector2 residual = focal_px_ * (p.hnormalized() - matches_[match].keypoint);
  for (int k = 0; k < 2; ++k) {
    Vector3 by_point = Vector3::Zero();
    by_point[k] = focal_px_ / p.z();
    by_point.z() = -focal_px_ * p[k] / (p.z() * p.z());
    Gradient gradient;
    gradient << turned.cross(by_point), by_point;
    equations->add(residual[k], gradient);
  }
}

LinePoseProblem::LinePoseProblem(std::vector<LineMatch> matches, double focal_px)
    : matches_(std::move(matches)), focal_px_(focal_px) {
  const bool grouped =
      std::any_of(matches_.begin(), matches_.end(), [](const LineMatch &m) { return m.group > 0; });
  for (uint32_t i = 0; i < count(); ++i) {
    moments_.push_back(matches_[i].line.moment());
    if (grouped) group_[matches_[i].group > 0].push_back(i);
  }
}

bool LinePoseProblem::drawSample(Random *random, std::vector<uint32_t> *sample) const {
  if (group_[1].empty()) return PoseProblem::drawSample(random, sample);
  sample->clear();
  for (const std::vector<uint32_t> &group : group_) {
    const size_t enough = sample->size() + sampleSize() / 2;
    if (group.size() < sampleSize() / 2) return false;
    while (sample->size() < enough) {
      const uint32_t match = group[random->below(static_cast<uint32_t>(group.size()))];
      if (std::find(sample->begin(), sample->end(), match) == sample->end()) sample->push_back(match);
    }
  }
  return true;
}

std::vector<Rigid> LinePoseProblem::solve(const std::vector<uint32_t> &sample) const {
  Vector3 bearing[kP6lLines];
  Line line[kP6lLines];
  for (size_t i = 0; i < kP6lLines; ++i) {
    bearing[i] = matches_[sample[i]].keypoint.homogeneous();
    line[i] = matches_[sample[i]].line;
  }
  std::vector<Rigid> poses;
  for (const Rigid &pose : solveP6l(bearing, line)) {
    bool in_front = true;
    for (int i = 0; i < kP6lLines; ++i)
      in_front &= depthWhereRayMeets(bearing[i], pose * line[i].point_m, pose.rotation * line[i].direction) > 0;
    if (in_front) poses.push_back(pose);
  }
  return poses;
}

// The line's moment in the camera frame is the line's image: x with ray(x) . moment = 0.
double LinePoseProblem::squaredError(uint32_t match, const Rigid &pose) const {
  const Vector3 image =
      pose.rotation * moments_[match] + pose.translation_m.cross(pose.rotation * matches_[match].line.direction);
  const double off = focal_px_ * matches_[match].keypoint.homogeneous().dot(image);
  return off * off / image.head<2>().squaredNorm();
}

void LinePoseProblem::addEquations(uint32_t match, const Rigid &pose, PoseEquations *equations) const {
  const Vector3 ray = matches_[match].keypoint.homogeneous(), &t = pose.translation_m;
  const Vector3 moment = pose.rotation * moments_[match],
                direction = pose.rotation * matches_[match].line.direction;
  const Vector3 image = moment + t.cross(direction);
  const double length = image.head<2>().norm(), off = ray.dot(image) / length;
  // Of the distance by the image line: a . d(image).
  const Vector3 across(image.x() / length, image.y() / length, 0);
  const Vector3 a = focal_px_ / length * (ray - off * across);
  Gradient gradient;
  gradient << moment.cross(a) + direction.cross(a.cross(t)), direction.cross(a);
  equations->add(focal_px_ * off, gradient);
}

}  // namespace sphc::host
