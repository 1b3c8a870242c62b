#include "host/audit/attack/five_point.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <cstdint>

namespace sphc::host {
namespace {

// Polynomials in x, y, z; monomials in falling degree, so that those of a lower degree are the last of the list.
constexpr int kMonomials = 20;
constexpr int8_t kExponents[kMonomials][3] = {
    {3, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 3, 0}, {2, 0, 1}, {1, 1, 1}, {0, 2, 1}, {1, 0, 2}, {0, 1, 2}, {0, 0, 3},
    {2, 0, 0}, {1, 1, 0}, {0, 2, 0}, {1, 0, 1}, {0, 1, 1}, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
using Polynomial = Eigen::Matrix<double, kMonomials, 1>;
// First monomial of degree 1, 2, 3 at most.
constexpr int kFirst[4] = {19, 16, 10, 0};

int indexOf(int x, int y, int z) {
  for (int i = 0; i < kMonomials; ++i)
    if (kExponents[i][0] == x && kExponents[i][1] == y && kExponents[i][2] == z) return i;
  return -1;
}

// The monomial that is the product of two; those of more than degree 3 are not asked for.
struct ProductTable {
  int8_t at[kMonomials][kMonomials];
  ProductTable() {
    for (int i = 0; i < kMonomials; ++i)
      for (int j = 0; j < kMonomials; ++j) {
        const int8_t *a = kExponents[i], *b = kExponents[j];
        at[i][j] = static_cast<int8_t>(indexOf(a[0] + b[0], a[1] + b[1], a[2] + b[2]));
      }
  }
};

Polynomial product(const Polynomial &a, int degree_a, const Polynomial &b, int degree_b) {
  static const ProductTable table;
  Polynomial c = Polynomial::Zero();
  for (int i = kFirst[degree_a]; i < kMonomials; ++i)
    for (int j = kFirst[degree_b]; j < kMonomials; ++j) c[table.at[i][j]] += a[i] * b[j];
  return c;
}

using Essential = std::array<std::array<Polynomial, 3>, 3>;  // linear in x, y, z

Essential nullSpace(const std::array<Vector3, 5> &a, const std::array<Vector3, 5> &b) {
  Eigen::Matrix<double, 5, 9> rows;
  for (int k = 0; k < 5; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) rows(k, 3 * i + j) = b[static_cast<size_t>(k)][i] * a[static_cast<size_t>(k)][j];
  const Eigen::JacobiSVD<Eigen::Matrix<double, 5, 9>> svd(rows, Eigen::ComputeFullV);
  Essential e;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Polynomial &entry = e[static_cast<size_t>(i)][static_cast<size_t>(j)];
      entry.setZero();
      entry.tail<4>() = svd.matrixV().row(3 * i + j).tail<4>();
    }
  return e;
}

Eigen::Matrix<double, 10, kMonomials> constraints(const Essential &e) {
  Eigen::Matrix<double, 10, kMonomials> rows = Eigen::Matrix<double, 10, kMonomials>::Zero();
  std::array<std::array<Polynomial, 3>, 3> square;  // E E^T
  Polynomial trace = Polynomial::Zero();
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      square[i][j].setZero();
      for (size_t k = 0; k < 3; ++k) square[i][j] += product(e[i][k], 1, e[j][k], 1);
      if (i == j) trace += square[i][j];
    }
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      Polynomial sum = -product(trace, 2, e[i][j], 1);
      for (size_t k = 0; k < 3; ++k) sum += 2 * product(square[i][k], 2, e[k][j], 1);
      rows.row(static_cast<Eigen::Index>(3 * i + j)) = sum.transpose();
    }
  for (size_t j = 0; j < 3; ++j) {  // the determinant along the first row
    const size_t k = (j + 1) % 3, l = (j + 2) % 3;
    const Polynomial minor = product(e[1][k], 1, e[2][l], 1) - product(e[1][l], 1, e[2][k], 1);
    rows.row(9) += product(minor, 2, e[0][j], 1).transpose();
  }
  return rows;
}

// Multiplication by x of 1, z, y, x and the six squares, modulo the constraints.
Eigen::Matrix<double, 10, 10> actionMatrix(const Eigen::Matrix<double, 10, kMonomials> &rows) {
  const Eigen::Matrix<double, 10, 10> reduced = rows.leftCols<10>().partialPivLu().solve(rows.rightCols<10>());
  Eigen::Matrix<double, 10, 10> action = Eigen::Matrix<double, 10, 10>::Zero();
  for (int i = 0; i < 10; ++i) {
    const int8_t *monomial = kExponents[10 + i];
    const int times_x = indexOf(monomial[0] + 1, monomial[1], monomial[2]);
    if (times_x < 10)
      action.row(i) = -reduced.row(times_x);
    else
      action(i, times_x - 10) = 1;
  }
  return action;
}

}  // namespace

std::vector<Matrix3> fivePoint(const std::array<Vector3, 5> &a, const std::array<Vector3, 5> &b) {
  const Essential e = nullSpace(a, b);
  const Eigen::Matrix<double, 10, 10> action = actionMatrix(constraints(e));
  std::vector<Matrix3> solutions;
  if (!action.allFinite()) return solutions;
  const Eigen::EigenSolver<Eigen::Matrix<double, 10, 10>> eigen(action);
  for (int k = 0; k < 10; ++k) {
    if (std::abs(eigen.eigenvalues()[k].imag()) > 1e-8) continue;
    const Eigen::Matrix<double, 10, 1> v = eigen.eigenvectors().col(k).real();
    if (!(std::abs(v[9]) > 1e-12)) continue;
    Matrix3 matrix;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        matrix(i, j) = e[static_cast<size_t>(i)][static_cast<size_t>(j)].tail<4>().dot(v.tail<4>()) / v[9];
    if (matrix.allFinite() && matrix.norm() > 0) solutions.push_back(matrix / matrix.norm());
  }
  return solutions;
}

}  // namespace sphc::host
