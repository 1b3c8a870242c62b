#include "host/mapping/walk_mapper.h"

#include <algorithm>
#include <stdexcept>

#include "host/mapping/pose_graph.h"

namespace sphc::host {
namespace {

constexpr LinkDemands kNeighbours = {20, 0.25}, kLoops = {30, 0.25}, kExpected = {15, 0.25};
constexpr size_t kLeastOfTrack = 3, kSightingsOfFrame = 600;
constexpr int kFirstSteps = 10, kLastSteps = 15;  // of an adjustment, at most
// What is believed of a depth sensor, as the localizer's default has it.
constexpr double kOffsetSigmaM = 0.003, kSlopeSigma = 0.02;

class WalkMapper {
 public:
  WalkMapper(const Walk &walk, const MappingProgress &progress)
      : frames_(walk.keyframes), progress_(progress), linker_(mostKeypoints(walk.keyframes)) {
    prior_.mid_m = walk.middle_depth_m;
    prior_.covariance.diagonal() << kOffsetSigmaM * kOffsetSigmaM, kSlopeSigma * kSlopeSigma;
  }

  MappedWalk run() {
    addLinks("linking", pairsInTime(frames_.size()), kNeighbours, nullptr);
    addLinks("looking for loops", pairsByLook(frames_), kLoops, nullptr);
    if (links_.empty())
      throw std::runtime_error(
          "no two frames of the walk agree on how they lie to each other: are the images sharp, does depth lie on "
          "them (spherecloud doctor), and are the frames near enough in time to show the same?");
    mapped_.contradicting = dropWeakBridges(frames_.size(), &links_);
    mapped_.parts = connectedParts(frames_.size(), links_);
    adjusted_.world_from_camera = posesAlongLinks(frames_.size(), links_, mapped_.parts);
    adjustToLinks(links_, &adjusted_.world_from_camera);
    dropContradicting();
    adjustPoints(kFirstSteps);
    const FramePoses expected = adjusted_.world_from_camera;
    addLinks("looking for overlaps", pairsByOverlap(frames_, expected, tried_), kExpected, &expected);
    dropContradicting();
    adjustPoints(kLastSteps);
    mapped_.residuals = adjustAgain(kLastSteps);  // without what was far off
    return result();
  }

 private:
  static uint32_t mostKeypoints(const std::vector<WalkFrame> &frames) {
    size_t most = 1;
    for (const WalkFrame &frame : frames) most = std::max(most, frame.points.size());
    return static_cast<uint32_t>(most);
  }

  void addLinks(const char *what, const std::vector<FramePair> &pairs, const LinkDemands &demands,
                const FramePoses *expected) {
    uint32_t done = 0;
    for (const FramePair &pair : pairs) {
      tried_.insert(pair);
      Rigid b_from_a;
      if (expected) b_from_a = (*expected)[pair.b]->inverse() * *(*expected)[pair.a];
      if (auto link = linker_.link(frames_, pair, demands, expected ? &b_from_a : nullptr))
        links_.push_back(std::move(*link));
      if (progress_) progress_(what, ++done, static_cast<uint32_t>(pairs.size()));
    }
  }

  // Links that the others contradict, and frames that had nothing else.
  void dropContradicting() {
    const size_t before = links_.size();
    FramePoses &poses = adjusted_.world_from_camera;
    const auto contradicts = [&](const FrameLink &link) {
      return poses[link.frames.a] && !isConsistent(link, poses);
    };
    links_.erase(std::remove_if(links_.begin(), links_.end(), contradicts), links_.end());
    mapped_.contradicting += before - links_.size();
    mapped_.parts = connectedParts(frames_.size(), links_);
    for (size_t i = 0; i < poses.size(); ++i)
      if (mapped_.parts[i] != 0) poses[i].reset();
  }

  void adjustPoints(int steps) {
    adjusted_.tracks = enoughTracks(tracksOf(frames_, links_, kLeastOfTrack), frames_.size(), kSightingsOfFrame);
    adjustAgain(steps);
  }

  AdjustmentSummary adjustAgain(int steps) {
    AdjustmentOptions options;
    options.most_steps = steps;
    return adjust(frames_, prior_, options, &adjusted_);
  }

  // In the world of the first frame that has a pose.
  MappedWalk result() {
    const FramePoses &poses = adjusted_.world_from_camera;
    const auto first = std::find_if(poses.begin(), poses.end(), [](const auto &pose) { return pose.has_value(); });
    if (first == poses.end())
      throw std::runtime_error(
          "the links between the frames of the walk contradict each other; walk once more, slowly, where things do "
          "not "
          "look all alike");
    for (const auto &pose : poses)
      mapped_.world_from_camera.push_back(pose ? std::make_optional((*first)->inverse() * *pose) : std::nullopt);
    for (const FrameLink &link : links_)
      if (poses[link.frames.a]) ++(link.frames.gap() > kMostGapInTime ? mapped_.loops : mapped_.links);
    mapped_.depth = prior_;
    mapped_.depth.mean = adjusted_.bias;
    return mapped_;
  }

  const std::vector<WalkFrame> &frames_;
  const MappingProgress &progress_;
  FrameLinker linker_;
  DepthCalibration prior_;
  std::vector<FrameLink> links_;
  std::set<FramePair> tried_;
  Adjusted adjusted_;
  MappedWalk mapped_;
};

}  // namespace

MappedWalk mapWalk(const Walk &walk, const MappingProgress &progress) { return WalkMapper(walk, progress).run(); }

}  // namespace sphc::host
