#include "host/mapping/walk_mapper.h"

#include <algorithm>
#include <stdexcept>

#include "host/mapping/pair_linker.h"
#include "host/mapping/pose_graph.h"

namespace sphc::host {
namespace {

constexpr LinkDemands kNeighbours = {20, 0.25}, kLoops = {30, 0.25}, kExpected = {15, 0.25};
constexpr int kFirstSteps = 10, kLastSteps = 15;  // of an adjustment, at most
// What is believed of a depth sensor, as the localizer's default has it.
constexpr double kOffsetSigmaM = 0.003, kSlopeSigma = 0.02;

class WalkMapper {
 public:
  WalkMapper(const Walk &walk, const MappingOptions &options, const MappingProgress &progress)
      : frames_(walk.keyframes),
        options_(options),
        progress_(progress),
        linker_(mostKeypoints(walk.keyframes), options.threads),
        beliefs_(walk.keyframes, options.trust) {
    prior_.mid_m = walk.middle_depth_m;
    prior_.covariance.diagonal() << kOffsetSigmaM * kOffsetSigmaM, kSlopeSigma * kSlopeSigma;
  }

  MappedWalk run() {
    if (frames_.size() < 2)
      throw std::runtime_error(
          "the walk has one frame, or shows one view alone; record while you walk and turn, and give more frames");
    addLinks("linking", pairsInTime(frames_), kNeighbours, nullptr);
    addLinks("looking for loops", pairsByLook(frames_), kLoops, nullptr);
    if (options_.trust.use == PoseUse::kApproximate)
      addLinks("looking where poses tell", pairsByOverlap(frames_, beliefs_.told(), tried_), kLoops, nullptr);
    if (links_.empty())
      throw NothingAgrees(
          "no two frames of the walk agree on how they lie to each other: are the images sharp, does depth lie on "
          "them (spherecloud doctor), and are the frames near enough in time to show the same?");
    mapped_.contradicting = dropWeakBridges(frames_.size(), &links_);
    placePart();
    dropContradicting();
    mapped_.at_first = adjustPoints(kFirstSteps, false);
    const FramePoses expected = adjusted_.world_from_camera;
    addLinks("looking for overlaps", pairsByOverlap(frames_, expected, tried_), kExpected, &expected);
    dropContradicting();
    adjustPoints(kLastSteps, true);
    mapped_.residuals = adjustAgain(kLastSteps, true);  // without what was far off
    if (options_.judges_told) mapped_.residuals_of_told = residualsOfTold();
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
    for (size_t first = 0; first < pairs.size(); first += linker_.batch()) {
      const auto begin = pairs.begin() + static_cast<ptrdiff_t>(first);
      const std::vector<FramePair> batch(
          begin, begin + static_cast<ptrdiff_t>(std::min(linker_.batch(), pairs.size() - first)));
      tried_.insert(batch.begin(), batch.end());
      for (std::optional<FrameLink> &link : linker_.link(frames_, batch, demands, expected)) {
        if (!link) continue;
        link->is_loop = isLoop(frames_, link->frames);
        links_.push_back(std::move(*link));
      }
      if (progress_)
        progress_(what, static_cast<uint32_t>(first + batch.size()), static_cast<uint32_t>(pairs.size()));
    }
  }

  void findParts() {
    mapped_.parts = beliefs_.parts(links_);
    beliefs_.dropOutside(mapped_.parts);
  }

  // Poses for part 0, by its links and what is believed.
  void placePart() {
    beliefs_.judge(links_);
    findParts();
    adjusted_.world_from_camera = posesAlongLinks(links_, mapped_.parts, beliefs_);
    adjustToLinks(links_, beliefs_, &adjusted_.world_from_camera);
  }

  // Links that the others contradict, and frames that had nothing else.  A part that falls to pieces may leave
  // another one as the largest, which is then placed and judged in its turn.  Throws where no two frames are left.
  void dropContradicting() {
    dropContradictingOfPart();
    while (!isPartPlaced()) {
      placePart();
      dropContradictingOfPart();
    }
    if (placedCount(adjusted_.world_from_camera) < 2)
      throw NothingAgrees(
          "the links between the frames of the walk contradict each other: is the calibration (focal lengths, "
          "sizes) that of these cameras (spherecloud doctor)? If it is, walk once more, slowly, where things do "
          "not look all alike");
  }

  bool isPartPlaced() const {
    for (size_t i = 0; i < mapped_.parts.size(); ++i)
      if (mapped_.parts[i] == 0 && !adjusted_.world_from_camera[i]) return false;
    return true;
  }

  void dropContradictingOfPart() {
    const size_t before = links_.size();
    FramePoses &poses = adjusted_.world_from_camera;
    const auto contradicts = [&](const FrameLink &link) {
      return poses[link.frames.a] && !isConsistent(link, poses);
    };
    links_.erase(std::remove_if(links_.begin(), links_.end(), contradicts), links_.end());
    mapped_.contradicting += before - links_.size();
    beliefs_.dropContradicted(poses);
    findParts();
    for (size_t i = 0; i < poses.size(); ++i)
      if (mapped_.parts[i] != 0) poses[i].reset();
  }

