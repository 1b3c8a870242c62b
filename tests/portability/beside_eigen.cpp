// A program that has Eigen's templates too, by flags of its own: as aligned and as wide as its processor allows,
// and not inlined, so that a linker sees them.  Then the session, whose bytes must not change.
#include <Eigen/Dense>
#include <cstdio>

extern "C" {
#include "data.h"
#include "replay.h"
}

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

// What a filter of poses does.
double filter(double s) {
  Eigen::Matrix2d p = Eigen::Matrix2d::Identity() * s, q;
  q = p;
  const Eigen::Vector2d w = p * Eigen::Vector2d(1, s);
  Matrix6 a = Matrix6::Constant(s / 7);
  a = a * a.transpose() + Matrix6::Identity();
  const Eigen::Matrix<double, 6, 1> x = a.ldlt().solve(Eigen::Matrix<double, 6, 1>::Ones() * s);
  Eigen::Matrix3d r = Eigen::Quaterniond(1, 0.1, 0.2, s).normalized().toRotationMatrix();
  Eigen::Vector3d v(1, 2, s);
  v = r * v;
  v += r.transpose() * v / v.norm();
  Matrix8 g = Matrix8::Identity() * s;
  a = g.block<6, 6>(0, 0) * a;
  g = g * g;
  return w.sum() + q.sum() + x.sum() + v.cross(r.col(0)).sum() + a.sum() + g.ldlt().vectorD().sum();
}

void print(void *, const char *text) { std::puts(text); }

}  // namespace

int main() {
  volatile double s = 1.5;
  std::printf("the program's own %g\n", filter(s));
  const auto bytes = static_cast<size_t>(data_map_end - data_map);
  return replay_check(data_map, bytes, data_expected, print, nullptr);
}
