#include "runtime/stages/consistency/travel.h"

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr uint32_t kFewest = 5;
constexpr double kFarM = 0.08;     // root mean square of places about their mean
constexpr double kMostOff = 0.06;  // of the logarithm of the scale
constexpr double kSigmas = 4;
constexpr double kHonest = 2;       // errors of poses over their stated ones
constexpr double kIndependent = 4;  // one place in so many: neighbours share their errors

}  // namespace

void Travel::add(const Vector3 &centre_in_map_m, const Vector3 &centre_in_odometry_m, double sigma_m) {
  if (count_ == 0) next_ = 0;
  places_[next_] = {centre_in_map_m, centre_in_odometry_m, sigma_m};
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
  }
  return spread;
}

double Travel::scale() const { return count_ < kFewest ? 0 : scaleOf(spread()); }

double Travel::scaleOf(const Spread &s) {
  if (!(s.map2 > kFarM * kFarM || s.odometry2 > kFarM * kFarM) || !(s.odometry2 > 1e-6)) return 0;
  return sqrtOf(s.map2 / s.odometry2);
}

bool Travel::isScaled() const {
  if (count_ < kFewest) return false;
  const Spread s = spread();
  const double scale = scaleOf(s);
  if (!(scale > 0)) return false;
  const double off = absOf(logOf(scale));
  const double sigma = sqrtOf(s.sigma2 * kIndependent / (s.odometry2 * count_));
  return off > kMostOff && off > kSigmas * sigma;
}

}  // namespace sphc
