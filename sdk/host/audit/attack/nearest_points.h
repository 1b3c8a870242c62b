// Nearest neighbours among points in space.
#pragma once
#include <nanoflann.hpp>
#include <vector>

#include "runtime/geometry/rotation.h"

namespace sphc::host {

// The points must outlive it and stay where they are.
class NearestPoints {
 public:
  explicit NearestPoints(const std::vector<Vector3> &points_m)
      : cloud_{&points_m}, tree_(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {
    tree_.buildIndex();
  }

  // Of at most `count` nearest, nearest first; a point of the set is its own neighbour.
  std::vector<size_t> find(const Vector3 &at_m, size_t count) const {
    std::vector<size_t> indices(count);
    std::vector<double> squared_m2(count);
    indices.resize(tree_.knnSearch(at_m.data(), count, indices.data(), squared_m2.data()));
    return indices;
  }

 private:
  struct Cloud {
    const std::vector<Vector3> *points_m;
    size_t kdtree_get_point_count() const { return points_m->size(); }
    double kdtree_get_pt(size_t i, size_t axis) const { return (*points_m)[i][static_cast<int>(axis)]; }
    template <typename Box>
    bool kdtree_get_bbox(Box &) const {
      return false;
    }
  };
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, size_t>;

  Cloud cloud_;
  Tree tree_;
};

}  // namespace sphc::host
