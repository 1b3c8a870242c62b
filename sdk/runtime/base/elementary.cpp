#include "runtime/base/elementary.h"

namespace sphc {
namespace {

// Taylor series on |x| <= pi/4: the last term is below 1e-17.
double sinSmall(double x) {
  const double s = x * x;
  double sum = 0;
  for (int k = 17; k >= 3; k -= 2) sum = (1 + sum) * -s / (k * (k - 1.0));
  return x * (1 + sum);
}
double cosSmall(double x) {
  const double s = x * x;
  double sum = 0;
  for (int k = 18; k >= 2; k -= 2) sum = (1 + sum) * -s / (k * (k - 1.0));
  return 1 + sum;
}

// atan on [0, 1]: halve the angle twice, then the series.
double atanUnit(double x) {
  for (int i = 0; i < 2; ++i) x = x / (1 + sqrtOf(1 + x * x));  // tan(a / 2)
  const double s = x * x;
  double sum = 0;
  for (int k = 25; k >= 1; k -= 2) sum = 1.0 / k - s * sum;
  return 4 * x * sum;
}

}  // namespace

void sinCos(double x, double *sine, double *cosine) {
  const double quarters = floorOf(x * (2 / kPi) + 0.5);
  // pi/2 in two parts, so that the difference keeps its digits
  const double r = (x - quarters * 1.57079632673412561417e+00) - quarters * 6.07710050650619224932e-11;
  const double s = sinSmall(r), c = cosSmall(r);
  switch (static_cast<int64_t>(quarters) & 3) {
    case 0:
      *sine = s, *cosine = c;
      break;
    case 1:
      *sine = c, *cosine = -s;
      break;
    case 2:
      *sine = -s, *cosine = -c;
      break;
    default:
      *sine = -c, *cosine = s;
      break;
  }
}

double atan2Of(double y, double x) {
  const double ax = absOf(x), ay = absOf(y);
  if (ax == 0 && ay == 0) return 0;
  double angle = ay <= ax ? atanUnit(ay / ax) : kPi / 2 - atanUnit(ax / ay);
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

double expOf(double x) {
  // e^x = 2^n e^r, |r| <= ln2 / 2
  constexpr double kLn2High = 6.93147180369123816490e-01, kLn2Low = 1.90821492927058770002e-10;
  const double n = floorOf(x / (kLn2High + kLn2Low) + 0.5);
  const double r = (x - n * kLn2High) - n * kLn2Low;
  double sum = 1;
  for (int k = 15; k >= 1; --k) sum = 1 + sum * r / k;
  const int64_t exponent = static_cast<int64_t>(n) + 1023;
  if (exponent <= 0) return 0;
  if (exponent >= 2047) return 1.7976931348623157e308;
  const uint64_t bits = static_cast<uint64_t>(exponent) << 52;
  double scale;
  std::memcpy(&scale, &bits, sizeof scale);
  return sum * scale;
}

double logOf(double x) {
  uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  double exponent = static_cast<double>(static_cast<int64_t>((bits >> 52) & 2047) - 1023);
  bits = (bits & 0xFFFFFFFFFFFFFull) | (1023ull << 52);
  double m;
  std::memcpy(&m, &bits, sizeof m);
  if (m > 1.4142135623730951) m /= 2, exponent += 1;
  // log m = 2 artanh((m - 1) / (m + 1))
  const double t = (m - 1) / (m + 1), s = t * t;
  double sum = 0;
  for (int k = 21; k >= 1; k -= 2) sum = 1.0 / k + s * sum;
  return 2 * t * sum + exponent * 0.69314718055994530942;
}

}  // namespace sphc
