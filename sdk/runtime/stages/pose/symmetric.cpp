#include "runtime/stages/pose/symmetric.h"

#include <utility>

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr double kLeastPivot = 2.2250738585072014e-308;  // the least normal number: below, a direction says nothing

// Of one to seven terms: in halves, so that rounding errors stay even.
double sumOf(const double *t, int count) {
  double sum = t[0];
  switch (count) {
    case 2:
      sum += t[1];
      break;
    case 3:
      sum += t[1] + t[2];
      break;
    case 4:
      sum = (t[0] + t[1]) + (t[2] + t[3]);
      break;
    case 5:
      sum = (t[0] + t[1]) + (t[2] + (t[3] + t[4]));
      break;
    case 6:
      sum = (t[0] + (t[1] + t[2])) + (t[3] + (t[4] + t[5]));
      break;
    case 7:
      sum = (t[0] + (t[1] + t[2])) + ((t[3] + t[4]) + (t[5] + t[6]));
      break;
    default:
      break;
  }
  return sum;
}

}  // namespace

SymmetricFactors::SymmetricFactors(const double *matrix, int rows) : rows_(rows) {
  for (int i = 0; i < rows * rows; ++i) factors_[i] = matrix[i];
  for (int k = 0; k < rows; ++k) {
    int largest = k;
    for (int i = k + 1; i < rows; ++i)
      if (absOf(at(i, i)) > absOf(at(largest, largest))) largest = i;
    exchanged_[k] = largest;
    if (largest != k) exchange(k, largest);
    eliminate(k);
  }
}

// Rows and columns of the lower triangle.
void SymmetricFactors::exchange(int k, int with) {
  for (int column = 0; column < k; ++column) std::swap(at(k, column), at(with, column));
  for (int row = with + 1; row < rows_; ++row) std::swap(at(row, k), at(row, with));
  for (int i = k + 1; i < with; ++i) std::swap(at(i, k), at(with, i));
  std::swap(at(k, k), at(with, with));
}

void SymmetricFactors::eliminate(int k) {
  double scaled[kMostRows];
  for (int column = 0; column < k; ++column) scaled[column] = at(column, column) * at(k, column);
  for (int row = k; row < rows_ && k > 0; ++row) {
    double sum = at(row, 0) * scaled[0];
    for (int column = 1; column < k; ++column) sum += at(row, column) * scaled[column];
    at(row, k) -= sum;
  }
  if (!(absOf(at(k, k)) > 0)) return;
  for (int row = k + 1; row < rows_; ++row) at(row, k) /= at(k, k);
}

void SymmetricFactors::solve(double *x) const {
  for (int k = 0; k < rows_; ++k) std::swap(x[k], x[exchanged_[k]]);
  double terms[kMostRows];
  for (int row = 1; row < rows_; ++row) {
    for (int i = 0; i < row; ++i) terms[i] = at(row, i) * x[i];
    x[row] -= sumOf(terms, row);
  }
  for (int k = 0; k < rows_; ++k) x[k] = absOf(at(k, k)) > kLeastPivot ? x[k] / at(k, k) : 0;
  for (int row = rows_ - 2; row >= 0; --row) {
    const int count = rows_ - 1 - row;
    for (int i = 0; i < count; ++i) terms[i] = at(row + 1 + i, row) * x[row + 1 + i];
    x[row] -= sumOf(terms, count);
  }
  for (int k = rows_ - 1; k >= 0; --k) std::swap(x[k], x[exchanged_[k]]);
}

}  // namespace sphc
