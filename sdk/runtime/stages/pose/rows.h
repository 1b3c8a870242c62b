// Correspondences as the SIMD kernels want them: structure of arrays, single precision, padded to whole chunks.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/types/correspondence.h"

namespace sphc {

constexpr uint32_t kPoseLanes = 16;  // order of every summation is fixed by this, not by the machine's SIMD width
constexpr uint32_t kPoseChunk = 64;  // rows, after which it is asked whether a pose is worth going on with

// A row without depth has the point at 1 m on its viewing ray and the stretch -1: any row can be taken for one by
// its view, direction and weight |point - centre|^2, which is of the angle.
enum PoseField : uint32_t {
  kPointX,
  kPointY,
  kPointZ,  // m, camera frame
  kViewX,
  kViewY,
  kViewZ,  // unit viewing ray
  kDirectionX,
  kDirectionY,
  kDirectionZ,  // unit, map frame; zero in padding, which so is never in front
  kWeight,      // 1 / sideways^2
  kStretch,     // (sideways / along)^2 - 1
  kCentreX,     // m, of the camera that saw the row; none of the three where all rows are the colour camera's
  kCentreY,
  kCentreZ,
  kPoseFieldCount
};

struct PoseRows {
  float *field[kPoseFieldCount] = {};
  uint32_t count = 0;   // rows in use
  uint32_t padded = 0;  // the same in whole chunks

  static void layout(const char *name, uint32_t capacity, bool has_centres, Arena &scratch, PoseRows *rows);

  bool hasCentres() const { return field[kCentreX]; }
  uint32_t fieldCount() const { return hasCentres() ? kPoseFieldCount : kCentreX; }

  Vector3 view(uint32_t row) const { return vector(kViewX, row); }
  Vector3 direction(uint32_t row) const { return vector(kDirectionX, row); }

  // Puts a correspondence into a row: point, direction, and its errors in place of weight and stretch, until
  // PoseKernels::prepare makes the rest.
  void set(uint32_t row, const Correspondence &correspondence) {
    for (int k = 0; k < 3; ++k) {
      field[kPointX + k][row] = static_cast<float>(correspondence.lifted.point_m[k]);
      field[kDirectionX + k][row] = static_cast<float>(correspondence.direction[k]);
    }
    field[kWeight][row] = static_cast<float>(correspondence.lifted.sideways_m);
    field[kStretch][row] = static_cast<float>(correspondence.lifted.along_m);
    if (!hasCentres()) return;
    for (int k = 0; k < 3; ++k) field[kCentreX + k][row] = correspondence.lifted.centre_m[k];
  }
  // Appends those rows of `from` whose value is below the limit.  `index`: scratch for as many as `from` has.
  void pushBelow(const PoseRows &from, const float *value, float limit, uint32_t *index);
  // Once all rows are in.
  void pad();

 private:
  Vector3 vector(uint32_t first, uint32_t row) const {
    return Vector3(static_cast<double>(field[first][row]), static_cast<double>(field[first + 1][row]),
                   static_cast<double>(field[first + 2][row]));
  }
};

}  // namespace sphc