  AdjustmentSummary adjustPoints(int steps, bool is_last) {
    adjusted_.tracks = enoughTracks(tracksOf(frames_, links_), frames_.size(), TrackBudget());
    return adjustAgain(steps, is_last);
  }

  AdjustmentSummary adjustAgain(int steps, bool is_last) {
    AdjustmentOptions options;
    options.most_steps = steps;
    options.beliefs = &beliefs_;
    options.lens_is_free = is_last && options_.lens_is_free;
    options.mount_is_free = is_last && options_.mount_is_free;
    options.change_so_far = options_.change_so_far;
    return adjust(frames_, prior_, options, &adjusted_);
  }

  std::optional<AdjustmentSummary> residualsOfTold() const {
    Adjusted told = adjusted_;
    for (size_t i = 0; i < frames_.size(); ++i)
      told.world_from_camera[i] = adjusted_.world_from_camera[i] ? frames_[i].told_world_from_camera : std::nullopt;
    AdjustmentOptions options;
    options.most_steps = kLastSteps;
    options.poses_are_held = true;
    const AdjustmentSummary summary = adjust(frames_, prior_, options, &told);
    return summary.sightings > 0 ? std::make_optional(summary) : std::nullopt;
  }

  // In the world of the first frame that has a pose, with the axes that were told where they are asked for; in the
  // told world where anchors hold it.
  Rigid worldFromAdjusted(const Rigid &first) const {
    if (mapped_.is_in_told_world) return {};
    const Rigid world_from_adjusted = first.inverse();
    if (!mapped_.has_told_axes) return world_from_adjusted;
    return Rigid{toldAxesFromMapped(beliefs_.told(), adjusted_.world_from_camera) * first.rotation,
                 Vector3::Zero()} *
           world_from_adjusted;
  }

  std::vector<bool> byToldAlone() const {
    const FramePoses &poses = adjusted_.world_from_camera;
    const std::vector<uint32_t> stretch = connectedParts(frames_.size(), links_);
    uint32_t largest = UINT32_MAX;  // labels are in order of size
    for (size_t i = 0; i < poses.size(); ++i)
      if (poses[i]) largest = std::min(largest, stretch[i]);
    std::vector<bool> is_alone(poses.size());
    for (size_t i = 0; i < poses.size(); ++i) is_alone[i] = poses[i] && stretch[i] != largest;
    return is_alone;
  }

  bool isAnyTold(const FramePoses &poses) const {
    for (size_t i = 0; i < poses.size(); ++i)
      if (poses[i] && beliefs_.told()[i]) return true;
    return false;
  }

  MappedWalk result() {
    const FramePoses &poses = adjusted_.world_from_camera;
    const auto first = std::find_if(poses.begin(), poses.end(), [](const auto &pose) { return pose.has_value(); });
    mapped_.told = beliefs_.toldCount();
    beliefs_.dropDisproved(poses);
    mapped_.told_wrong = beliefs_.contradictedBy(poses);
    mapped_.is_in_told_world = beliefs_.hasAnchors();
    mapped_.is_unbelieved = mapped_.told > 0 && !beliefs_.hasAnchors() && beliefs_.steps().empty();
    mapped_.has_told_axes = options_.trust.keeps_axes && !mapped_.is_unbelieved && isAnyTold(poses);
    const Rigid world_from_adjusted = worldFromAdjusted(**first);
    for (const auto &pose : poses)
      mapped_.world_from_camera.push_back(pose ? std::make_optional(world_from_adjusted * *pose) : std::nullopt);
    mapped_.by_told_alone = byToldAlone();
    for (const FrameLink &link : links_)
      if (poses[link.frames.a]) ++(link.is_loop ? mapped_.loops : mapped_.links);
    mapped_.depth = prior_;
    mapped_.depth.mean = adjusted_.bias;
    mapped_.change = adjusted_.change;
    return mapped_;
  }

  const std::vector<WalkFrame> &frames_;
  MappingOptions options_;
  const MappingProgress &progress_;
  PairLinker linker_;
  PoseBeliefs beliefs_;
  DepthCalibration prior_;
  std::vector<FrameLink> links_;
  std::set<FramePair> tried_;
  Adjusted adjusted_;
  MappedWalk mapped_;
};

}  // namespace

size_t mappedFrames(const Walk &walk, const FramePoses &poses) {
  const auto followers = std::count_if(walk.followers.begin(), walk.followers.end(),
                                       [&](const Follower &f) { return poses[f.keyframe].has_value(); });
  return placedCount(poses) + static_cast<size_t>(followers);
}

MappedWalk mapWalk(const Walk &walk, const MappingOptions &options, const MappingProgress &progress) {
  return WalkMapper(walk, options, progress).run();
}

}  // namespace sphc::host
