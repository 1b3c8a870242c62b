#include "host/import/point_tracks.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "host/import/descriptors.h"
#include "host/import/near_duplicates.h"

namespace sphc::host {
namespace {

constexpr int kCellPx = 16;
constexpr double kScaleRatio = 1.8;  // keypoints of one point differ in metric size at most by this factor
// An observation may be off in depth by so many sigmas, or by such a share of its depth: poses are not exact
// either.
constexpr double kDepthSigmas = 4, kDepthShare = 0.03;
constexpr size_t kNewestCompared = 6;  // of a track that are compared: the newest look most like the next
constexpr double kAgreement2 = 16;     // squared Mahalanobis distance of an observation that supports the mean
constexpr double kLoneNoise = 2;       // a point seen once may scatter at most so many times the sensor's noise
constexpr double kInfinite = std::numeric_limits<double>::infinity();

int cellsAcross(int pixels) { return pixels / kCellPx + 1; }

struct Fused {
  size_t count = 0;
  const Observation *last = nullptr;
};

// Weighted mean of the observations that lie within reach of `around`.  Returns which took part.
Fused fuse(const std::vector<Observation> &observations, const Vector3 &around, double reach2, Vector3 *mean,
           Matrix3 *information) {
  Vector3 sum = Vector3::Zero();
  Matrix3 total = Matrix3::Zero();
  Fused used;
  for (const Observation &o : observations) {
    const Vector3 off = o.position_m - around;
    if (off.dot(o.information * off) > reach2) continue;
    total += o.information;
    sum += o.information * o.position_m;
    ++used.count;
    used.last = &o;
  }
  if (used.count > 0) {
    *mean = total.inverse() * sum;
    *information = total;
  }
  return used;
}

// May an observation be a point by itself?  Not at a depth edge, where its patch scatters.
bool isTrustworthy(const Observation &lone) {
  return lone.sigma_m < kLoneNoise * kMappingNoise.sigmaAt(lone.depth_m);
}

const Descriptor &representative(const std::vector<Observation> &observations) {
  std::vector<const Descriptor *> seen;
  for (const Observation &o : observations) seen.push_back(&o.descriptor);
  return *seen[medoidOf(seen)];
}

}  // namespace

std::vector<std::vector<PointTracks::Candidate>> PointTracks::project(const Camera &camera,
                                                                      const Rigid &camera_from_world) const {
  const int across = cellsAcross(camera.width()), down = cellsAcross(camera.height());
  std::vector<std::vector<Candidate>> grid(static_cast<size_t>(across * down));
  for (size_t i = 0; i < tracks_.size(); ++i) {
    const Vector3 point = camera_from_world * tracks_[i].position_m;
    Vector2 pixel;
    if (point.z() < 0.1 || !camera.project(point, &pixel)) continue;
    if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() >= camera.width() || pixel.y() >= camera.height()) continue;
    const int cell = static_cast<int>(pixel.y()) / kCellPx * across + static_cast<int>(pixel.x()) / kCellPx;
    grid[static_cast<size_t>(cell)].push_back({i, pixel, point.z()});
  }
  return grid;
}

// Descriptor distance of an observation to a candidate, infinite where place, depth or size speak against it.
double PointTracks::compare(const Observation &observation, const Candidate &candidate) const {
  const double reach = options_.merge_pixels;
  if ((candidate.pixel_px - observation.pixel_px).squaredNorm() > reach * reach) return kInfinite;
  const double depth_reach = std::max(kDepthSigmas * observation.sigma_m, kDepthShare * observation.depth_m);
  if (std::abs(candidate.depth_m - observation.depth_m) > depth_reach) return kInfinite;
  const Track &track = tracks_[candidate.track];
  const double ratio = observation.metric_scale_m / track.metric_scale_m;
  if (ratio > kScaleRatio || ratio < 1 / kScaleRatio) return kInfinite;
  double nearest = kInfinite;
  const size_t looked_at = std::min(track.observations.size(), kNewestCompared);
  for (size_t k = 0; k < looked_at; ++k)
    nearest = std::min(nearest, descriptorDistance(track.observations[track.observations.size() - 1 - k].descriptor,
                                                   observation.descriptor));
  return nearest < options_.max_descriptor_distance ? nearest : kInfinite;
}

size_t PointTracks::add(const Camera &camera, const Rigid &camera_from_world,
                        const std::vector<Observation> &observations) {
  const auto grid = project(camera, camera_from_world);
  const int across = cellsAcross(camera.width()), down = cellsAcross(camera.height());
  struct Proposal {
    double distance;
    size_t observation, track;
  };
  std::vector<Proposal> proposals;
  for (size_t i = 0; i < observations.size(); ++i) {
    const int cx = static_cast<int>(observations[i].pixel_px.x()) / kCellPx;
    const int cy = static_cast<int>(observations[i].pixel_px.y()) / kCellPx;
    for (int y = std::max(cy - 1, 0); y <= std::min(cy + 1, down - 1); ++y)
      for (int x = std::max(cx - 1, 0); x <= std::min(cx + 1, across - 1); ++x)
        for (const Candidate &candidate : grid[static_cast<size_t>(y * across + x)]) {
          const double distance = compare(observations[i], candidate);
          if (distance < kInfinite) proposals.push_back({distance, i, candidate.track});
        }
  }
  std::sort(proposals.begin(), proposals.end(), [](const Proposal &a, const Proposal &b) {
    return std::tie(a.distance, a.observation, a.track) < std::tie(b.distance, b.observation, b.track);
  });
  // Nearest first; an observation joins one track, a track takes one observation of a frame.
  std::vector<bool> joined(observations.size(), false);
  std::vector<bool> taken(tracks_.size(), false);
  size_t merged = 0;
  for (const Proposal &p : proposals) {
    if (joined[p.observation] || taken[p.track]) continue;
    joined[p.observation] = taken[p.track] = true;
    Track &track = tracks_[p.track];
    if (track.observations.size() == kMostObservations) track.observations.erase(track.observations.begin());
    track.observations.push_back(observations[p.observation]);
    Matrix3 information;
    fuse(track.observations, track.position_m, kInfinite, &track.position_m, &information);
    ++merged;
  }
  for (size_t i = 0; i < observations.size(); ++i)
    if (!joined[i])
      tracks_.push_back({observations[i].position_m, observations[i].metric_scale_m, {observations[i]}});
  return merged;
}

std::vector<TrackedPoint> PointTracks::points() const {
  std::vector<TrackedPoint> points;
  for (const Track &track : tracks_) {
    TrackedPoint tracked;
    ModelPoint &point = tracked.point;
    Matrix3 information;
    point.position_m = track.position_m;
    const Fused agreeing = fuse(track.observations, track.position_m, kAgreement2, &point.position_m, &information);
    if (agreeing.count < options_.min_observations) continue;
    if (agreeing.count == 1 && !isTrustworthy(*agreeing.last)) continue;
    point.descriptor = representative(track.observations);
    point.sigma_m = std::sqrt(information.inverse().trace() / 3);
    point.observations = static_cast<uint32_t>(agreeing.count);
    for (const Observation &o : track.observations) {
      tracked.cameras_m.push_back(o.camera_m);
      tracked.spots.push_back(o.spot);
    }
    tracked.recording = track.observations.back().recording;
    points.push_back(std::move(tracked));
  }
  return points;
}

PointModel modelOf(const std::vector<TrackedPoint> &points) {
  PointModel model;
  for (const TrackedPoint &tracked : points) model.points.push_back(tracked.point);
  return withoutNearDuplicates(std::move(model), kModelNearDuplicates);
}

}  // namespace sphc::host
