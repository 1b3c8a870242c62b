#include "runtime/stages/features/row_kernels.h"

#include <cstddef>

// Highway's only part here is compiling this file once for each instruction set and choosing one.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "runtime/stages/features/row_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

// The rows written are never the rows read.
#undef SPHC_INDEPENDENT
#if defined(__clang__)
#define SPHC_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define SPHC_INDEPENDENT _Pragma("GCC ivdep")
#endif

HWY_BEFORE_NAMESPACE();
namespace sphc {
namespace HWY_NAMESPACE {

HWY_ATTR void bytesToUnit(const uint8_t *__restrict in, float *__restrict out, int32_t width) {
  for (int32_t x = 0; x < width; ++x) out[x] = static_cast<float>(in[x]) * (1.0f / 255.0f);
}

HWY_ATTR void doubleRow(const float *__restrict upper, const float *__restrict lower, float *__restrict out,
                        int32_t width) {
  for (int32_t x = 0; x + 1 < width; ++x) {
    const float here = 0.5f * (upper[x] + lower[x]), next = 0.5f * (upper[x + 1] + lower[x + 1]);
    out[2 * x] = here;
    out[2 * x + 1] = 0.5f * (here + next);
  }
  out[2 * width - 2] = out[2 * width - 1] = 0.5f * (upper[width - 1] + lower[width - 1]);
}

// The taps of distance K .. Radius, by recursion rather than a loop, so that only the loop over pixels remains for
// the compiler to vectorise.
template <int32_t K, int32_t Radius>
HWY_INLINE float addAcross(float sum, const float *weights, const float *in) {
  if constexpr (K > Radius) {
    return sum;
  } else {
    return addAcross<K + 1, Radius>(sum + weights[K] * (in[-K] + in[K]), weights, in);
  }
}
template <int32_t K, int32_t Radius>
HWY_INLINE float addDown(float sum, const float *weights, const float *const *rows, int32_t x) {
  if constexpr (K > Radius) {
    return sum;
  } else {
    return addDown<K + 1, Radius>(sum + weights[K] * (rows[Radius - K][x] + rows[Radius + K][x]), weights, rows, x);
  }
}

template <int32_t Radius>
HWY_ATTR void blurColumns(const BlurTaps &taps, float *__restrict out, int32_t width) {
  // Copies, which the compiler knows not to be written through `out`.
  const float *rows[2 * Radius + 1];
  float weights[Radius + 1];
  for (int32_t k = 0; k <= 2 * Radius; ++k) rows[k] = taps.rows[k];
  for (int32_t k = 0; k <= Radius; ++k) weights[k] = taps.weights[k];
  SPHC_INDEPENDENT
  for (int32_t x = 0; x < width; ++x) {
    out[x] = addDown<1, Radius>(weights[0] * rows[Radius][x], weights, rows, x);
  }
}

template <int32_t Radius>
HWY_ATTR void blurAlong(const float *__restrict weights, const float *__restrict in, float *__restrict out,
                        int32_t width) {
  SPHC_INDEPENDENT
  for (int32_t x = 0; x < width; ++x) {
    out[x] = addAcross<1, Radius>(weights[0] * in[x], weights, in + x);
  }
}

template <int32_t Radius>
HWY_ATTR void blurWith(const BlurTaps &taps, float *padded, float *out, int32_t width) {
  float *middle = padded + Radius;
  blurColumns<Radius>(taps, middle, width);
  for (int32_t k = 1; k <= Radius; ++k) {
    middle[-k] = middle[0];
    middle[width - 1 + k] = middle[width - 1];
  }
  blurAlong<Radius>(taps.weights, middle, out, width);
}

HWY_ATTR void blurRow(const BlurTaps &taps, float *padded, float *out, int32_t width) {
  switch (taps.radius) {
    case 1:
      return blurWith<1>(taps, padded, out, width);
    case 2:
      return blurWith<2>(taps, padded, out, width);
    case 3:
      return blurWith<3>(taps, padded, out, width);
    case 4:
      return blurWith<4>(taps, padded, out, width);
    case 5:
      return blurWith<5>(taps, padded, out, width);
    case 6:
      return blurWith<6>(taps, padded, out, width);
    default:
      return blurWith<7>(taps, padded, out, width);
  }
}

HWY_ATTR void subtractRow(const float *__restrict a, const float *__restrict b, float *__restrict out,
                          int32_t width) {
  for (int32_t x = 0; x < width; ++x) out[x] = a[x] - b[x];
}

HWY_INLINE float larger(float a, float b) { return a > b ? a : b; }
HWY_INLINE float smaller(float a, float b) { return a < b ? a : b; }

// Largest and smallest of the 3 x 3 neighbours above, beside and below in each layer's column.
HWY_ATTR void columnBounds(const DogRows &dog, float *__restrict scratch, int32_t stride, int32_t width) {
  SPHC_INDEPENDENT
  for (int32_t x = 0; x < width; ++x) {
    float high[kDogLayers], low[kDogLayers];
    for (int32_t l = 0; l < kDogLayers; ++l) {
      const float a = dog.rows[l][0][x], b = dog.rows[l][1][x], c = dog.rows[l][2][x];
      high[l] = larger(larger(a, b), c);
      low[l] = smaller(smaller(a, b), c);
    }
    for (int32_t s = 0; s < kSearchedLayers; ++s) {
      scratch[(2 * s) * stride + x] = larger(larger(high[s], high[s + 1]), high[s + 2]);
      scratch[(2 * s + 1) * stride + x] = smaller(smaller(low[s], low[s + 1]), low[s + 2]);
    }
  }
}

HWY_INLINE uint32_t isExtremum(const float *dog, const float *high, const float *low, float threshold, int32_t x) {
  const float top = larger(larger(high[x - 1], high[x]), high[x + 1]);
  const float bottom = smaller(smaller(low[x - 1], low[x]), low[x + 1]);
  const float value = dog[x];
  return static_cast<uint32_t>((value > threshold) & (value >= top)) |
         static_cast<uint32_t>((value < -threshold) & (value <= bottom));
}

HWY_ATTR void flagExtrema(const DogRows &dog, float threshold, float *scratch, int32_t stride, uint8_t *flags,
                          int32_t width) {
  columnBounds(dog, scratch, stride, width);
  const float *one = dog.rows[1][1], *two = dog.rows[2][1], *three = dog.rows[3][1];
  const float *bounds = scratch;
  flags[0] = flags[width - 1] = 0;
  SPHC_INDEPENDENT
  for (int32_t x = 1; x < width - 1; ++x) {
    const uint32_t a = isExtremum(one, bounds, bounds + stride, threshold, x);
    const uint32_t b = isExtremum(two, bounds + 2 * stride, bounds + 3 * stride, threshold, x);
    const uint32_t c = isExtremum(three, bounds + 4 * stride, bounds + 5 * stride, threshold, x);
    flags[x] = static_cast<uint8_t>(a | (b << 1) | (c << 2));
  }
}

// atan on [0, 1], in eighths of a circle, to 1e-6 of them; the polynomial of atan2Fast times 4 / pi.
HWY_INLINE float eighthsOf(float t) {
  const float s = t * t;
  float p = 0.00359517f;
  p = p * s - 0.02031696f;
  p = p * s + 0.05411891f;
  p = p * s - 0.09535296f;
  p = p * s + 0.13540637f;
  p = p * s - 0.18083489f;
  p = p * s + 0.25455493f;
  p = p * s - 0.42441041f;
  return p * s * t + t * 1.27323954f;
}

HWY_ATTR void polarGradients(const float *__restrict dx, const float *__restrict dy, float turn,
                             float *__restrict magnitude, float *__restrict angle, int32_t count) {
  const float scale = turn * 0.125f;
  for (int32_t i = 0; i < count; ++i) {
    const float x = dx[i], y = dy[i];
    const float ax = x < 0.0f ? -x : x, ay = y < 0.0f ? -y : y;
    magnitude[i] *= __builtin_sqrtf(x * x + y * y);
    const float big = larger(ax, ay), small = smaller(ax, ay);
    float a = eighthsOf(small / (big + 1e-30f));
    a = ay > ax ? 2.0f - a : a;
    a = x < 0.0f ? 4.0f - a : a;
    a = y < 0.0f ? 8.0f - a : a;
    a = a >= 8.0f ? 0.0f : a;
    angle[i] = a * scale;
  }
}

HWY_ATTR void grayRow(const uint8_t *__restrict rgb, bool red_first, uint8_t *__restrict gray, int32_t width) {
  const uint32_t first = red_first ? 77 : 29, last = red_first ? 29 : 77;
  for (int32_t x = 0; x < width; ++x) {
    gray[x] =
        static_cast<uint8_t>((first * rgb[3 * x] + 150u * rgb[3 * x + 1] + last * rgb[3 * x + 2] + 128u) >> 8);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sphc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sphc {

HWY_EXPORT(bytesToUnit);
HWY_EXPORT(doubleRow);
HWY_EXPORT(blurRow);
HWY_EXPORT(subtractRow);
HWY_EXPORT(flagExtrema);
HWY_EXPORT(polarGradients);
HWY_EXPORT(grayRow);

void bytesToUnit(const uint8_t *in, float *out, int32_t width) {
  HWY_DYNAMIC_DISPATCH(bytesToUnit)(in, out, width);
}
void doubleRow(const float *upper, const float *lower, float *out, int32_t width) {
  HWY_DYNAMIC_DISPATCH(doubleRow)(upper, lower, out, width);
}
void blurRow(const BlurTaps &taps, float *padded, float *out, int32_t width) {
  HWY_DYNAMIC_DISPATCH(blurRow)(taps, padded, out, width);
}
void subtractRow(const float *a, const float *b, float *out, int32_t width) {
  HWY_DYNAMIC_DISPATCH(subtractRow)(a, b, out, width);
}
void flagExtrema(const DogRows &dog, float threshold, float *scratch, int32_t stride, uint8_t *flags,
                 int32_t width) {
  HWY_DYNAMIC_DISPATCH(flagExtrema)(dog, threshold, scratch, stride, flags, width);
}
void polarGradients(const float *dx, const float *dy, float turn, float *magnitude, float *angle, int32_t count) {
  HWY_DYNAMIC_DISPATCH(polarGradients)(dx, dy, turn, magnitude, angle, count);
}
void grayRow(const uint8_t *rgb, bool red_first, uint8_t *gray, int32_t width) {
  HWY_DYNAMIC_DISPATCH(grayRow)(rgb, red_first, gray, width);
}

}  // namespace sphc
#endif  // HWY_ONCE
