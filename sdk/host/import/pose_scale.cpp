#include "host/import/pose_scale.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host/import/near_duplicates.h"

namespace sphc::host {
namespace {

constexpr double kLogStep = 0.06;  // of the multiple
constexpr double kAgreePx = 3, kAtFocalPx = 500;
constexpr double kNearestM = 0.05;         // a point closer to the camera says nothing
constexpr double kFixedPx = 1.5;           // a menu is found anew where it was
constexpr double kRatio = 0.8;             // of a match's distance and the second best
constexpr size_t kAsked = 250;             // keypoints of a frame
constexpr uint32_t kMostComparisons = 40;  // of a recording
constexpr uint32_t kMostFramesApart = 12;
// A part that is sound must not be taken for one that is not.
constexpr uint32_t kMostParts = 8, kLeastMatchesOfPart = 100;
constexpr double kLeastParallaxRad = 0.03, kMostTurn = 0.35;

// What others state poses in.  Of mirrored axes those of the camera count alone: the world may lie in any.
struct Mistake {
  enum class Kind { kInverse, kAxes, kPositions } kind;
  double axes[3];  // as the poses have them, in ours
  const char *text;
};
using Kind = Mistake::Kind;
constexpr Mistake kKnownMistakes[] = {
    {Kind::kInverse, {1, 1, 1}, "poses are camera_from_world: invert each of them"},
    {Kind::kAxes,
     {1, -1, -1},
     "poses are of a camera with axes right, up, back, as in OpenGL and ARKit: negate y and z of the positions and "
     "of the quaternions"},
    {Kind::kAxes,
     {1, -1, 1},
     "poses are of a left-handed world, as Unity's: negate y of the positions, and x and z of the quaternions"},
    {Kind::kAxes,
     {1, 1, -1},
     "poses are of a left-handed world: negate z of the positions, and x and y of the quaternions"},
    {Kind::kAxes,
     {-1, 1, 1},
     "poses are of a left-handed world: negate x of the positions, and y and z of the quaternions"},
    {Kind::kPositions, {-1, 1, 1}, "positions are of a left-handed world, and rotations are not: negate their x"},
    {Kind::kPositions, {1, -1, 1}, "positions are of a left-handed world, and rotations are not: negate their y"},
    {Kind::kPositions, {1, 1, -1}, "positions are of a left-handed world, and rotations are not: negate their z"},
};

Rigid corrected(const Mistake &mistake, const Rigid &told) {
  if (mistake.kind == Kind::kInverse) return told.inverse();
  const Matrix3 axes = Vector3(mistake.axes[0], mistake.axes[1], mistake.axes[2]).asDiagonal();
  const bool turns = mistake.kind == Kind::kAxes;
  return {turns ? Matrix3(axes * told.rotation * axes) : told.rotation, axes * told.translation_m};
}

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
  frames_of_part_ = std::max(1u, frames / kMostParts);
  ++recordings_;
}

// Pairs begin every so many frames, and end with the first that shows enough parallax, if poses are about right.
void PoseScaleCheck::add(uint32_t sequence, const Rigid &world_from_camera,
                         const std::vector<Observation> &observations) {
  enterPart(sequence);
  if (observations.size() < 2) return;
  const uint32_t number = count_++;
  if (has_first_) {
    const Rigid now_from_first = world_from_camera.inverse() * world_from_first_;
    const double turn = rotationAngle(now_from_first.rotation);
    const bool is_apart = now_from_first.translation_m.norm() > kLeastParallaxRad * medianDepthM(first_);
    if (is_apart && turn < kMostTurn) {
      const Votes votes = compare(world_from_camera, observations);
      all_.add(votes);
      parts_.back().votes.add(votes);
    }
    has_first_ = !is_apart && turn < kMostTurn && number % every_ < kMostFramesApart;
  }
  if (has_first_ || number % every_) return;
  has_first_ = true;
  world_from_first_ = world_from_camera;
  first_ = observations;
}

void PoseScaleCheck::enterPart(uint32_t sequence) {
  const bool is_full = !parts_.empty() && parts_.back().frames >= frames_of_part_ &&
                       parts_.back().votes.matches >= kLeastMatchesOfPart;
  if (parts_.empty() || is_full || parts_.back().recording != recordings_ - 1)
    parts_.push_back({recordings_ - 1, sequence, sequence, 0, {}});
  parts_.back().last_sequence = sequence;
  ++parts_.back().frames;
}

PoseScaleCheck::Votes PoseScaleCheck::compare(const Rigid &world_from_camera,
                                              const std::vector<Observation> &observations) const {
  Votes votes;
  const Rigid camera_from_world = world_from_camera.inverse();
  const Rigid now_from_first = camera_from_world * world_from_first_;
  const Rigid first_from_world = world_from_first_.inverse();
  static_assert(std::size(kKnownMistakes) == kMistakes);
  std::array<Rigid, kMistakes> now_from_first_corrected;
  for (size_t k = 0; k < kMistakes; ++k)
    now_from_first_corrected[k] =
        corrected(kKnownMistakes[k], world_from_camera).inverse() * corrected(kKnownMistakes[k], world_from_first_);
  const size_t step = std::max<size_t>(1, first_.size() / kAsked);
  for (size_t i = 0; i < first_.size(); i += step) {
    const Observation *match = matchOf(first_[i], observations);
    if (!match) continue;
    ++votes.matches;
    const Vector3 seen_m = first_from_world * first_[i].position_m;
    const Vector3 turned_m = now_from_first.rotation * seen_m;
    const bool is_told = agrees(turned_m + now_from_first.translation_m, *match);
    votes.fixed_in_image += !is_told && (match->image_px - first_[i].image_px).norm() < kFixedPx;
    for (int k = 0; k < kBins; ++k) {
      const double multiple = std::exp(kLogStep * (k - kSteps));
      votes.multiples[static_cast<size_t>(k)] += agrees(turned_m + multiple * now_from_first.translation_m, *match);
    }
    for (size_t k = 0; k < kMistakes; ++k)
      votes.corrections[k] += agrees(now_from_first_corrected[k] * seen_m, *match);
  }
  return votes;
}

bool PoseScaleCheck::agrees(const Vector3 &point_m, const Observation &match) const {
  Vector2 pixel_px;
  if (point_m.z() < kNearestM || !camera_.project(point_m, &pixel_px)) return false;
  return (pixel_px - match.pixel_px).norm() < kAgreePx * camera_.focal() / kAtFocalPx;
}

void PoseScaleCheck::Votes::add(const Votes &more) {
  matches += more.matches;
  fixed_in_image += more.fixed_in_image;
  for (size_t k = 0; k < multiples.size(); ++k) multiples[k] += more.multiples[k];
  for (size_t k = 0; k < corrections.size(); ++k) corrections[k] += more.corrections[k];
}

PoseScale PoseScaleCheck::Votes::result() const {
  const auto most = std::max_element(multiples.begin(), multiples.end());
  const auto k = static_cast<int>(most - multiples.begin());
  const auto best = std::max_element(corrections.begin(), corrections.end());
  const char *mistake = kKnownMistakes[best - corrections.begin()].text;
  return {matches, multiples[kSteps], *most, std::exp(kLogStep * (k - kSteps)), *best, mistake, fixed_in_image};
}

std::vector<PoseScalePart> PoseScaleCheck::parts() const {
  std::vector<PoseScalePart> parts;
  for (const Part &part : parts_)
    parts.push_back({part.recording, part.first_sequence, part.last_sequence, part.votes.result()});
  return parts;
}

}  // namespace sphc::host
