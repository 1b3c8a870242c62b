// Relative pose of two centres from five pairs of directions.
//   b^T E a = 0 for each pair, E = [t] R;  det E = 0,  2 E E^T E - trace(E E^T) E = 0
// Stewenius, Engels, Nister: "Recent developments on direct relative orientation" (2006): the four-dimensional null
// space, ten cubics in three unknowns, elimination, eigenvectors of the action matrix.
// Any directions of the sphere; five pairs whose directions all agree leave E open, and then any answer may come.
#pragma once
#include <array>
#include <vector>

#include "runtime/geometry/rotation.h"

namespace sphc::host {

// At most 10 essential matrices of Frobenius norm 1.
std::vector<Matrix3> fivePoint(const std::array<Vector3, 5> &a, const std::array<Vector3, 5> &b);

}  // namespace sphc::host
