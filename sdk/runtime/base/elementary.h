// Elementary functions of our own: the same bits on every machine, which libm does not promise.
// Built from + - * / and sqrt, which IEEE 754 rounds correctly.
#pragma once
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>

static_assert(FLT_EVAL_METHOD == 0,
              "floats are kept with more digits than they have: on x86, compile with -msse2 -mfpmath=sse");
#ifdef __FAST_MATH__
#error "-ffast-math computes other numbers on every machine"
#endif

namespace sphc {

constexpr double kPi = 3.14159265358979323846;

inline double sqrtOf(double x) { return __builtin_sqrt(x); }
inline float sqrtOf(float x) { return __builtin_sqrtf(x); }
template <typename T>
T absOf(T x) {
  return x < T(0) ? -x : x;
}
inline double hypotOf(double a, double b) { return sqrtOf(a * a + b * b); }
inline bool isFinite(double x) { return absOf(x) <= 1.7976931348623157e308; }  // false for NaN too

// Largest integer <= x, for |x| < 2^62.
inline double floorOf(double x) {
  const double truncated = static_cast<double>(static_cast<int64_t>(x));
  return truncated > x ? truncated - 1 : truncated;
}
inline int32_t floorToInt(float x) {
  const int32_t truncated = static_cast<int32_t>(x);
  return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

// sin and cos to 1e-15 for |x| < 1e6.
void sinCos(double x, double *sine, double *cosine);
// Angle of (x, y) in (-pi, pi], to 1e-15; 0 at the origin.
double atan2Of(double y, double x);
// e^x to 1e-14 relative, for |x| < 700.
double expOf(double x);
// Natural logarithm of x > 0, to 1e-14.
double logOf(double x);

}  // namespace sphc
