#include "host/import/moving_things.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/import/upright.h"

namespace sphc::host {
namespace {

// A view agrees with a point within a margin: for errors of poses and of depth, and for what pixels blur.
constexpr double kMarginM = 0.05, kMarginPerM = 0.05;
constexpr double kMarginOfDisagreement = 8;  // or so many times what views disagree by anyway, where that is more
constexpr double kMostDisagreement = 0.04;
constexpr double kComparable = 0.25;  // farther off it is another surface; a share of depth
constexpr size_t kSampled = 5000;     // points that tell how much views disagree
// Static points at depth edges are contradicted at times, so one contradiction counts against two confirmations.
constexpr uint32_t kConfirmationsPerContradiction = 2;
constexpr double kMostDropped = 1.0 / 3;  // more is no movement
// Fewer are no movement either: of rooms where nothing moved 0 to 0.5 % are points at depth edges that would go.
constexpr double kLeastDropped = 0.01;

// Where the hands and the body of the holder are: an arm's length around the camera, and below it.
constexpr double kArmM = 0.8, kBodyRadiusM = 0.6, kNeckM = 0.4;
constexpr double kElsewhereM = 0.25;  // hands and feet go along with a camera that went so far

bool didSee(const Vector3 &camera_m, const TrackedPoint &tracked) {
  return std::find(tracked.cameras_m.begin(), tracked.cameras_m.end(), camera_m) != tracked.cameras_m.end();
}

// Of points with the views that did not make them.
double medianDisagreement(const DepthViews &views, const std::vector<TrackedPoint> &points) {
  std::array<uint64_t, 250> histogram = {};
  uint64_t total = 0;
  const size_t step = points.size() / kSampled + 1;
  for (size_t i = 0; i < points.size(); i += step)
    for (size_t k = 0; k < views.count(); ++k) {
      Sight sight;
      if (didSee(views.camera_m(k), points[i]) || !views.look(k, points[i].point.position_m, &sight)) continue;
      const double off = sight.off_m / sight.depth_m;
      if (!(off < kComparable)) continue;
      ++histogram[static_cast<size_t>(off / kComparable * static_cast<double>(histogram.size()))];
      ++total;
    }
  uint64_t below = 0;
  size_t bin = 0;
  while (bin < histogram.size() && 2 * (below + histogram[bin]) < total) below += histogram[bin++];
  return total ? kComparable * (static_cast<double>(bin) + 0.5) / static_cast<double>(histogram.size()) : 0;
}

enum class Verdict : uint8_t { kStays, kSeenThrough, kWithinReach };

class Judge {
 public:
  Judge(const DepthViews &views, double disagreement)
      : views_(views),
        down_(downByCameras(views.cameraFromWorld())),
        margin_per_m_(std::max(kMarginPerM, kMarginOfDisagreement * disagreement)) {}

  Verdict judge(const TrackedPoint &tracked) const {
    const Vector3 *holder_m = holderNear(tracked);
    uint32_t confirmed = 0, confirmed_elsewhere = 0, contradicted = 0;
    for (size_t k = 0; k < views_.count(); ++k) {
      Sight sight;
      if (!views_.look(k, tracked.point.position_m, &sight)) continue;
      const double margin_m = kMarginM + margin_per_m_ * sight.depth_m;
      if (sight.beyond_m > margin_m) ++contradicted;
      if (sight.off_m > margin_m) continue;
      ++confirmed;
      if (holder_m && (views_.camera_m(k) - *holder_m).norm() > kElsewhereM) ++confirmed_elsewhere;
    }
    if (kConfirmationsPerContradiction * contradicted > confirmed) return Verdict::kSeenThrough;
    return holder_m && confirmed_elsewhere == 0 ? Verdict::kWithinReach : Verdict::kStays;
  }

 private:
  // A camera that saw the point and whose holder it may be part of; null where there is none.
  const Vector3 *holderNear(const TrackedPoint &tracked) const {
    for (const Vector3 &camera_m : tracked.cameras_m) {
      const Vector3 offset = tracked.point.position_m - camera_m;
      const double below = offset.dot(down_);
      if (offset.norm() < kArmM || (below > kNeckM && (offset - below * down_).norm() < kBodyRadiusM))
        return &camera_m;
    }
    return nullptr;
  }

  const DepthViews &views_;
  Vector3 down_;
  double margin_per_m_;
};

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

// Of what was seen, not of the points: each view of somebody who walks gives points of its own, and views of a wall
// share theirs.
double shareSeen(const std::vector<TrackedPoint> &points, const std::vector<Verdict> &verdicts, Verdict verdict) {
  double seen = 0, total = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    total += points[i].point.observations;
    if (verdicts[i] == verdict) seen += points[i].point.observations;
  }
  return seen / total;
}

// Takes the verdict back where it meets too much of what was seen; else says how many points it meets.
uint32_t settle(const std::vector<TrackedPoint> &points, Verdict verdict, const char *why,
                std::vector<Verdict> *verdicts, MovingSummary *summary) {
  const double share = shareSeen(points, *verdicts, verdict);
  if (share <= kMostDropped) return static_cast<uint32_t>(std::count(verdicts->begin(), verdicts->end(), verdict));
  std::replace(verdicts->begin(), verdicts->end(), verdict, Verdict::kStays);
  summary->doubts.push_back(percent(share) + why);
  return 0;
}

constexpr char kNoMovement[] =
    " of what was seen is seen through by other frames: that is no movement, parts of the recording lie elsewhere "
    "than "
    "their poses say; points on what moves were kept; map the parts one by one, or correct the poses";
constexpr char kAllIsNear[] =
    " of what was seen is within reach of whoever held the camera, and no frame from elsewhere confirms it; all of "
    "it was "
    "kept, hands and feet as well; record each thing from several sides";

}  // namespace

MovingSummary dropMoving(const DepthViews &views, std::vector<TrackedPoint> *points) {
  MovingSummary summary;
  if (views.count() < 2 || points->empty()) return summary;
  summary.disagreement = medianDisagreement(views, *points);
  if (summary.disagreement > kMostDisagreement) {
    summary.doubts.push_back(
        "the frames disagree on where things are, by " + percent(summary.disagreement) +
        " of the depth, so what moved cannot be told from what stood still, and all of it was kept; "
        "correct the poses, or the calibration's depth_unit_m and color_from_depth");
    return summary;
  }
  const Judge judge(views, summary.disagreement);
  std::vector<Verdict> verdicts;
  for (const TrackedPoint &point : *points) verdicts.push_back(judge.judge(point));
  summary.seen_through = settle(*points, Verdict::kSeenThrough, kNoMovement, &verdicts, &summary);
  summary.within_reach = settle(*points, Verdict::kWithinReach, kAllIsNear, &verdicts, &summary);
  if (summary.seen_through + summary.within_reach < kLeastDropped * static_cast<double>(points->size())) {
    summary.seen_through = summary.within_reach = 0;
    return summary;
  }
  size_t kept = 0;
  for (size_t i = 0; i < points->size(); ++i)
    if (verdicts[i] == Verdict::kStays) std::swap((*points)[kept++], (*points)[i]);
  points->resize(kept);
  return summary;
}

}  // namespace sphc::host
