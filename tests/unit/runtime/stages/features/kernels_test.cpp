// Each kernel against its scalar version, bit for bit, and against what it is said to compute.
#include "runtime/stages/features/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "runtime/base/random.h"
#include "runtime/stages/features/descriptor.h"

namespace sphc {
namespace {

// A plane of random samples over the whole range, with a margin for reads of whole vectors.
struct TestPlane {
  int32_t width, height, stride;
  std::vector<int16_t> storage;
  int16_t *data;

  TestPlane(int32_t w, int32_t h, uint64_t seed, int32_t range = 65536)
      : width(w), height(h), stride(paddedWidth(w)), storage(static_cast<size_t>(stride * h + 4 * kRowStep)) {
    const auto address = reinterpret_cast<uintptr_t>(storage.data());
    data = storage.data() + (64 - address % 64) % 64 / sizeof(int16_t);
    Random random(seed);
    for (int32_t i = 0; i < stride * h; ++i) {
      const int32_t value = static_cast<int32_t>(random.below(static_cast<uint32_t>(range))) - range / 2;
      data[i] = static_cast<int16_t>(value);
    }
  }
  int16_t *row(int32_t y) { return data + y * stride; }
};

// As levels are: no difference overflows.
constexpr int32_t kLevelRange = 2 * kGrayMiddle * kSampleScale;

std::vector<int16_t> blurred(const FeatureKernels &kernels, TestPlane &in, int32_t radius, int32_t count) {
  TestPlane padded(kRowsAtOnce * (in.stride + 2 * kRowStep), 1, 1), out(in.width, kRowsAtOnce, 2),
      difference(in.width, kRowsAtOnce, 3);
  BlurTask task = {};
  task.radius = radius;
  task.width = in.width;
  task.count = count;
  task.padded = padded.data;
  int32_t middle = kOneQ15;
  for (int32_t k = 1; k <= radius; ++k) {
    task.weights[k] = static_cast<int16_t>(8000 / (k + 1) / radius + 1);
    middle -= 2 * task.weights[k];
  }
  task.weights[0] = static_cast<int16_t>(middle);
  for (int32_t k = 0; k < 2 * radius + count; ++k) task.rows[k] = in.row(k);
  for (int32_t i = 0; i < count; ++i) {
    task.out[i] = out.row(i);
    task.difference[i] = difference.row(i);
  }
  kernels.blur_rows(task);
  std::vector<int16_t> result;
  for (int32_t i = 0; i < count; ++i) {
    for (int32_t x = 0; x < in.width; ++x) {
      double exact = 0;
      for (int32_t k = -radius; k <= radius; ++k) {
        const int32_t at = std::min(std::max(x + k, 0), in.width - 1);
        double down = 0;
        for (int32_t j = -radius; j <= radius; ++j) {
          down += task.weights[std::abs(j)] * static_cast<double>(in.row(radius + i + j)[at]) / kOneQ15;
        }
        exact += task.weights[std::abs(k)] * down / kOneQ15;
      }
      // half a sample a product down, half a sample across
      EXPECT_NEAR(out.row(i)[x], exact, 0.5 * (radius + 1) + 0.5) << x;
      EXPECT_EQ(difference.row(i)[x], static_cast<int16_t>(out.row(i)[x] - in.row(radius + i)[x]));
      result.push_back(out.row(i)[x]);
    }
  }
  return result;
}

TEST(FeatureKernels, BlurIsTheWeightedSum) {
  for (const int32_t width : {8, 31, 64, 97}) {
    for (int32_t radius = 1; radius <= kMaxBlurRadius; ++radius) {
      for (const int32_t count : {1, 2}) {
        TestPlane in(width, 2 * radius + count, 7, kLevelRange);
        EXPECT_EQ(blurred(simdFeatureKernels(), in, radius, count),
                  blurred(scalarFeatureKernels(), in, radius, count));
      }
    }
  }
}

// The definition, neighbour by neighbour.
bool isExtremum(const DogRows &dog, int32_t threshold, int32_t x) {
  const int32_t value = dog.rows[1][1][x];
  if (std::abs(value) <= threshold) return false;
  for (int32_t i = 0; i < 27; ++i) {
    if (i == 13) continue;
    const int32_t other = dog.rows[i / 9][i / 3 % 3][x + i % 3 - 1];
    const int32_t above = value > 0 ? value - other : other - value;
    if (i < 13 ? above <= 0 : above < 0) return false;
  }
  return true;
}

TEST(FeatureKernels, ExtremaAreThoseOfTheDefinition) {
  size_t all = 0;
  for (const int32_t width : {17, 40, 75, 210}) {
    for (const int32_t range : {4, 9, 65536}) {  // small ranges make equal neighbours
      TestPlane layers[3] = {{width, 3, 1, range}, {width, 3, 2, range}, {width, 3, 3, range}};
      DogRows dog;
      for (int32_t k = 0; k < 3; ++k) {
        for (int32_t j = 0; j < 3; ++j) dog.rows[k][j] = layers[k].row(j);
      }
      std::vector<uint16_t> expected;
      for (int32_t x = 5; x < width - 5; ++x) {
        if (isExtremum(dog, 1, x)) expected.push_back(static_cast<uint16_t>(x));
      }
      all += expected.size();
      for (const FeatureKernels *kernels : {&simdFeatureKernels(), &scalarFeatureKernels()}) {
        std::vector<uint16_t> found(static_cast<size_t>(width));
        found.resize(kernels->find_extrema(dog, 1, 5, width - 5, found.data()));
        EXPECT_EQ(found, expected) << width << ", " << range;
      }
    }
  }
  EXPECT_GT(all, 30u);
}

TEST(FeatureKernels, OrientationHistogramsAgree) {
  TestPlane plane(64, 40, 4, kLevelRange);
  for (int32_t side = 3; side <= kWindowSide; ++side) {
    OrientationWindow window = {};
    window.pixels = plane.row(10) + 7;
    window.stride = plane.stride;
    window.columns = window.rows = side;
    for (int32_t i = 0; i < side; ++i) window.across[i] = window.down[i] = 1.0f / static_cast<float>(1 + i);
    float fast[kOrientationBins], plain[kOrientationBins];
    simdFeatureKernels().orientation_histogram(window, fast);
    scalarFeatureKernels().orientation_histogram(window, plain);
    EXPECT_EQ(std::memcmp(fast, plain, sizeof fast), 0) << side;
  }
}

TEST(FeatureKernels, OrientationOfASlopeIsItsDirection) {
  for (int32_t degrees = -170; degrees <= 180; degrees += 10) {
    TestPlane plane(40, 40, 1);
    const double angle = degrees * 3.14159265358979 / 180;
    for (int32_t y = 0; y < 40; ++y) {
      for (int32_t x = 0; x < 40; ++x) {
        plane.row(y)[x] = static_cast<int16_t>(std::lround(300 * (std::cos(angle) * x + std::sin(angle) * y)));
      }
    }
    OrientationWindow window = {};
    window.pixels = plane.row(10) + 10;
    window.stride = plane.stride;
    window.columns = window.rows = kWindowSide;
    for (int32_t i = 0; i < kWindowSide; ++i) window.across[i] = window.down[i] = 1.0f;
    float histogram[kOrientationBins];
    simdFeatureKernels().orientation_histogram(window, histogram);
    const float all = kWindowSide * kWindowSide * 600.0f;
    EXPECT_NEAR(histogram[(degrees / 10 + kOrientationBins) % kOrientationBins], all, 0.01f * all) << degrees;
  }
}

TEST(FeatureKernels, DescriptorsAgree) {
  PatchWindow window;
  Random random(9);
  for (auto &row : window.weights) {
    for (int16_t &weight : row) weight = static_cast<int16_t>(random.below(kOneQ15));
    row[kPatchSide - 1] = 0;
  }
  // Faint and strong images; patches inside, at the edges and beyond them.
  for (const int32_t range : {64, 2000, kLevelRange}) {
    TestPlane plane(90, 70, 5, range);
    for (int32_t i = 0; i < 200; ++i) {
      const double angle = random.uniform() * 6.28, step = 0.8 + 2 * random.uniform();
      PatchTask task = {plane.data, plane.stride, plane.width, plane.height, 0, 0, 0, 0};
      task.x = static_cast<int32_t>(random.below(100 * 65536)) - 5 * 65536;
      task.y = static_cast<int32_t>(random.below(80 * 65536)) - 5 * 65536;
      task.c = static_cast<int32_t>(std::cos(angle) * step * 65536);
      task.s = static_cast<int32_t>(std::sin(angle) * step * 65536);
      Descriptor fast, plain;
      simdFeatureKernels().describe(task, window, &fast);
      scalarFeatureKernels().describe(task, window, &plain);
      ASSERT_EQ(std::memcmp(fast.bytes, plain.bytes, kDescriptorBytes), 0) << range << ", " << i;
    }
  }
}

// On a slope all gradients point one way: all weight lies in that direction's bins.
TEST(FeatureKernels, DescriptorsOfASlopePointItsWay) {
  PatchWindow window;
  for (auto &row : window.weights) {
    std::fill(row, row + kGradientSide, int16_t{30000});
    row[kPatchSide - 1] = 0;
  }
  for (int32_t direction = 0; direction < 8; ++direction) {
    TestPlane plane(40, 40, 1);
    const double angle = direction * 3.14159265358979 / 4;
    for (int32_t y = 0; y < 40; ++y) {
      for (int32_t x = 0; x < 40; ++x) {
        plane.row(y)[x] = static_cast<int16_t>(std::lround(200 * (std::cos(angle) * x + std::sin(angle) * y)));
      }
    }
    const PatchTask task = {plane.data, plane.stride, 40, 40, 10 * 65536, 10 * 65536, 65536, 0};
    Descriptor found;
    simdFeatureKernels().describe(task, window, &found);
    for (int32_t i = 0; i < 128; ++i) {
      if (i % 8 == direction) {
        EXPECT_NEAR(found.bytes[i], 128, 12) << direction << ", " << i;
      } else {
        EXPECT_LE(found.bytes[i], 12) << direction << ", " << i;
      }
    }
  }
}

TEST(FeatureKernels, GrayRowsAgree) {
  Random random(2);
  for (const int32_t width : {1, 15, 16, 17, 33, 640}) {
    std::vector<uint8_t> color(static_cast<size_t>(4 * width)), fast(static_cast<size_t>(width)), plain = fast;
    for (uint8_t &byte : color) byte = static_cast<uint8_t>(random.below(256));
    for (const int32_t pixel_bytes : {3, 4}) {
      for (const bool red_first : {false, true}) {
        simdFeatureKernels().gray_row(color.data(), pixel_bytes, red_first, fast.data(), width);
        scalarFeatureKernels().gray_row(color.data(), pixel_bytes, red_first, plain.data(), width);
        EXPECT_EQ(fast, plain);
      }
    }
  }
}

}  // namespace
}  // namespace sphc
