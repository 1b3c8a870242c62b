#include "runtime/geometry/convention.h"

namespace sphc {
namespace {

constexpr bool kWorld = true, kNoWorld = false, kCameraFromWorld = true, kWorldFromCamera = false;
constexpr bool kRotationFirst = true, kTranslationFirst = false, kRealFirst = true, kRealLast = false;

// By sphc_convention - 1.
constexpr Convention kConventions[] = {
    /* OPENXR */ {{1, -2, -3}, {1, 2, 3}, 2, kWorld, kWorldFromCamera, kRotationFirst, kRealLast},
    /* UNITY */ {{1, -2, 3}, {1, 2, -3}, 2, kWorld, kWorldFromCamera, kTranslationFirst, kRealLast},
    /* ROS_OPTICAL */ {{1, 2, 3}, {1, 2, 3}, 3, kWorld, kWorldFromCamera, kTranslationFirst, kRealLast},
    /* ROS_FLU */ {{3, -1, -2}, {1, 2, 3}, 3, kWorld, kWorldFromCamera, kTranslationFirst, kRealLast},
    /* COLMAP */ {{1, 2, 3}, {1, 2, 3}, -2, kNoWorld, kCameraFromWorld, kRotationFirst, kRealFirst},
    /* TUM */ {{1, 2, 3}, {1, 2, 3}, 3, kNoWorld, kWorldFromCamera, kTranslationFirst, kRealLast},
};
constexpr int32_t kCount = sizeof kConventions / sizeof kConventions[0];

// x_theirs = matrix x_ours; a mirror where the two are not of one hand.
Matrix3 axesMatrix(const int8_t axes[3]) {
  Matrix3 matrix = Matrix3::Zero();
  for (int i = 0; i < 3; ++i) matrix(i, (axes[i] < 0 ? -axes[i] : axes[i]) - 1) = axes[i] < 0 ? -1 : 1;
  return matrix;
}

// A pose between frames of ours, as one between theirs.  The two mirrors of a left-handed system make a rotation.
Rigid toTheirs(const int8_t target_axes[3], const Rigid &target_from_source, const int8_t source_axes[3]) {
  const Matrix3 target = axesMatrix(target_axes);
  return {target * target_from_source.rotation * axesMatrix(source_axes).transpose(),
          target * target_from_source.translation_m};
}
Rigid toOurs(const int8_t target_axes[3], const Rigid &target_from_source, const int8_t source_axes[3]) {
  const Matrix3 target = axesMatrix(target_axes).transpose();
  return {target * target_from_source.rotation * axesMatrix(source_axes),
          target * target_from_source.translation_m};
}

// Where each of w x y z and of the translation stands in the seven numbers.
struct Places {
  int q_wxyz[4], t_m;
};
Places placesOf(const Convention &convention) {
  const int q = convention.rotation_first ? 0 : 3, t = convention.firstOfTranslation();
  if (convention.real_first) return {{q, q + 1, q + 2, q + 3}, t};
  return {{q + 3, q, q + 1, q + 2}, t};
}

// Of the two quaternions of a rotation, the same one whatever the last digits are: qw is not below 0, and where it
// is 0 the first of qx qy qz that is not.  For those who compare numbers.
void chooseSign(double q_wxyz[4]) {
  if (q_wxyz[0] > 1e-12) return;
  int first = 1;
  while (first < 3 && absOf(q_wxyz[first]) < 1e-9) ++first;
  if (q_wxyz[first] < 0)
    for (int i = 0; i < 4; ++i) q_wxyz[i] = -q_wxyz[i];
  if (q_wxyz[0] < 0) q_wxyz[0] = 0;
}

void writeNumbers(const Convention &convention, const Rigid &rigid, double pose[7]) {
  const sphc_rigid numbers = numbersOf(rigid);
  const Places places = placesOf(convention);
  for (int i = 0; i < 4; ++i) pose[places.q_wxyz[i]] = numbers.q_wxyz[i];
  for (int i = 0; i < 3; ++i) pose[places.t_m + i] = numbers.t_m[i];
}

// The shortest turn that takes a unit direction to z; a half turn about x where it is -z.
Matrix3 turnToZ(const Vector3 &direction) {
  // With s = direction + z, s^2 / 2 is 1 + cos of the angle, without a loss of digits near a half turn.
  const double x = direction.x(), y = direction.y(), z = direction.z() + 1;
  const double q_wxyz[4] = {(x * x + y * y + z * z) / 2, y, -x, 0};
  const double half_turn[4] = {0, 1, 0, 0};
  const bool opposite = x * x + y * y < 1e-200 && z < 1;  // nothing is left of the way
  return rotationFromQuaternion(opposite ? half_turn : q_wxyz);
}

}  // namespace

const Convention *conventionOf(sphc_convention convention) {
  return convention >= 1 && convention <= kCount ? &kConventions[convention - 1] : nullptr;
}

sphc_rigid numbersOf(const Rigid &rigid) {
  sphc_rigid numbers = rigidToC(rigid);
  chooseSign(numbers.q_wxyz);
  // Adding 0 makes 0 of -0, which reads badly in a line of text.
  for (double &q : numbers.q_wxyz) q += 0.0;
  for (double &t : numbers.t_m) t += 0.0;
  return numbers;
}

Rigid makeWorld(const Convention &convention, const Vector3 &up_map) {
  // Scaled first: its square must not vanish or overflow.
  const Vector3 scaled = up_map / up_map.cwiseAbs().maxCoeff();
  const Vector3 up = scaled / sqrtOf(scaled.squaredNorm());
  constexpr int8_t kYUp[3] = {1, 3, -2}, kYDown[3] = {1, -3, 2}, kZUp[3] = {1, 2, 3};
  const int8_t *axes = convention.up == 2 ? kYUp : convention.up == -2 ? kYDown : kZUp;
  return {axesMatrix(axes) * turnToZ(up), Vector3::Zero()};
}

void writeCamera(const Convention &convention, const Rigid &world_from_camera, double pose[7]) {
  const Rigid theirs = toTheirs(convention.world_axes, world_from_camera, convention.camera_axes);
  writeNumbers(convention, convention.camera_from_world ? theirs.inverse() : theirs, pose);
}

void writeMap(const Convention &convention, const Rigid &world_from_map, double pose[7]) {
  writeNumbers(convention, toTheirs(convention.world_axes, world_from_map, convention.world_axes), pose);
}

sphc_rigid reorder(const Convention &convention, const double pose[7]) {
  const Places places = placesOf(convention);
  sphc_rigid numbers;
  for (int i = 0; i < 4; ++i) numbers.q_wxyz[i] = pose[places.q_wxyz[i]];
  for (int i = 0; i < 3; ++i) numbers.t_m[i] = pose[places.t_m + i];
  return numbers;
}

Rigid readCamera(const Convention &convention, const sphc_rigid &numbers) {
  const Rigid theirs = rigidFromC(numbers);
  return toOurs(convention.world_axes, convention.camera_from_world ? theirs.inverse() : theirs,
                convention.camera_axes);
}

Rigid readMap(const Convention &convention, const sphc_rigid &numbers) {
  return toOurs(convention.world_axes, rigidFromC(numbers), convention.world_axes);
}

}  // namespace sphc
