#include "runtime/stages/pose/mirrored.h"

#include <Eigen/Eigenvalues>

#include "runtime/stages/pose/residual.h"

namespace sphc {
namespace {

constexpr uint32_t kFewest = 4;
constexpr double kFlat = 0.15;    // extent across the plane over the second largest: flatter than this
constexpr double kSquare = 0.99;  // cosine between the plane's normal and the line of sight: less than this

Matrix3 reflectionAt(const Vector3 &normal) { return Matrix3::Identity() - 2 * normal * normal.transpose(); }

}  // namespace

bool mirroredPose(Span<const Correspondence> correspondences, const Rigid &camera_from_map, double threshold2,
                  Rigid *mirrored) {
  Vector3 sum = Vector3::Zero();
  Matrix3 squares = Matrix3::Zero();
  uint32_t count = 0;
  for (const Correspondence &c : correspondences) {
    if (!c.lifted.hasDepth()) continue;
    const Residual r = residualOf(c, camera_from_map);
    if (!r.in_front || !(r.squared < threshold2)) continue;
    sum += c.lifted.point_m;
    squares += c.lifted.point_m * c.lifted.point_m.transpose();
    ++count;
  }
  if (count < kFewest) return false;
  const Vector3 centroid_m = sum / count;
  const Matrix3 scatter = squares / count - centroid_m * centroid_m.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes(scatter);  // smallest first
  if (!(axes.eigenvalues()[0] < kFlat * kFlat * axes.eigenvalues()[1])) return false;

  const Vector3 normal = axes.eigenvectors().col(0), from_centre_m = centroid_m - camera_from_map.translation_m;
  const Vector3 sight = from_centre_m.normalized();
  if (absOf(sight.dot(normal)) > kSquare) return false;
  // The plane's points do not change when mirrored at the plane itself, which makes a rotation of the two.
  const Matrix3 back = (reflectionAt(sight) * reflectionAt(normal)).transpose();
  *mirrored = {back * camera_from_map.rotation, centroid_m - back * from_centre_m};
  return true;
}

}  // namespace sphc
