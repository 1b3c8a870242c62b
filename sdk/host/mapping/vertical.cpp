#include "host/mapping/vertical.h"

#include <algorithm>
#include <cmath>

#include "runtime/geometry/rigid.h"

namespace sphc::host {
namespace {

constexpr double kGravityMps2 = 9.81, kGravityOffMps2 = 1.0;  // accelerometers are off by some per cent
constexpr int64_t kStretchNs = 1000000000;
constexpr int64_t kMostGapNs = 500000000;  // of poses, and of accelerations in a stretch
constexpr size_t kFewestStretches = 3;
constexpr double kMostSpreadRad = 15 * kPi / 180;  // of stretches; who walks briskly has 3 to 6 degrees

// The means of stretches of a second that have accelerations throughout, without a gap up to half a second before
// their end, and how many accelerations there are.
struct SecondsOfWalk {
  std::vector<Vector3> means;
  size_t accelerations = 0;
};

void addPath(const FeltPath &path, SecondsOfWalk *all) {
  Vector3 sum = Vector3::Zero();
  size_t count = 0;
  int64_t begin_ns = 0, last_ns = 0;
  const auto close = [&] {
    if (count > 0 && last_ns - begin_ns >= kStretchNs - kMostGapNs)
      all->means.push_back(sum / static_cast<double>(count));
    sum.setZero();
    count = 0;
  };
  for (const recording::TimedAcceleration &felt : path.felt) {
    const std::optional<sphc_rigid> pose = path.world_from_camera.at(felt.time_ns, kMostGapNs);
    if (!pose) continue;
    if (count == 0 || felt.time_ns - begin_ns >= kStretchNs || felt.time_ns - last_ns > kMostGapNs) {
      close();
      begin_ns = felt.time_ns;
    }
    sum += rotationFromQuaternion(pose->q_wxyz) * Eigen::Map<const Vector3>(felt.felt_mps2);
    ++count;
    last_ns = felt.time_ns;
    ++all->accelerations;
  }
  close();
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

}  // namespace

MeasuredVertical measureVertical(const std::vector<FeltPath> &paths) {
  SecondsOfWalk all;
  for (const FeltPath &path : paths) addPath(path, &all);
  MeasuredVertical vertical;
  if (all.means.size() < kFewestStretches) return vertical;
  vertical.accelerations = all.accelerations;
  vertical.seconds = static_cast<double>(all.means.size());
  Vector3 mean = Vector3::Zero();
  for (const Vector3 &stretch : all.means) mean += stretch / vertical.seconds;
  double squared = 0;
  for (const Vector3 &stretch : all.means) squared += std::pow(angleBetween(stretch, mean), 2);
  const double spread_rad = std::sqrt(squared / vertical.seconds);
  vertical.sigma_rad = spread_rad / std::sqrt(vertical.seconds);
  vertical.up_world = mean.normalized();
  if (std::fabs(mean.norm() - kGravityMps2) > kGravityOffMps2)
    vertical.doubt = "their mean is " + rounded(mean.norm()) +
                     " m/s^2, and gravity is 9.8; check the units, and the sensor's place on the camera";
  else if (spread_rad > kMostSpreadRad)
    vertical.doubt = "seconds of the walk differ by " + rounded(spread_rad * 180 / kPi) +
                     " deg in where up is; check the sensor's place on the camera";
  return vertical;
}

}  // namespace sphc::host
