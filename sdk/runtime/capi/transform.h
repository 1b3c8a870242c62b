// Validation of transforms that come through the C interface.
#pragma once
#include "spherecloud/spherecloud.h"

namespace sphc {

// Each is true where that can be used; else the message says which number of the caller's is wrong, and the cure.
// A part of a translation lies within +-most_m; the caller's numbers are name[first] and the two behind it.
bool checkOffset(const char *name, const char *field, int first, const double t_m[3], double most_m,
                 sphc_message *message);
// A length of 1, to 1e-3.  `order` is that of the caller's numbers.
bool checkQuaternion(const char *name, const char *field, const double q_wxyz[4], const char *order,
                     sphc_message *message);
bool checkTransform(const char *name, const sphc_rigid &transform, double most_m, sphc_message *message);

}  // namespace sphc
