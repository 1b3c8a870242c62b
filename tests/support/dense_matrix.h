// What decompositions of Eigen say of matrices of any size.  They are compiled here alone, since that
// takes seconds a file.
#pragma once
#include <Eigen/Core>

namespace sphc::test {

// error^T covariance^-1 error: the normalised estimation error squared, whose mean is the number of unknowns.
double normalisedSquared(const Eigen::VectorXd &error, const Eigen::MatrixXd &covariance);
double leastEigenvalue(const Eigen::MatrixXd &symmetric);
Eigen::MatrixXd inverseByLu(const Eigen::MatrixXd &matrix);

}  // namespace sphc::test
