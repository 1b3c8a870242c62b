#include "runtime/capi/transform.h"

#include "runtime/base/elementary.h"
#include "runtime/base/message.h"

namespace sphc {
namespace {

constexpr double kMostLengthError = 1e-3;
static_assert(SPHC_RIG_MAX_LENGTH_ERROR == kMostLengthError &&
              SPHC_CONVENTION_MAX_LENGTH_ERROR == kMostLengthError);

}  // namespace

bool checkOffset(const char *name, const char *field, int first, const double t_m[3], double most_m,
                 sphc_message *message) {
  for (int i = 0; i < 3; ++i) {
    if (absOf(t_m[i]) <= most_m) continue;
    MessageWriter(message) << name << field << "[" << first + i << "] is " << t_m[i] << "; it must lie in "
                           << -most_m << " to " << most_m << ": give metres";
    return false;
  }
  return true;
}

bool checkQuaternion(const char *name, const char *field, const double q_wxyz[4], const char *order,
                     sphc_message *message) {
  double squared = 0;
  for (int i = 0; i < 4; ++i) squared += q_wxyz[i] * q_wxyz[i];
  if (absOf(squared - 1) <= 2 * kMostLengthError) return true;
  MessageWriter(message) << name << field << " has length " << sqrtOf(squared) << "; it must be 1 (order " << order
                         << "): divide by its length";
  return false;
}

bool checkTransform(const char *name, const sphc_rigid &transform, double most_m, sphc_message *message) {
  return checkOffset(name, ".t_m", 0, transform.t_m, most_m, message) &&
         checkQuaternion(name, ".q_wxyz", transform.q_wxyz, "w x y z", message);
}

}  // namespace sphc
