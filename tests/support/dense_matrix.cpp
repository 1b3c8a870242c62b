#include "tests/support/dense_matrix.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace sphc::test {

double normalisedSquared(const Eigen::VectorXd &error, const Eigen::MatrixXd &covariance) {
  return error.dot(covariance.ldlt().solve(error));
}

double leastEigenvalue(const Eigen::MatrixXd &symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

Eigen::MatrixXd inverseByLu(const Eigen::MatrixXd &matrix) { return matrix.inverse(); }

}  // namespace sphc::test
