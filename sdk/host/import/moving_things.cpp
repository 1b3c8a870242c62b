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
constexpr size_t kBins = 250;         // of the histogram of that
// Static points at depth edges are contradicted at times, so one contradiction counts against two confirmations.
constexpr uint32_t kConfirmationsPerContradiction = 2;
constexpr uint32_t kAgainAndAgain = 3;    // views of a later recording, so that one that is off is not enough
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
double medianDisagreement(const std::vector<DepthViews> &recordings, const std::vector<TrackedPoint> &points) {
  std::array<uint64_t, kBins> histogram = {};
  uint64_t total = 0;
  const auto compare = [&](const DepthViews &views, size_t k, const TrackedPoint &point) {
    Sight sight;
    if (didSee(views.camera_m(k), point) || !views.look(k, point.point.position_m, &sight)) return;
    const double off = sight.off_m / sight.depth_m;
    if (!(off < kComparable)) return;
    ++histogram[static_cast<size_t>(off / kComparable * static_cast<double>(histogram.size()))];
    ++total;
  };
  const size_t step = points.size() / kSampled + 1;
  for (size_t i = 0; i < points.size(); i += step)
    for (const DepthViews &views : recordings)
      for (size_t k = 0; k < views.count(); ++k) compare(views, k, points[i]);
  uint64_t below = 0;
  size_t bin = 0;
  while (bin < histogram.size() && 2 * (below + histogram[bin]) < total) below += histogram[bin++];
  return total ? kComparable * (static_cast<double>(bin) + 0.5) / static_cast<double>(histogram.size()) : 0;
}

enum class Verdict : uint8_t { kStays, kSeenThrough, kWithinReach, kGone };

struct Judgement {
  Verdict verdict;
  bool is_seen_later;  // do the views of a later recording say something of its place?
};

// What the views of a recording say of a point.
struct Votes {
  uint32_t confirmed = 0, confirmed_elsewhere = 0, contradicted = 0;
  bool areAgainst() const { return kConfirmationsPerContradiction * contradicted > confirmed; }
};

std::vector<Matrix3> cameraFromWorld(const std::vector<DepthViews> &recordings) {
  std::vector<Matrix3> all;
  for (const DepthViews &views : recordings)
    for (const Matrix3 &rotation : views.cameraFromWorld()) all.push_back(rotation);
  return all;
}

class Judge {
 public:
  Judge(const std::vector<DepthViews> &recordings, double disagreement)
      : recordings_(recordings),
        down_(downByCameras(cameraFromWorld(recordings))),
        margin_per_m_(std::max(kMarginPerM, kMarginOfDisagreement * disagreement)) {}

  Judgement judge(const TrackedPoint &tracked) const {
    const Vector3 *holder_m = holderNear(tracked);
    std::vector<Votes> votes;
    bool is_confirmed_elsewhere = false;
    for (const DepthViews &views : recordings_) {
      votes.push_back(votesOf(views, tracked, holder_m));
      is_confirmed_elsewhere = is_confirmed_elsewhere || votes.back().confirmed_elsewhere > 0;
    }
    const bool is_seen_later =
        std::any_of(votes.begin() + tracked.recording + 1, votes.end(),
                    [](const Votes &later) { return later.confirmed + later.contradicted >= kAgainAndAgain; });
    if (isGone(votes, tracked.recording)) return {Verdict::kGone, is_seen_later};
    // What an earlier recording saw there says nothing of a thing that is new.
    if (votes[tracked.recording].areAgainst()) return {Verdict::kSeenThrough, is_seen_later};
    return {holder_m && !is_confirmed_elsewhere ? Verdict::kWithinReach : Verdict::kStays, is_seen_later};
  }

