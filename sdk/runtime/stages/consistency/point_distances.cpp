#include "runtime/stages/consistency/point_distances.h"

#include "runtime/base/clock.h"

namespace sphc {
namespace {

constexpr uint32_t kNoPoint = UINT32_MAX;
constexpr uint64_t kOldNs = 10000000000;
constexpr float kElsewhereM = 0.05f;  // from nearer all errors are the same
// The farthest apart that two distances may be, in sigmas: in 99 of 100 sound frames half of them are within 1.1.
constexpr float kMostSigmas = 1.5f;

}  // namespace

void PointDistances::layout(Arena &state, PointDistances *distances) {
  const Span<Known> known = state.take<Known>("consistency.distances", kCapacity);
  if (distances) distances->known_ = known;
}

void PointDistances::reset() {
  for (Known &known : known_) known.point_index = kNoPoint;
}

void PointDistances::begin(const Vector3 &centre_in_map_m, int64_t time_ns) {
  centre_m_ = centre_in_map_m.cast<float>();
  time_ns_ = time_ns;
  compared_ = apart_ = 0;
}

bool PointDistances::isOf(const Known &known, uint32_t point_index) const {
  return known.point_index == point_index && known.time_ns <= time_ns_ &&
         elapsedNs(known.time_ns, time_ns_) <= kOldNs;
}

void PointDistances::compare(const PointDistance &seen) {
  const Known &known = slotOf(seen.point_index);
  if (!isOf(known, seen.point_index) || (known.centre_m - centre_m_).squaredNorm() < kElsewhereM * kElsewhereM)
    return;
  const float off = static_cast<float>(seen.distance_m) - known.distance_m;
  const float variance = static_cast<float>(seen.variance_m2) + known.variance_m2;
  ++compared_;
  if (off * off > kMostSigmas * kMostSigmas * variance) ++apart_;
}

void PointDistances::keep(const PointDistance &seen) {
  Known &known = slotOf(seen.point_index);
  if (isOf(known, seen.point_index)) return;
  known = {seen.point_index, static_cast<float>(seen.distance_m), static_cast<float>(seen.variance_m2), centre_m_,
           time_ns_};
}

}  // namespace sphc
