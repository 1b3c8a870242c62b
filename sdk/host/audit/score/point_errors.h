// How far recovered points are from the true ones.
#pragma once
#include <vector>

#include "runtime/geometry/rotation.h"

namespace sphc::host {

// Of each true point from the point that was recovered for its line, metres (the paper's e_g).
std::vector<double> pointErrors(const std::vector<Vector3> &true_points_m,
                                const std::vector<uint32_t> &line_of_point,
                                const std::vector<Vector3> &recovered_m);

// The same for clouds whose lines hide two points each: of the nearer of a line's points, one error a line.  An
// attacker finds one peak; this is what it is worth at best.
std::vector<double> nearestPointErrors(const std::vector<Vector3> &true_points_m,
                                       const std::vector<uint32_t> &line_of_point,
                                       const std::vector<Vector3> &recovered_m);

// Share of points within `radius_m` of one.
double shareWithin(const std::vector<Vector3> &points_m, const Vector3 &of_m, double radius_m);

// Share of errors up to a bound.
double shareUpTo(const std::vector<double> &errors_m, double bound_m);

}  // namespace sphc::host
