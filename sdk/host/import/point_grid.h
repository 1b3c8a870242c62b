// Points sorted into cubes, to find those near a place.
#pragma once
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "runtime/geometry/rotation.h"

namespace sphc::host {

class PointGrid {
 public:
  explicit PointGrid(double cube_m) : cube_m_(cube_m) {}

  void add(const Vector3 &position_m, size_t index) { cubes_[cubeOf(position_m)].push_back({position_m, index}); }

  // Calls visit(index, distance_m) for every point within `radius_m`, in a fixed order.
  template <typename Visit>
  void forEachNear(const Vector3 &position_m, double radius_m, Visit visit) const {
    const Vector3 reach = Vector3::Constant(radius_m);
    const Cube low = cubeOf(position_m - reach), high = cubeOf(position_m + reach);
    for (int64_t x = std::get<0>(low); x <= std::get<0>(high); ++x)
      for (int64_t y = std::get<1>(low); y <= std::get<1>(high); ++y)
        for (int64_t z = std::get<2>(low); z <= std::get<2>(high); ++z) {
          const auto cube = cubes_.find({x, y, z});
          if (cube == cubes_.end()) continue;
          for (const Item &item : cube->second) {
            const double distance = (item.position_m - position_m).norm();
            if (distance <= radius_m) visit(item.index, distance);
          }
        }
  }

 private:
  using Cube = std::tuple<int64_t, int64_t, int64_t>;
  struct Item {
    Vector3 position_m;
    size_t index;
  };
  Cube cubeOf(const Vector3 &p) const {
    const auto at = [this](double x) { return static_cast<int64_t>(std::floor(x / cube_m_)); };
    return {at(p.x()), at(p.y()), at(p.z())};
  }

  double cube_m_;
  std::map<Cube, std::vector<Item>> cubes_;
};

}  // namespace sphc::host
