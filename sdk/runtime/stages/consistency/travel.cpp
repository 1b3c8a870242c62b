#include "runtime/stages/consistency/travel.h"

#include <algorithm>

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr uint32_t kFewest = 5;
// Of the logarithm of the scale, where places spread so far about their mean (root mean square).  On a shorter way
// it takes the more, by the square: at 4 cm a factor of 1.3.
constexpr double kMostOff = 0.06, kFarM = 0.08;
constexpr double kSigmas = 4;
constexpr double kHonest = 2;       // errors of poses over their stated ones
constexpr double kIndependent = 4;  // one place in so many: neighbours share their errors
// Errors of odometry add up from step to step.  Of such a way of n steps about its mean the square is n / 6 times
// that of a step, along each axis, of which 6 / pi^2 have the shape of a straight walk (Brownian bridge: its first
// mode).
constexpr double kDrift = 1 / (kPi * kPi);
// Such a way alone has this mean square about its mean over n times the variance of a step, or less: of one in ten
// thousand it is more (400 000 drawn ways of 5 to 64 steps).
constexpr double kMostOfDrift = 2.4;

}  // namespace

void Travel::add(const Vector3 &centre_in_map_m, const Vector3 &centre_in_odometry_m, double sigma_m,
                 double way_variance_m2) {
  if (count_ == 0) next_ = 0;
  places_[next_] = {centre_in_map_m, centre_in_odometry_m, sigma_m, way_variance_m2};
  next_ = (next_ + 1) % kCapacity;
  if (count_ < kCapacity) ++count_;
}

Travel::Spread Travel::spread() const {
  Vector3 map = Vector3::Zero(), odometry = Vector3::Zero();
  for (uint32_t i = 0; i < count_; ++i) {
    map += places_[i].map_m;
    odometry += places_[i].odometry_m;
  }
  map /= count_;
  odometry /= count_;
  Spread spread;
  for (uint32_t i = 0; i < count_; ++i) {
    spread.map2 += (places_[i].map_m - map).squaredNorm() / count_;
    spread.odometry2 += (places_[i].odometry_m - odometry).squaredNorm() / count_;
    spread.sigma2 += kHonest * kHonest * places_[i].sigma_m * places_[i].sigma_m / count_;
    spread.way2 += places_[i].way_variance_m2;
  }
  return spread;
}

bool Travel::isScaled() const {
  if (count_ < kFewest) return false;
  const Spread s = spread();
  // What errors of odometry may have added is no way: where the camera stands still they are all of it.
  const double least2 = std::min(s.map2, s.odometry2),
               odometry2 = std::max(s.odometry2 - kMostOfDrift * s.way2, least2);
  const double off = 0.5 * absOf(logOf(s.map2 / odometry2));
  const double far2 = std::min(std::max(s.map2, odometry2), kFarM * kFarM);
  const double sigma2 = (s.sigma2 * kIndependent / count_ + kDrift * s.way2) / odometry2;
  return off * far2 > kMostOff * kFarM * kFarM && off * off > kSigmas * kSigmas * sigma2;
}

}  // namespace sphc