 private:
  Votes votesOf(const DepthViews &views, const TrackedPoint &tracked, const Vector3 *holder_m) const {
    Votes votes;
    for (size_t k = 0; k < views.count(); ++k) {
      Sight sight;
      if (!views.look(k, tracked.point.position_m, &sight)) continue;
      const double margin_m = kMarginM + margin_per_m_ * sight.depth_m;
      if (sight.beyond_m > margin_m) ++votes.contradicted;
      if (sight.off_m > margin_m) continue;
      ++votes.confirmed;
      if (holder_m && (views.camera_m(k) - *holder_m).norm() > kElsewhereM) ++votes.confirmed_elsewhere;
    }
    return votes;
  }

  // The last recording whose views say something decides.
  static bool isGone(const std::vector<Votes> &votes, uint32_t last_seen) {
    for (size_t later = votes.size() - 1; later > last_seen; --later) {
      if (votes[later].areAgainst() && votes[later].contradicted >= kAgainAndAgain) return true;
      if (!votes[later].areAgainst() && votes[later].confirmed >= kAgainAndAgain) return false;
    }
    return false;
  }

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

  const std::vector<DepthViews> &recordings_;
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

// Takes the verdict back.  Returns how many points it meets then.
uint32_t keepAll(Verdict verdict, std::vector<Verdict> *verdicts) {
  std::replace(verdicts->begin(), verdicts->end(), verdict, Verdict::kStays);
  return 0;
}

// Takes the verdict back where it meets too much of what was seen; else says how many points it meets.
uint32_t settle(const std::vector<TrackedPoint> &points, Verdict verdict, const char *why,
                std::vector<Verdict> *verdicts, MovingSummary *summary) {
  const double share = shareSeen(points, *verdicts, verdict);
  if (share <= kMostDropped) return static_cast<uint32_t>(std::count(verdicts->begin(), verdicts->end(), verdict));
  summary->doubts.push_back(percent(share) + why);
  return keepAll(verdict, verdicts);
}

constexpr char kNoMovement[] =
    " of what was seen is seen through by other frames: that is no movement, parts of the recording lie elsewhere "
    "than "
    "their poses say; points on what moves were kept; map the parts one by one, or correct the poses";
constexpr char kAllIsNear[] =
    " of what was seen is within reach of whoever held the camera, and no frame from elsewhere confirms it; all of "
    "it was "
    "kept, hands and feet as well; record each thing from several sides";

constexpr char kMostIsGone[] =
    " of what was seen is seen through by later recordings: that is another arrangement of the whole place, or the "
    "recordings do not lie where their poses say; all of it was kept; map the later recordings alone";

size_t countOf(const std::vector<DepthViews> &recordings) {
  size_t count = 0;
  for (const DepthViews &views : recordings) count += views.count();
  return count;
}

}  // namespace

MovingSummary dropMoving(const std::vector<DepthViews> &views, std::vector<TrackedPoint> *points) {
  MovingSummary summary;
  if (countOf(views) < 2 || points->empty()) return summary;
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
  size_t seen_later = 0;
  for (const TrackedPoint &point : *points) {
    const Judgement judgement = judge.judge(point);
    verdicts.push_back(judgement.verdict);
    seen_later += judgement.is_seen_later;
  }
  summary.seen_through = settle(*points, Verdict::kSeenThrough, kNoMovement, &verdicts, &summary);
  summary.within_reach = settle(*points, Verdict::kWithinReach, kAllIsNear, &verdicts, &summary);
  summary.gone = settle(*points, Verdict::kGone, kMostIsGone, &verdicts, &summary);
  // A later recording may show a corner of a large place.
  if (summary.gone < kLeastDropped * static_cast<double>(seen_later))
    summary.gone = keepAll(Verdict::kGone, &verdicts);
  if (summary.seen_through + summary.within_reach < kLeastDropped * static_cast<double>(points->size())) {
    summary.seen_through = keepAll(Verdict::kSeenThrough, &verdicts);
    summary.within_reach = keepAll(Verdict::kWithinReach, &verdicts);
  }
  size_t kept = 0;
  for (size_t i = 0; i < points->size(); ++i)
    if (verdicts[i] == Verdict::kStays) std::swap((*points)[kept++], (*points)[i]);
  points->resize(kept);
  return summary;
}

}  // namespace sphc::host
