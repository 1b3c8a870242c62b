#include "lab/baselines/p6l.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <array>
#include <cmath>

#include "lab/baselines/quaternion_forms.h"

namespace sphc::host {
namespace {

constexpr int kColumns = 4;                      // of the linear system: t and 1
constexpr int kDegree = 6, kTemplateDegree = 8;  // of the forms, and of their products
constexpr int kForms = 15;                       // 4 x 4 minors of a 6 x 4 matrix
constexpr int kRank = 101;                       // of those products
constexpr int kNewtonSteps = 8;
constexpr double kPolished2 = 1e-20;  // squared residual of a solution, equations scaled to unit rows
constexpr double kImaginary = 1e-3;   // of an eigenvalue that may be real, relative to 1 + its size

// Lines about the origin and of unit size, so that all columns of the system are of one size.
struct Scaled {
  Vector3 bearing[kP6lLines], direction[kP6lLines], moment[kP6lLines];
  Vector3 origin_m = Vector3::Zero();
  double unit_m = 1;
};

Scaled scale(const Vector3 bearing[], const Line line[]) {
  Scaled s;
  for (int i = 0; i < kP6lLines; ++i) s.origin_m += line[i].point_m / kP6lLines;
  double sum2 = 0;
  for (int i = 0; i < kP6lLines; ++i) {
    s.bearing[i] = bearing[i].normalized();
    s.direction[i] = line[i].direction;
    s.moment[i] = (line[i].point_m - s.origin_m).cross(line[i].direction);
    sum2 += s.moment[i].squaredNorm();
  }
  s.unit_m = sum2 > 0 ? std::sqrt(sum2 / kP6lLines) : 1;
  for (Vector3 &moment : s.moment) moment /= s.unit_m;
  return s;
}

// The nine entries of |q|^2 R as quadratic forms: r[row][column] is dotted with the monomials of degree 2.
using RotationForms = std::array<std::array<Form, 3>, 3>;

RotationForms rotationForms() {
  const auto at = [](int x, int y, int z) { return Monomial{x, y, z}.place(); };
  const int ww = at(0, 0, 0), wx = at(1, 0, 0), wy = at(0, 1, 0), wz = at(0, 0, 1);
  const int xx = at(2, 0, 0), yy = at(0, 2, 0), zz = at(0, 0, 2), xy = at(1, 1, 0), xz = at(1, 0, 1),
            yz = at(0, 1, 1);
  RotationForms r;
  for (auto &row : r)
    for (Form &entry : row) entry = Form::Zero(monomialCount(2));
  const int squares[3] = {xx, yy, zz};
  for (size_t i = 0; i < 3; ++i) {
    r[i][i][ww] = 1;
    for (size_t k = 0; k < 3; ++k) r[i][i][squares[k]] = i == k ? 1 : -1;
  }
  const auto offDiagonal = [&](size_t i, size_t k, int both, int with_w) {
    r[i][k][both] = r[k][i][both] = 2;
    r[i][k][with_w] = -2;
    r[k][i][with_w] = 2;
  };
  offDiagonal(0, 1, xy, wz);
  offDiagonal(2, 0, xz, wy);
  offDiagonal(1, 2, yz, wx);
  return r;
}

using System = std::array<std::array<Form, kColumns>, kP6lLines>;

// Row i is [ (R d_i) x b_i, b_i . R m_i ] times |q|^2.
System linearSystem(const Scaled &s) {
  static const RotationForms r = rotationForms();
  System system;
  for (size_t i = 0; i < kP6lLines; ++i) {
    std::array<Form, 3> turned;  // R d_i
    Form last = Form::Zero(monomialCount(2));
    for (size_t k = 0; k < 3; ++k) {
      turned[k] = r[k][0] * s.direction[i][0] + r[k][1] * s.direction[i][1] + r[k][2] * s.direction[i][2];
      last += s.bearing[i][static_cast<int>(k)] *
              (r[k][0] * s.moment[i][0] + r[k][1] * s.moment[i][1] + r[k][2] * s.moment[i][2]);
    }
    for (size_t k = 0; k < 3; ++k) {
      const size_t next = (k + 1) % 3, after = (k + 2) % 3;
      system[i][k] = turned[next] * s.bearing[i][static_cast<int>(after)] -
                     turned[after] * s.bearing[i][static_cast<int>(next)];
    }
    system[i][3] = last;
  }
  return system;
}

constexpr int kPairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};  // of columns
constexpr double kPairSigns[6] = {1, -1, 1, 1, -1, 1};                          // in Laplace's expansion

// 2 x 2 minors of two rows, a pair of columns each.
std::array<Form, 6> smallMinors(const System &system, size_t row, size_t other) {
  std::array<Form, 6> minors;
  for (size_t k = 0; k < 6; ++k) {
    const auto a = static_cast<size_t>(kPairs[k][0]), b = static_cast<size_t>(kPairs[k][1]);
    minors[k] = product(system[row][a], 2, system[other][b], 2) - product(system[row][b], 2, system[other][a], 2);
  }
  return minors;
}

// The fifteen forms of degree 6, a row each.
Eigen::MatrixXd minorForms(const System &system) {
  std::array<std::array<std::array<Form, 6>, kP6lLines>, kP6lLines> small;
  for (size_t i = 0; i < kP6lLines; ++i)
    for (size_t k = i + 1; k < kP6lLines; ++k) small[i][k] = smallMinors(system, i, k);
  Eigen::MatrixXd forms(kForms, monomialCount(kDegree));
  int count = 0;
  for (size_t a = 0; a < kP6lLines; ++a)
    for (size_t b = a + 1; b < kP6lLines; ++b)
      for (size_t c = b + 1; c < kP6lLines; ++c)
        for (size_t d = c + 1; d < kP6lLines; ++d) {
          Form minor = Form::Zero(monomialCount(8));
          for (size_t k = 0; k < 6; ++k) minor += kPairSigns[k] * product(small[a][b][k], 4, small[c][d][5 - k], 4);
          forms.row(count++) = withoutSquaredLength(minor, 8).normalized();
        }
  return forms;
}

// Coordinate 0 to 3 (w, x, y, z) times a monomial.
Monomial times(int coordinate, const Monomial &m) {
  return {m.x + (coordinate == 1), m.y + (coordinate == 2), m.z + (coordinate == 3)};
}

// Columns span the values that the monomials of degree 8 take at the solutions: what is orthogonal to all products
// of a form and a monomial of degree 2.
Eigen::MatrixXd solutionSpace(const Eigen::MatrixXd &forms, const std::vector<Monomial> &monomial) {
  constexpr int kFactors = monomialCount(kTemplateDegree - kDegree);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(monomialCount(kTemplateDegree), kFactors * kForms);
  for (int factor = 0; factor < kFactors; ++factor)
    for (int i = 0; i < monomialCount(kDegree); ++i)
      products.row((monomial[static_cast<size_t>(factor)] * monomial[static_cast<size_t>(i)]).place())
          .segment(factor * kForms, kForms) = forms.col(i).transpose();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(products);
  Eigen::MatrixXd space = Eigen::MatrixXd::Zero(products.rows(), kP6lMaxSolutions);
  space.bottomRows(kP6lMaxSolutions).setIdentity();
  space.applyOnTheLeft(qr.householderQ().setLength(kRank));
  return space;
}

// Two linear forms in general position; a solution at which the first vanishes would be lost.
const Eigen::Vector4d kDenominator(0.8147, 0.3127, -0.2641, 0.4098), kNumerator(-0.4318, 0.6205, -0.5173, 0.3952);

Eigen::MatrixXd multiplied(const Eigen::MatrixXd &space, const std::vector<Monomial> &monomial,
                           const Eigen::Vector4d &linear) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(monomialCount(kTemplateDegree - 1), space.cols());
  for (int i = 0; i < result.rows(); ++i)
    for (int coordinate = 0; coordinate < 4; ++coordinate)
      result.row(i) += linear[coordinate] * space.row(times(coordinate, monomial[static_cast<size_t>(i)]).place());
  return result;
}

