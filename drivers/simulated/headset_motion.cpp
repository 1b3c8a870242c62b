// headset_motion.cpp - what an accelerometer in the colour camera feels: gravity, the walk, and its own faults.
#include <cmath>

#include "drivers/simulated/headset.h"

namespace sphc::simulated {

namespace {

constexpr double kGravityMps2 = 9.81;
constexpr double kSpanS = 0.005;           // of the differences
constexpr double kNoiseMps2 = 0.03;        // sigma of a measurement, on each axis
constexpr double kBiasMps2 = 0.04;         // sigma of what stays
constexpr double kStepsPerMps2 = 1024;     // it counts in whole steps
constexpr uint64_t kStream = 0x0ACCE1E8u;  // of its random numbers

double measured(double exact, uint64_t seed, uint64_t axis, int64_t time_ns) {
  const uint64_t of_axis = hash64(seed, kStream + axis);
  const double faults = kBiasMps2 * static_cast<double>(gaussian(of_axis)) +
                        kNoiseMps2 * static_cast<double>(gaussian(hash64(of_axis, static_cast<uint64_t>(time_ns))));
  return std::round((exact + faults) * kStepsPerMps2) / kStepsPerMps2;
}

}  // namespace

Vec3d Headset::felt(int64_t time_ns) const {
  const Pose now = colorPose(time_ns);
  const Vec3d twice = now.center * 2.0;
  const Vec3d change = colorPoseAfter(time_ns, kSpanS).center - twice + colorPoseAfter(time_ns, -kSpanS).center;
  const Vec3d exact = transposed(now.rotation) * (change * (1 / (kSpanS * kSpanS)) + Vec3d{0, 0, kGravityMps2});
  const uint64_t seed = hash64(config_.seed, config_.walk_seed);
  return {measured(exact.x, seed, 0, time_ns), measured(exact.y, seed, 1, time_ns),
          measured(exact.z, seed, 2, time_ns)};
}

}  // namespace sphc::simulated
