// What is believed of the poses that a recording tells: that they are right but for noise, or that neighbouring
// frames move against each other as they say.  Images are believed more: what their links contradict is left out.
#pragma once
#include <ceres/problem.h>

#include <vector>

#include "host/mapping/likely_pairs.h"
#include "host/mapping/pose_block.h"

namespace sphc::host {

enum class PoseUse { kNone, kOdometry, kApproximate };

struct PoseTrust {
  PoseUse use = PoseUse::kNone;
  // Approximate: of each pose, 1 sigma along each axis.
  double sigma_m = 0.05, sigma_rad = 0.0175;
  // Odometry: 1 sigma after a metre of the way.  Errors of steps are independent, so it grows with the root of the
  // way (Thrun, Burgard, Fox, "Probabilistic Robotics", 2005, section 5.4).
  double drift_m = 0.01, drift_rad = 0.0175;
  // Odometry: the axes of the recording's world are those of the map, so what is vertical there is so in the map.
  bool keeps_axes = false;
};

class PoseBeliefs {
 public:
  // Borrows the frames; reads WalkFrame::told_world_from_camera of them.
  PoseBeliefs(const std::vector<WalkFrame> &frames, const PoseTrust &trust);

  // All that was told, whether it is believed or not; empty of use kNone.
  const FramePoses &told() const { return told_; }
  // Odometry: links of neighbouring frames of a piece (told_pieces.h), without matches.
  const std::vector<FrameLink> &steps() const { return steps_; }
  // Approximate: the poses that are believed.  Where there is one, the world of the map is the recording's.
  const FramePoses &anchors() const { return anchors_; }
  bool hasAnchors() const;

  // Judges by the links of images.  Approximate: frames that agree with each other along links form groups, and of
  // what images connect, the largest group is believed where it has 5 frames, or all, and a quarter of those that
  // were told. Odometry: steps that links contradict are left out, and all are where half of those that can be
  // compared are.
  void judge(const std::vector<FrameLink> &links);
  // Leaves out steps that the poses contradict by more than a loop may be off.
  void dropContradicted(const FramePoses &world_from_camera);

  // Approximate: believes no pose where the mapped poses disprove most of them.  Steps of odometry stay.
  void dropDisproved(const FramePoses &world_from_camera);

  // Approximate: leaves out the poses of frames that are not in part 0.  They hold nothing of what is mapped.
  void dropOutside(const std::vector<uint32_t> &parts);

  // As connectedParts(), where steps and anchors connect too; an anchor needs a link to do so.
  std::vector<uint32_t> parts(const std::vector<FrameLink> &links) const;
  // Residuals of those that have poses.  The problem does not own the loss.
  void addTo(ceres::Problem *problem, ceres::LossFunction *loss, const FramePoses &world_from_camera,
             std::vector<PoseBlock> *camera_from_world) const;

  // How many poses (odometry: steps) were told, and how many of them are off by more than 4 sigma in the end.
  size_t toldCount() const;
  size_t contradictedBy(const FramePoses &world_from_camera) const;

 private:
  void judgeSteps(const std::vector<FrameLink> &links);
  void judgeAnchors(const std::vector<FrameLink> &links);
  bool agrees(const FrameLink &link) const;

  PoseTrust trust_;
  FramePoses told_, anchors_;
  std::vector<FrameLink> steps_, told_steps_;  // believed; all
};

// The rotation that takes the axes of the mapped poses to those of the told ones: the mean over the frames that
// have both (Moakher 2002); identity where none has.
Matrix3 toldAxesFromMapped(const FramePoses &told, const FramePoses &mapped);

}  // namespace sphc::host
