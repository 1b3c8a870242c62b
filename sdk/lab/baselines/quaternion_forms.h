// Forms (homogeneous polynomials) in the coordinates of a quaternion (w, x, y, z), for minimal solvers.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace sphc::host {

// Coefficients of the monomials in this order: by falling power of w, then of x, then of y.  A monomial and its
// product with w have the same place, whatever the degree.
using Form = Eigen::VectorXd;

constexpr int monomialCount(int degree) { return (degree + 1) * (degree + 2) * (degree + 3) / 6; }

struct Monomial {
  int x = 0, y = 0, z = 0;  // w has the rest of the degree
  Monomial operator*(const Monomial &other) const { return {x + other.x, y + other.y, z + other.z}; }
  constexpr int place() const { return monomialCount(x + y + z - 1) + (y + z) * (y + z + 1) / 2 + z; }
};

std::vector<Monomial> monomials(int degree);

Form product(const Form &a, int degree_a, const Form &b, int degree_b);

// a / (w^2 + x^2 + y^2 + z^2), for a form of this degree that it divides.
Form withoutSquaredLength(const Form &a, int degree);

}  // namespace sphc::host
