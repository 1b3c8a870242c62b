// Two releases about different centres, however turned: points that are real in both are triangulated.
#pragma once
#include <vector>

#include "host/audit/attack/published.h"

namespace sphc::host {

struct TriangulationOptions {
  // Between a direction and the plane in which it should lie: the one that finds most beyond chance counts.  Points
  // that were measured anew want more than those that were not.
  std::vector<double> angles_rad = {2e-3, 8e-3};
  double ratio = 0.8;  // of descriptors that are not equal
  int samples = 20000;
};

struct TriangulatedPoint {
  uint32_t a, b;     // entries
  Vector3 position;  // in the frame of release a; the unit is the distance of the centres
};

struct Triangulation {
  bool found = false;  // a pose that chance does not explain, with parallax
  Matrix3 b_from_a = Matrix3::Identity();
  Vector3 centre_b = Vector3::Zero();  // unit, in the frame of release a
  std::vector<TriangulatedPoint> points;
  size_t by_chance = 0;  // points that the same pose finds among wrong pairs
};

Triangulation triangulateReleases(const Published &a, const Published &b, const TriangulationOptions &options);

}  // namespace sphc::host