// The quaternion whose monomials of degree 8 these are, up to scale: read around its largest coordinate.
Eigen::Vector4d quaternionOf(const Eigen::VectorXd &values) {
  constexpr int kPower = kTemplateDegree - 1;
  const Monomial pure[4] = {{0, 0, 0}, {kPower, 0, 0}, {0, kPower, 0}, {0, 0, kPower}};
  int largest = 0;
  double most = -1;
  for (int k = 0; k < 4; ++k) {
    const double power = std::abs(values[times(k, pure[k]).place()]);
    if (power > most) most = power, largest = k;
  }
  Eigen::Vector4d q;
  for (int k = 0; k < 4; ++k) q[k] = values[times(k, pure[largest]).place()];
  return q.normalized();
}

std::vector<Eigen::Vector4d> quaternions(const Eigen::MatrixXd &forms) {
  static const std::vector<Monomial> monomial = monomials(kTemplateDegree);
  const Eigen::MatrixXd space = solutionSpace(forms, monomial);
  const Eigen::MatrixXd action =
      multiplied(space, monomial, kDenominator).householderQr().solve(multiplied(space, monomial, kNumerator));
  std::vector<Eigen::Vector4d> solutions;
  if (!action.allFinite()) return solutions;
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(action);
  if (eigen.info() != Eigen::Success) return solutions;
  const Eigen::MatrixXcd vectors = eigen.eigenvectors();
  for (int i = 0; i < action.cols(); ++i) {
    const std::complex<double> value = eigen.eigenvalues()[i];
    if (std::abs(value.imag()) <= kImaginary * (1 + std::abs(value)) && value.imag() >= 0)
      solutions.push_back(quaternionOf(space * vectors.col(i).real()));
  }
  return solutions;
}

