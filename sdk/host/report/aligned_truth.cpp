#include "host/report/aligned_truth.h"

#include <algorithm>
#include <map>

#include "host/report/statistics.h"
#include "host/report/trajectory_score.h"

namespace sphc::host {
namespace {

constexpr int kRounds = 10;
constexpr double kFarOverMedian = 4, kNeverFarM = 0.01;

// The camera's place and what lies 1 m along its axes: places alone tell little of the rotation where they are near
// each other.
using Corners = Eigen::Matrix<double, 3, 4>;
Corners cornersOf(const Rigid &pose) {
  Corners corners;
  corners << pose.rotation, Vector3::Zero();
  return corners.colwise() + pose.translation_m;
}

Rigid truthFromEstimate(const std::vector<PosePair> &poses) {
  const auto count = static_cast<Eigen::Index>(poses.size());
  Eigen::Matrix3Xd estimated(3, 4 * count), truth(3, 4 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    estimated.middleCols<4>(4 * i) = cornersOf(poses[static_cast<size_t>(i)].estimated);
    truth.middleCols<4>(4 * i) = cornersOf(poses[static_cast<size_t>(i)].truth);
  }
  const Eigen::Matrix4d rigid = Eigen::umeyama(estimated, truth, false);  // Umeyama 1991
  return {rigid.topLeftCorner<3, 3>(), rigid.col(3).head<3>()};
}

double offM(const PosePair &pose, const Rigid &true_from_estimated) {
  return (true_from_estimated * pose.estimated.translation_m - pose.truth.translation_m).norm();
}

// Those that are not far off: wrong poses must not pull the worlds apart.
std::vector<PosePair> near(const std::vector<PosePair> &poses, const Rigid &true_from_estimated) {
  std::vector<double> off_m;
  for (const PosePair &pose : poses) off_m.push_back(offM(pose, true_from_estimated));
  const double limit_m = std::max(kNeverFarM, kFarOverMedian * percentile(off_m, 0.5));
  std::vector<PosePair> kept;
  for (size_t i = 0; i < poses.size(); ++i)
    if (off_m[i] <= limit_m) kept.push_back(poses[i]);
  return kept;
}

struct Alignment {
  Rigid estimated_from_true;
  size_t poses = 0;  // that it rests on
};

Alignment alignmentOf(const std::vector<PosePair> &all) {
  std::vector<PosePair> used = all;
  Rigid true_from_estimated = truthFromEstimate(used);
  for (int round = 0; round < kRounds; ++round) {
    used = near(all, true_from_estimated);
    true_from_estimated = truthFromEstimate(used);
  }
  return {true_from_estimated.inverse(), used.size()};
}

using PosesOfMaps = std::map<uint32_t, std::vector<PosePair>>;

PosesOfMaps posesWithTruth(const Run &run) {
  PosesOfMaps poses;
  for (const FrameRecord &frame : run.frames)
    if (frame.localized && frame.has_truth)
      poses[frame.map].push_back({rigidFromC(frame.base_from_camera), rigidFromC(frame.truth_base_from_camera)});
  return poses;
}

// A frame without an answer goes with the last answer before it, or, before the first, with that.
void moveTruth(const std::map<uint32_t, Alignment> &alignments, Run *run) {
  auto last = alignments.end();
  for (const FrameRecord &frame : run->frames)
    if (last == alignments.end() && frame.localized) last = alignments.find(frame.map);
  for (FrameRecord &frame : run->frames) {
    const auto by = frame.localized ? alignments.find(frame.map) : last;
    if (by == alignments.end())
      frame.has_truth = false;
    else
      last = by;
    if (!frame.has_truth) continue;
    const Rigid truth = rigidFromC(frame.truth_base_from_camera);
    frame.truth_base_from_camera = rigidToC(by->second.estimated_from_true * truth);
    judge(&frame);
  }
}

}  // namespace

std::vector<uint32_t> alignTruth(Run *run) {
  std::map<uint32_t, Alignment> alignments;
  std::vector<uint32_t> unaligned;
  size_t aligned_frames = 0;
  for (const auto &[map, poses] : posesWithTruth(*run)) {
    if (poses.size() < kFewestScored) {
      unaligned.push_back(map);
      continue;
    }
    aligned_frames += (alignments[map] = alignmentOf(poses)).poses;
  }
  run->aligned_frames = static_cast<uint32_t>(aligned_frames);
  moveTruth(alignments, run);
  return unaligned;
}

}  // namespace sphc::host
