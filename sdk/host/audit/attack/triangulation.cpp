#include "host/audit/attack/triangulation.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "host/audit/attack/descriptor_pairs.h"
#include "host/audit/attack/five_point.h"
#include "runtime/base/random.h"

namespace sphc::host {
namespace {

constexpr int kRotationSamples = 4000;
constexpr size_t kTrialPairs = 400;   // pairs that a hypothesis is tried on before all of them are
constexpr double kCoarse_rad = 0.2;   // of a rotation that leaves parallax aside
constexpr double kLeastParallax = 3;  // times the angle: less says nothing of distance
constexpr double kShares[] = {0.05, 0.1, 0.2, 0.4,
                              1};  // of pairs in order of parallax, from which samples are drawn

struct DirectionPair {
  Vector3 a, b;
  EntryPair entries;
};

struct Pose {
  Matrix3 b_from_a;
  Vector3 centre_b;  // unit, in a
};

// The rotation that takes two directions to two others (TRIAD; Black 1964).
Matrix3 rotationOf(const DirectionPair &p, const DirectionPair &q) {
  const auto frame = [](const Vector3 &u, const Vector3 &v) {
    Matrix3 m;
    const Vector3 w = u.cross(v).normalized();
    m << u, w, u.cross(w);
    return m;
  };
  return frame(p.b, q.b) * frame(p.a, q.a).transpose();
}

const DirectionPair &drawn(const std::vector<DirectionPair> &pairs, size_t among, Random *random) {
  return pairs[random->below(static_cast<uint32_t>(among))];
}

// As if the centres were one: brings most pairs roughly together.
Matrix3 coarseRotation(const std::vector<DirectionPair> &pairs, Random *random) {
  const size_t trial = std::min(pairs.size(), 2 * kTrialPairs);
  Matrix3 best = Matrix3::Identity();
  size_t best_count = 0;
  for (int i = 0; i < kRotationSamples; ++i) {
    const DirectionPair &p = drawn(pairs, pairs.size(), random), &q = drawn(pairs, pairs.size(), random);
    if (std::abs(angleBetween(p.a, q.a) - angleBetween(p.b, q.b)) > kCoarse_rad ||
        angleBetween(p.a, q.a) < kCoarse_rad)
      continue;
    const Matrix3 rotation = rotationOf(p, q);
    size_t count = 0;
    for (size_t k = 0; k < trial; ++k) {
      const DirectionPair &pair = pairs[k * pairs.size() / trial];
      count += pair.b.dot(rotation * pair.a) > std::cos(kCoarse_rad);
    }
    if (count > best_count) best_count = count, best = rotation;
  }
  return best;
}

// Is each direction in the plane that the other one and the centres span?
bool isEpipolar(const Matrix3 &e, const DirectionPair &pair, double sine) {
  const Vector3 plane_b = e * pair.a, plane_a = e.transpose() * pair.b;
  const double miss2 = plane_b.dot(pair.b) * plane_b.dot(pair.b);
  return miss2 < sine * sine * plane_b.squaredNorm() && miss2 < sine * sine * plane_a.squaredNorm();
}

size_t support(const Matrix3 &e, const std::vector<DirectionPair> &pairs, size_t trial, double sine) {
  size_t count = 0;
  for (size_t k = 0; k < trial; ++k) count += isEpipolar(e, pairs[k * pairs.size() / trial], sine);
  return count;
}

// Linear least squares on the pairs that agree (Longuet-Higgins 1981), brought to an essential matrix.
Matrix3 refined(const Matrix3 &start, const std::vector<DirectionPair> &pairs, double sine) {
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  size_t count = 0;
  for (const DirectionPair &pair : pairs) {
    if (!isEpipolar(start, pair, sine)) continue;
    const Matrix3 outer = pair.a * pair.b.transpose();  // column-major: b a^T by rows
    const Eigen::Map<const Eigen::Matrix<double, 9, 1>> row(outer.data());
    const double weight = 1 / std::max((start * pair.a).squaredNorm(), 1e-4);  // of the angle, as it is now
    normal += weight * row * row.transpose();
    ++count;
  }
  if (count < 8) return start;
  const Eigen::JacobiSVD<Eigen::Matrix<double, 9, 9>> svd(normal, Eigen::ComputeFullV);
  Eigen::Matrix<double, 9, 1> least = svd.matrixV().col(8);
  const Matrix3 columns = Eigen::Map<Matrix3>(least.data());  // a by rows, b by columns
  const Eigen::JacobiSVD<Matrix3> parts(columns.transpose(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  return parts.matrixU() * Vector3(1, 1, 0).asDiagonal() * parts.matrixV().transpose();
}

Matrix3 bestEssential(const std::vector<DirectionPair> &pairs, double angle_rad, int samples, Random *random) {
  const double sine = std::sin(angle_rad);
  const Matrix3 rotation = coarseRotation(pairs, random);
  std::vector<DirectionPair> sorted = pairs;
  std::sort(sorted.begin(), sorted.end(), [&](const DirectionPair &p, const DirectionPair &q) {
    return p.b.dot(rotation * p.a) > q.b.dot(rotation * q.a);
  });
  Matrix3 best = Matrix3::Zero();
  size_t best_support = 0, best_trial = 0;
  const size_t trial = std::min(pairs.size(), kTrialPairs);
  for (int i = 0; i < samples; ++i) {
    const double share = kShares[static_cast<size_t>(i) % std::size(kShares)];
    const size_t among = std::max<size_t>(5, static_cast<size_t>(share * static_cast<double>(sorted.size())));
    std::array<Vector3, 5> a, b;
    for (size_t k = 0; k < 5; ++k) {
      const DirectionPair &pair = drawn(sorted, among, random);
      a[k] = pair.a, b[k] = pair.b;
    }
    for (const Matrix3 &e : fivePoint(a, b)) {
      const size_t on_trial = support(e, pairs, trial, sine);
      if (2 * on_trial < best_trial) continue;
      best_trial = std::max(best_trial, on_trial);
      const size_t all = support(e, pairs, pairs.size(), sine);
      if (all > best_support) best_support = all, best = e;
    }
  }
  for (int i = 0; i < 5 && best_support > 0; ++i) {
    const Matrix3 e = refined(best, pairs, sine);
    const size_t all = support(e, pairs, pairs.size(), sine);
    if (all < best_support) break;
    best_support = all, best = e;
  }
  return best;
}

// A point on both rays, in front of both centres; false when they do not meet at an angle.
bool triangulate(const Pose &pose, const DirectionPair &pair, double least_parallax_rad, Vector3 *position) {
  const Vector3 b_in_a = pose.b_from_a.transpose() * pair.b;
  if (angleBetween(pair.a, b_in_a) < least_parallax_rad) return false;
  // u a - v b = centre_b, least squares
  Eigen::Matrix<double, 3, 2> rays;
  rays << pair.a, -b_in_a;
  const Eigen::Vector2d lengths = (rays.transpose() * rays).inverse() * (rays.transpose() * pose.centre_b);
  if (!(lengths.x() > 0 && lengths.y() > 0)) return false;
  *position = (lengths.x() * pair.a + pose.centre_b + lengths.y() * b_in_a) / 2;
  return true;
}

std::vector<TriangulatedPoint> triangulateAll(const Pose &pose, const Matrix3 &e,
                                              const std::vector<DirectionPair> &pairs, double angle_rad) {
  std::vector<TriangulatedPoint> points;
  for (const DirectionPair &pair : pairs) {
    TriangulatedPoint point = {pair.entries.a, pair.entries.b, {}};
    if (isEpipolar(e, pair, std::sin(angle_rad)) &&
        triangulate(pose, pair, kLeastParallax * angle_rad, &point.position))
      points.push_back(point);
  }
  return points;
}

// E = [t] R has four decompositions; most points lie in front of both centres in one of them.
Pose poseOf(const Matrix3 &e, const std::vector<DirectionPair> &pairs, double angle_rad) {
  const Eigen::JacobiSVD<Matrix3> svd(e, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 w;
  w << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  Pose best = {};
  size_t best_count = 0;
  for (const Matrix3 &turn : {w, Matrix3(w.transpose())})
    for (const double sign : {1.0, -1.0}) {
      Matrix3 rotation = svd.matrixU() * turn * svd.matrixV().transpose();
      if (rotation.determinant() < 0) rotation = -rotation;
      const Pose pose = {rotation, -sign * (rotation.transpose() * svd.matrixU().col(2))};
      const size_t count = triangulateAll(pose, e, pairs, angle_rad).size();
      if (count >= best_count) best_count = count, best = pose;
    }
  return best;
}

Triangulation attack(const std::vector<DirectionPair> &pairs, double angle_rad, int samples) {
  Random random(7);
  const Matrix3 e = bestEssential(pairs, angle_rad, samples, &random);
  const Pose pose = poseOf(e, pairs, angle_rad);
  std::vector<DirectionPair> wrong = pairs;
  for (size_t i = 0; i < pairs.size(); ++i) wrong[i].b = pairs[(i + pairs.size() / 2) % pairs.size()].b;
  Triangulation result;
  result.b_from_a = pose.b_from_a;
  result.centre_b = pose.centre_b;
  result.points = triangulateAll(pose, e, pairs, angle_rad);
  result.by_chance = triangulateAll(pose, e, wrong, angle_rad).size();
  const double chance = static_cast<double>(result.by_chance);
  result.found = static_cast<double>(result.points.size()) > 1.5 * chance + 6 * std::sqrt(chance) + 12;
  return result;
}

// How much more than chance was found, in standard deviations of chance.
double surprise(const Triangulation &result) {
  const double found = static_cast<double>(result.points.size()), chance = static_cast<double>(result.by_chance);
  return (found - chance) / std::sqrt(chance + 1);
}

}  // namespace

Triangulation triangulateReleases(const Published &a, const Published &b, const TriangulationOptions &options) {
  std::vector<DirectionPair> pairs;
  for (const EntryPair &pair : pairEntries(a.descriptors, b.descriptors, options.ratio))
    pairs.push_back({a.directions[pair.a], b.directions[pair.b], pair});
  Triangulation best;
  if (pairs.size() < 8) return best;
  for (double angle_rad : options.angles_rad) {
    Triangulation result = attack(pairs, angle_rad, options.samples);
    const bool better =
        result.found > best.found || (result.found == best.found && surprise(result) > surprise(best));
    if (better) best = std::move(result);
  }
  return best;
}

}  // namespace sphc::host