using Matrix64 = Eigen::Matrix<double, kP6lLines, kColumns>;

Matrix64 rowsAt(const Scaled &s, const Matrix3 &rotation) {
  Matrix64 rows;
  for (int i = 0; i < kP6lLines; ++i) {
    rows.row(i).head<3>() = (rotation * s.direction[i]).cross(s.bearing[i]);
    rows(i, 3) = s.bearing[i].dot(rotation * s.moment[i]);
    rows.row(i).normalize();
  }
  return rows;
}

// Newton's method on the six equations; false when it does not arrive.
bool polish(const Scaled &s, Rigid *pose) {
  for (int step = 0; step <= kNewtonSteps; ++step) {
    Eigen::Matrix<double, 6, 6> jacobian;
    Eigen::Matrix<double, 6, 1> residual;
    for (int i = 0; i < kP6lLines; ++i) {
      const Vector3 direction = pose->rotation * s.direction[i], moment = pose->rotation * s.moment[i];
      const Vector3 &b = s.bearing[i], &t = pose->translation_m;
      const Vector3 by_translation = direction.cross(b);
      const double weight = 1 / std::hypot(by_translation.norm() * (1 + t.norm()), b.dot(moment));
      residual[i] = weight * (b.dot(moment) + t.dot(by_translation));
      // A small turn w of the rotation moves b . moment by w . (moment x b), and t x direction alike.
      jacobian.row(i).head<3>() = weight * (moment.cross(b) + direction.cross(b.cross(t)));
      jacobian.row(i).tail<3>() = weight * by_translation;
    }
    if (!residual.allFinite()) return false;
    if (residual.squaredNorm() < kPolished2) return true;
    const Eigen::Matrix<double, 6, 1> change = jacobian.partialPivLu().solve(-residual);
    if (!change.allFinite()) return false;
    pose->rotation = rotationFromVector(change.head<3>()) * pose->rotation;
    pose->translation_m += change.tail<3>();
  }
  return false;
}

}  // namespace

std::vector<Rigid> solveP6l(const Vector3 bearing[], const Line line[]) {
  const Scaled s = scale(bearing, line);
  std::vector<Rigid> poses;
  for (const Eigen::Vector4d &q : quaternions(minorForms(linearSystem(s)))) {
    Rigid pose;
    pose.rotation = rotationFromQuaternion(q.data());
    const Matrix64 rows = rowsAt(s, pose.rotation);
    pose.translation_m = rows.leftCols<3>().colPivHouseholderQr().solve(-rows.col(3));
    if (!pose.translation_m.allFinite() || !polish(s, &pose)) continue;
    pose.translation_m = s.unit_m * pose.translation_m - pose.rotation * s.origin_m;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace sphc::host
