#include "host/audit/score/point_errors.h"

#include <algorithm>
#include <limits>

namespace sphc::host {
namespace {

template <typename T, typename Is>
double share(const std::vector<T> &items, Is is) {
  if (items.empty()) return 0;
  return static_cast<double>(std::count_if(items.begin(), items.end(), is)) / static_cast<double>(items.size());
}

}  // namespace

std::vector<double> pointErrors(const std::vector<Vector3> &true_points_m,
                                const std::vector<uint32_t> &line_of_point,
                                const std::vector<Vector3> &recovered_m) {
  std::vector<double> errors_m;
  for (size_t i = 0; i < true_points_m.size(); ++i)
    errors_m.push_back((recovered_m.at(line_of_point.at(i)) - true_points_m[i]).norm());
  return errors_m;
}

std::vector<double> nearestPointErrors(const std::vector<Vector3> &true_points_m,
                                       const std::vector<uint32_t> &line_of_point,
                                       const std::vector<Vector3> &recovered_m) {
  const std::vector<double> each_m = pointErrors(true_points_m, line_of_point, recovered_m);
  std::vector<double> errors_m(recovered_m.size(), std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < each_m.size(); ++i)
    errors_m[line_of_point[i]] = std::min(errors_m[line_of_point[i]], each_m[i]);
  return errors_m;
}

double shareWithin(const std::vector<Vector3> &points_m, const Vector3 &of_m, double radius_m) {
  return share(points_m, [&](const Vector3 &point) { return (point - of_m).norm() <= radius_m; });
}

double shareUpTo(const std::vector<double> &errors_m, double bound_m) {
  return share(errors_m, [&](double error) { return error <= bound_m; });
}

}  // namespace sphc::host
