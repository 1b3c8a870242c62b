// The two kinds of matches of the baselines: a keypoint with a point, and a keypoint with a line.
#pragma once
#include "host/audit/attack/line.h"
#include "lab/baselines/robust_pose.h"

namespace sphc::host {

// Keypoints are at focal length 1: (x, y) of the viewing ray (x, y, 1).

struct PointPoseMatch {
  Vector2 keypoint;
  Vector3 point_m;
};

// Perspective-three-point; the error is the distance from the projected point.
class PointPoseProblem : public PoseProblem {
 public:
  PointPoseProblem(std::vector<PointPoseMatch> matches, double focal_px)
      : matches_(std::move(matches)), focal_px_(focal_px) {}
  uint32_t count() const override { return static_cast<uint32_t>(matches_.size()); }
  uint32_t sampleSize() const override { return 3; }
  std::vector<Rigid> solve(const std::vector<uint32_t> &sample) const override;
  double squaredError(uint32_t match, const Rigid &camera_from_map) const override;
  void addEquations(uint32_t match, const Rigid &camera_from_map, PoseEquations *equations) const override;

 private:
  std::vector<PointPoseMatch> matches_;
  double focal_px_;
};

struct LineMatch {
  Vector2 keypoint;
  Line line;
  uint32_t group = 0;  // of lines that meet; 0 when all are alike
};

// Perspective-six-lines; the error is the distance from the projected line.  Where lines meet in one of two centres
// (groups 0 and 1), a sample has three of each: with four of one centre the camera may sit in it, turned as it
// likes, and no pose is isolated.
class LinePoseProblem : public PoseProblem {
 public:
  LinePoseProblem(std::vector<LineMatch> matches, double focal_px);
  uint32_t count() const override { return static_cast<uint32_t>(matches_.size()); }
  uint32_t sampleSize() const override { return 6; }
  bool drawSample(Random *random, std::vector<uint32_t> *sample) const override;
  // Only poses with the sampled lines before the camera where their keypoints are.
  std::vector<Rigid> solve(const std::vector<uint32_t> &sample) const override;
  double squaredError(uint32_t match, const Rigid &camera_from_map) const override;
  void addEquations(uint32_t match, const Rigid &camera_from_map, PoseEquations *equations) const override;

 private:
  std::vector<LineMatch> matches_;
  std::vector<Vector3> moments_;    // of the lines
  std::vector<uint32_t> group_[2];  // matches of each centre; empty when all are alike
  double focal_px_;
};

}  // namespace sphc::host
