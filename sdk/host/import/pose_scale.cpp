#include "host/import/pose_scale.h"

#include <algorithm>
#include <cmath>

#include "host/import/near_duplicates.h"

namespace sphc::host {
namespace {

constexpr double kLogStep = 0.06;          // of the multiple
constexpr double kAgreePx = 3;             // at a focal length of 500 pixels
constexpr double kRatio = 0.8;             // of a match's distance and the second best
constexpr size_t kAsked = 250;             // keypoints of a frame
constexpr uint32_t kMostComparisons = 40;  // of a recording
constexpr uint32_t kMostFramesApart = 12;
constexpr double kLeastParallaxRad = 0.03, kMostTurn = 0.35;

double medianDepthM(const std::vector<Observation> &observations) {
  std::vector<double> depths_m;
  for (const Observation &o : observations) depths_m.push_back(o.depth_m);
  const auto middle = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 2);
  std::nth_element(depths_m.begin(), middle, depths_m.end());
  return *middle;
}

// The one of these that looks most alike, by far; null where there is none.
const Observation *matchOf(const Observation &asked, const std::vector<Observation> &all) {
  const Observation *found = nullptr;
  double best = 1e9, second = 1e9;
  for (const Observation &o : all) {
    const double distance = descriptorDistance(asked.descriptor, o.descriptor);
    if (distance >= second) continue;
    second = std::max(best, std::min(second, distance));
    if (distance >= best) continue;
    best = distance;
    found = &o;
  }
  return best < kRatio * second ? found : nullptr;
}

}  // namespace

void PoseScaleCheck::begin(const Camera &camera, uint32_t frames) {
  camera_ = camera;
  every_ = std::max(1u, frames / kMostComparisons);
  has_first_ = false;
}

// Pairs begin every so many frames, and end with the first that shows enough parallax, if poses are about right.
void PoseScaleCheck::add(const Rigid &world_from_camera, const std::vector<Observation> &observations) {
  if (observations.size() < 2) return;
  const uint32_t number = count_++;
  if (has_first_) {
    const Rigid now_from_first = world_from_camera.inverse() * world_from_first_;
    const double turn = rotationAngle(now_from_first.rotation);
    const bool is_apart = now_from_first.translation_m.norm() > kLeastParallaxRad * medianDepthM(first_);
    if (is_apart && turn < kMostTurn) compare(world_from_camera, observations);
    has_first_ = !is_apart && turn < kMostTurn && number % every_ < kMostFramesApart;
  }
  if (has_first_ || number % every_) return;
  has_first_ = true;
  world_from_first_ = world_from_camera;
  first_ = observations;
}

void PoseScaleCheck::compare(const Rigid &world_from_camera, const std::vector<Observation> &observations) {
  const Rigid camera_from_world = world_from_camera.inverse();
  const Rigid now_from_first = camera_from_world * world_from_first_;
  const Rigid first_from_world = world_from_first_.inverse();
  const double agree_px = kAgreePx * camera_.focal() / 500;
  const size_t step = std::max<size_t>(1, first_.size() / kAsked);
  for (size_t i = 0; i < first_.size(); i += step) {
    const Observation *match = matchOf(first_[i], observations);
    if (!match) continue;
    ++matches_;
    const Vector3 turned_m = now_from_first.rotation * (first_from_world * first_[i].position_m);
    for (int k = 0; k < kBins; ++k) {
      const Vector3 point_m = turned_m + std::exp(kLogStep * (k - kSteps)) * now_from_first.translation_m;
      Vector2 pixel_px;
      if (point_m.z() < 0.05 || !camera_.project(point_m, &pixel_px)) continue;
      votes_[static_cast<size_t>(k)] += (pixel_px - match->pixel_px).norm() < agree_px;
    }
  }
}

PoseScale PoseScaleCheck::result() const {
  const auto most = std::max_element(votes_.begin(), votes_.end());
  const auto k = static_cast<int>(most - votes_.begin());
  return {matches_, votes_[kSteps], *most, std::exp(kLogStep * (k - kSteps))};
}

}  // namespace sphc::host
