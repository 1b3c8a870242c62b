#include "lab/baselines/line_clouds.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "host/audit/attack/nearest_points.h"
#include "runtime/base/random.h"

namespace sphc::host {
namespace {

constexpr size_t kFewestPoints = 2;

void checkCount(const std::vector<Vector3> &points_m) {
  if (points_m.size() < kFewestPoints)
    throw std::runtime_error("a line cloud is made of two points at least; map more frames");
}

// Marsaglia 1972.
Vector3 uniformDirection(Random *random) {
  for (;;) {
    const Vector3 v(2 * random->uniform() - 1, 2 * random->uniform() - 1, 2 * random->uniform() - 1);
    const double length2 = v.squaredNorm();
    if (length2 <= 1 && length2 > 1e-6) return v / std::sqrt(length2);
  }
}

std::vector<uint32_t> shuffledIndices(size_t count, Random *random) {
  std::vector<uint32_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0u);
  for (size_t i = count; i > 1; --i) std::swap(indices[i - 1], indices[random->below(static_cast<uint32_t>(i))]);
  return indices;
}

// Through two points; in any direction when they are one.
Line joining(const Vector3 &a_m, const Vector3 &b_m, Random *random) {
  const Vector3 along = b_m - a_m;
  return Line::through(a_m, along.norm() > 1e-9 ? along : uniformDirection(random));
}

// A line for each two points in a row, and one for the last of an odd number with the first.
LineCloud joinPairs(const std::string &name, const std::vector<Vector3> &points_m,
                    const std::vector<uint32_t> &order, Random *random) {
  LineCloud cloud = {name, {}, std::vector<uint32_t>(points_m.size()), {}, {}};
  for (size_t k = 0; k + 1 < order.size(); k += 2) {
    for (const uint32_t point : {order[k], order[k + 1]})
      cloud.line_of_point[point] = static_cast<uint32_t>(cloud.lines.size());
    cloud.lines.push_back(joining(points_m[order[k]], points_m[order[k + 1]], random));
  }
  if (order.size() % 2 == 1) {
    cloud.line_of_point[order.back()] = static_cast<uint32_t>(cloud.lines.size());
    cloud.lines.push_back(joining(points_m[order.back()], points_m[order.front()], random));
  }
  return cloud;
}

Eigen::SelfAdjointEigenSolver<Matrix3> axesOf(const std::vector<Vector3> &points_m, Vector3 *mean_m) {
  *mean_m = Vector3::Zero();
  for (const Vector3 &point : points_m) *mean_m += point / static_cast<double>(points_m.size());
  Matrix3 covariance = Matrix3::Zero();
  for (const Vector3 &point : points_m)
    covariance += (point - *mean_m) * (point - *mean_m).transpose() / static_cast<double>(points_m.size());
  return Eigen::SelfAdjointEigenSolver<Matrix3>(covariance);  // by rising eigenvalue
}

// Of the plane through each point's neighbours.
std::vector<Vector3> localNormals(const std::vector<Vector3> &points_m) {
  const NearestPoints tree(points_m);
  std::vector<Vector3> normals;
  for (const Vector3 &point : points_m) {
    std::vector<Vector3> near;
    for (const size_t i : tree.find(point, kPlaneNeighbours)) near.push_back(points_m[i]);
    Vector3 mean_m;
    normals.emplace_back(axesOf(near, &mean_m).eigenvectors().col(0));
  }
  return normals;
}

// Sine of the angle between a line and the flatter of its two ends' planes.
double steepness(const Vector3 &a_m, const Vector3 &b_m, const Vector3 &normal_a, const Vector3 &normal_b) {
  const Vector3 along = b_m - a_m;
  if (!(along.norm() > 1e-9)) return 0;
  return std::min(std::abs(along.dot(normal_a)), std::abs(along.dot(normal_b))) / along.norm();
}

LineCloud centralLines(const std::string &name, const std::vector<Vector3> &points_m,
                       const std::vector<Vector3> &centres_m, Random *random) {
  LineCloud cloud = {name, {}, {}, centres_m, {}};
  for (const Vector3 &point : points_m) {
    const uint32_t group = random->below(static_cast<uint32_t>(centres_m.size()));
    cloud.line_of_point.push_back(static_cast<uint32_t>(cloud.lines.size()));
    cloud.lines.push_back(joining(centres_m[group], point, random));
    if (centres_m.size() > 1) cloud.group_of_line.push_back(group);
  }
  return cloud;
}

}  // namespace

LineCloud uniformLineCloud(const std::vector<Vector3> &points_m, uint64_t seed) {
  checkCount(points_m);
  Random random(seed);
  LineCloud cloud = {"uniform line cloud", {}, std::vector<uint32_t>(points_m.size()), {}, {}};
  std::iota(cloud.line_of_point.begin(), cloud.line_of_point.end(), 0u);
  for (const Vector3 &point : points_m) cloud.lines.push_back(Line::through(point, uniformDirection(&random)));
  return cloud;
}

LineCloud pairedLineCloud(const std::vector<Vector3> &points_m, uint64_t seed) {
  checkCount(points_m);
  Random random(seed);
  return joinPairs("PPL", points_m, shuffledIndices(points_m.size(), &random), &random);
}

LineCloud pairedLineCloudPlus(const std::vector<Vector3> &points_m, uint64_t seed) {
  checkCount(points_m);
  Random random(seed);
  const std::vector<Vector3> normals = localNormals(points_m);
  std::vector<uint32_t> order = shuffledIndices(points_m.size(), &random);
  const double enough = std::sin(kLeastAngleRad);
  for (size_t k = 0; k + 2 < order.size(); k += 2) {
    const uint32_t point = order[k];
    size_t best = k + 1;
    double steepest = -1;
    for (uint32_t trial = 0; trial < kPartnerTrials && steepest < enough; ++trial) {
      const size_t at = k + 1 + random.below(static_cast<uint32_t>(order.size() - k - 1));
      const double steep = steepness(points_m[point], points_m[order[at]], normals[point], normals[order[at]]);
      if (steep > steepest) steepest = steep, best = at;
    }
    std::swap(order[k + 1], order[best]);
  }
  return joinPairs("PPL+", points_m, order, &random);
}

LineCloud rayCloud(const std::vector<Vector3> &points_m, uint64_t seed) {
  checkCount(points_m);
  Random random(seed);
  Vector3 mean_m;
  const auto axes = axesOf(points_m, &mean_m);
  const Vector3 offset = std::sqrt(axes.eigenvalues()[2]) * axes.eigenvectors().col(2);
  return centralLines("ray cloud", points_m, {mean_m - offset, mean_m + offset}, &random);
}

LineCloud centralLineCloud(const std::vector<Vector3> &directions) {
  checkCount(directions);
  Random random(0);
  return centralLines("sphere cloud", directions, {Vector3::Zero()}, &random);
}

}  // namespace sphc::host
