// What happens to the image happens to the keypoints, and the descriptors stay.
#include <gtest/gtest.h>

#include "runtime/stages/features/mirrored_descriptor.h"
#include "tests/unit/runtime/stages/features/features_fixture.h"

namespace sphc {
namespace {

constexpr double kTurn = 2 * kPi;

double angleBetween(double a, double b) { return std::abs(std::remainder(a - b, kTurn)); }

// The keypoint of `features` nearest to the wanted place at about the wanted scale and angle; -1 if none is within
// `reach` scales.
int findNear(const Features &features, double x, double y, double scale, double angle, double reach) {
  int best = -1;
  double nearest = reach * scale;
  for (size_t i = 0; i < features.keypoints.size(); ++i) {
    const Keypoint &k = features.keypoints[i];
    const double d = std::hypot(static_cast<double>(k.x_px) - x, static_cast<double>(k.y_px) - y);
    const double ratio = static_cast<double>(k.scale_px) / scale;
    if (d >= nearest || ratio < 0.8 || ratio > 1.25) continue;
    if (angleBetween(static_cast<double>(k.orientation_rad), angle) > 0.3) continue;
    nearest = d;
    best = static_cast<int>(i);
  }
  return best;
}

// A side of 2^n + 1 keeps the same pixels in every octave when turned.
constexpr int32_t kSide = 257;

// But for rounding: rows and columns are blurred one after the other, and samples are integers.
TEST(Covariance, QuarterTurnTurnsTheKeypoints) {
  const TestImage image = spots(kSide, kSide, 11);
  TestImage turned(kSide, kSide);  // x' = side - y, y' = x: clockwise as seen, the angle grows by a quarter
  for (int32_t y = 0; y < kSide; ++y) {
    for (int32_t x = 0; x < kSide; ++x) turned.at(kSide - 1 - y, x) = image.at(x, y);
  }
  const Features a = extractFrom(image, 2000), b = extractFrom(turned, 2000);
  ASSERT_GT(a.keypoints.size(), 200u);
  EXPECT_NEAR(static_cast<double>(a.keypoints.size()), static_cast<double>(b.keypoints.size()), 3);
  size_t matched = 0, alike = 0;
  for (size_t i = 0; i < a.keypoints.size(); ++i) {
    const Keypoint &k = a.keypoints[i];
    const int j =
        findNear(b, kSide - static_cast<double>(k.y_px), static_cast<double>(k.x_px),
                 static_cast<double>(k.scale_px), static_cast<double>(k.orientation_rad) + kTurn / 4, 0.1);
    if (j < 0) continue;
    ++matched;
    alike += distance(a.descriptors[i], b.descriptors[static_cast<size_t>(j)]) < 30;
  }
  EXPECT_GE(matched, a.keypoints.size() * 90 / 100);
  EXPECT_GE(alike, matched * 97 / 100);
}

TEST(Covariance, MirroringMirrorsPlacesAndDescriptors) {
  const TestImage image = spots(kSide, kSide, 12);
  TestImage turned_over(kSide, kSide);
  for (int32_t y = 0; y < kSide; ++y) {
    for (int32_t x = 0; x < kSide; ++x) turned_over.at(kSide - 1 - x, y) = image.at(x, y);
  }
  const Features a = extractFrom(image, 2000), b = extractFrom(turned_over, 2000);
  size_t matched = 0, alike = 0;
  for (size_t i = 0; i < a.keypoints.size(); ++i) {
    const Keypoint &k = a.keypoints[i];
    const int j = findNear(b, kSide - static_cast<double>(k.x_px), static_cast<double>(k.y_px),
                           static_cast<double>(k.scale_px), kPi - static_cast<double>(k.orientation_rad), 0.02);
    if (j < 0) continue;
    ++matched;
    alike += distance(mirrored(a.descriptors[i]), b.descriptors[static_cast<size_t>(j)]) < 30;
  }
  EXPECT_GE(matched, a.keypoints.size() * 98 / 100);
  EXPECT_GE(alike, matched * 97 / 100);
}

// Nearest descriptor with the ratio test, as localization does it.
int bestMatch(const Descriptor &wanted, const Features &among) {
  double first = 1e9, second = 1e9;
  int best = -1;
  for (size_t i = 0; i < among.descriptors.size(); ++i) {
    const double d = distance(wanted, among.descriptors[i]);
    if (d < first) {
      second = first, first = d, best = static_cast<int>(i);
    } else {
      second = std::min(second, d);
    }
  }
  return first < 0.8 * second ? best : -1;
}

struct Score {
  size_t accepted = 0, right = 0;
};

template <typename Map>
Score matchThrough(const Features &a, const Features &b, const Map &map) {
  Score score;
  for (size_t i = 0; i < a.keypoints.size(); ++i) {
    const int j = bestMatch(a.descriptors[i], b);
    if (j < 0) continue;
    double x = static_cast<double>(a.keypoints[i].x_px), y = static_cast<double>(a.keypoints[i].y_px);
    map(&x, &y);
    const Keypoint &k = b.keypoints[static_cast<size_t>(j)];
    ++score.accepted;
    score.right += std::hypot(static_cast<double>(k.x_px) - x, static_cast<double>(k.y_px) - y) < 1.5;
  }
  return score;
}

TEST(Covariance, TwiceTheSizeIsRecognised) {
  const Features small = extractFrom(spots(240, 200, 5), 2000), large = extractFrom(spots(480, 400, 5, 2), 2000);
  const Score score = matchThrough(small, large, [](double *x, double *y) { *x *= 2, *y *= 2; });
  EXPECT_GE(score.accepted, small.keypoints.size() * 6 / 10);
  EXPECT_GE(score.right, score.accepted * 95 / 100);
}

TEST(Covariance, ATurnByAnyAngleIsRecognised) {
  constexpr int32_t kSize = 300;
  const TestImage image = spots(kSize, kSize, 21);
  for (const double angle : {0.3, 1.0, 2.4}) {
    const double c = std::cos(angle), s = std::sin(angle), middle = kSize / 2.0;
    const TestImage turned = draw(kSize, kSize, [&](double x, double y) {
      // where the pixel came from, by bilinear interpolation
      const double u = c * (x - middle) + s * (y - middle) + middle - 0.5;
      const double v = -s * (x - middle) + c * (y - middle) + middle - 0.5;
      const int32_t i = static_cast<int32_t>(std::floor(u)), j = static_cast<int32_t>(std::floor(v));
      if (i < 0 || j < 0 || i + 1 >= kSize || j + 1 >= kSize) return 128.0;
      const auto at = [&](int32_t a, int32_t b) {
        return static_cast<double>(image.pixels[static_cast<size_t>(b * kSize + a)]);
      };
      const double fx = u - i, fy = v - j;
      return (1 - fy) * ((1 - fx) * at(i, j) + fx * at(i + 1, j)) +
             fy * ((1 - fx) * at(i, j + 1) + fx * at(i + 1, j + 1));
    });
    const Features a = extractFrom(image, 2000), b = extractFrom(turned, 2000);
    const Score score = matchThrough(a, b, [&](double *x, double *y) {
      const double dx = *x - middle, dy = *y - middle;
      *x = c * dx - s * dy + middle;
      *y = s * dx + c * dy + middle;
    });
    EXPECT_GE(score.accepted, a.keypoints.size() / 2) << angle;
    EXPECT_GE(score.right, score.accepted * 93 / 100) << angle;
  }
}

TEST(Covariance, BrightnessAndContrastDoNotMatter) {
  const TestImage image = spots(320, 240, 31);
  TestImage dimmed(320, 240);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    dimmed.pixels[i] = static_cast<uint8_t>(20 + image.pixels[i] * 6 / 10);
  }
  const Features a = extractFrom(image, 400), b = extractFrom(dimmed, 400);
  const Score score = matchThrough(a, b, [](double *, double *) {});
  EXPECT_GE(score.accepted, a.keypoints.size() * 8 / 10);
  EXPECT_GE(score.right, score.accepted * 98 / 100);
}

}  // namespace
}  // namespace sphc
