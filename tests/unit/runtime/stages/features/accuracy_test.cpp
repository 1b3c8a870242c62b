// Places and scales of blobs with known ones.
#include <gtest/gtest.h>

#include "tests/unit/runtime/stages/features/features_fixture.h"

namespace sphc {
namespace {

// For a Gaussian blob of deviation b the difference of Gaussians at (s, k s) is largest where s = b / sqrt(k).
const double kScaleOfBlob = std::pow(2.0, -1.0 / 6);

struct Blob {
  double x, y, sigma;
};

TestImage drawBlob(const Blob &blob) {
  return draw(160, 140, [&](double x, double y) {
    const double dx = x - blob.x, dy = y - blob.y;
    return 40 + 200 * std::exp(-0.5 * (dx * dx + dy * dy) / (blob.sigma * blob.sigma));
  });
}

struct Errors {
  double mean_x = 0, mean_y = 0, worst = 0, worst_scale = 0;
};

// Blobs of one size at many places inside the pixel.
Errors measure(double sigma, int32_t first_octave) {
  Errors errors;
  FeatureConfig config = configFor(TestImage(160, 140), 50);
  config.first_octave = first_octave;
  TestExtractor extractor(config);
  Random random(7);
  constexpr int kBlobs = 64;
  for (int i = 0; i < kBlobs; ++i) {
    const Blob blob = {72 + 8 * random.uniform(), 64 + 8 * random.uniform(), sigma};
    const Features found = extractor(drawBlob(blob));
    EXPECT_FALSE(found.keypoints.empty());
    if (found.keypoints.empty()) continue;
    const Keypoint &k = found.keypoints[0];
    const double dx = static_cast<double>(k.x_px) - blob.x, dy = static_cast<double>(k.y_px) - blob.y;
    errors.mean_x += dx / kBlobs;
    errors.mean_y += dy / kBlobs;
    errors.worst = std::max(errors.worst, std::hypot(dx, dy));
    const double ratio = static_cast<double>(k.scale_px) / (sigma * kScaleOfBlob);
    errors.worst_scale = std::max(errors.worst_scale, std::abs(ratio - 1));
  }
  return errors;
}

class BlobTest : public testing::TestWithParam<double> {};

TEST_P(BlobTest, IsFoundAtItsPlaceAndScale) {
  const double bias = GetParam() < 8 ? 0.02 : 0.05;
  const Errors e = measure(GetParam(), 0);
  EXPECT_LT(std::abs(e.mean_x), bias) << "bias across";
  EXPECT_LT(std::abs(e.mean_y), bias) << "bias down";
  EXPECT_LT(e.worst, 0.05 + 0.035 * GetParam());
  EXPECT_LT(e.worst_scale, 0.06);
}

TEST_P(BlobTest, IsFoundInTheDoubledImageToo) {
  const double bias = GetParam() < 8 ? 0.02 : 0.05;
  const Errors e = measure(GetParam(), -1);
  EXPECT_LT(std::abs(e.mean_x), bias);
  EXPECT_LT(std::abs(e.mean_y), bias);
  EXPECT_LT(e.worst, 0.05 + 0.035 * GetParam());
  EXPECT_LT(e.worst_scale, 0.12);  // doubling blurs a little by itself
}

INSTANTIATE_TEST_SUITE_P(Sizes, BlobTest, testing::Values(1.6, 2.0, 2.7, 3.5, 5.0, 7.0, 10.0, 14.0));

// Dark and bright blobs alike, in one image, and nothing else.
TEST(Blobs, AreFoundOnceEach) {
  std::vector<Blob> blobs;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      blobs.push_back({40.3 + 60 * column, 35.7 + 55 * row, 2.2 + 0.25 * (5 * row + column)});
    }
  }
  const TestImage image = draw(320, 240, [&](double x, double y) {
    double shade = 128;
    for (size_t i = 0; i < blobs.size(); ++i) {
      const double dx = x - blobs[i].x, dy = y - blobs[i].y;
      shade += (i % 2 ? -90 : 90) * std::exp(-0.5 * (dx * dx + dy * dy) / (blobs[i].sigma * blobs[i].sigma));
    }
    return shade;
  });
  const Features found = extractFrom(image);
  for (const Blob &blob : blobs) {
    int near = 0;
    for (const Keypoint &k : found.keypoints) {
      const bool close =
          std::hypot(static_cast<double>(k.x_px) - blob.x, static_cast<double>(k.y_px) - blob.y) < 0.2;
      near += close && std::abs(static_cast<double>(k.scale_px) / (blob.sigma * kScaleOfBlob) - 1) < 0.1;
    }
    EXPECT_EQ(near, 1) << blob.x << ", " << blob.y << ", " << blob.sigma;
  }
}

// A blob's response follows from its height: D = h t (k^2 - 1) / ((b + t) (b + k^2 t)) b for variances b and t = b
// / k.
TEST(Blobs, RespondInProportionToTheirHeight) {
  const TestImage image = drawBlob({80, 70, 5});
  const Features found = extractFrom(image);
  ASSERT_FALSE(found.keypoints.empty());
  const double k = std::pow(2.0, 1.0 / 3), t = 1 / k;
  const double expected = 200.0 / 255 * t * (k * k - 1) / ((1 + t) * (1 + k * k * t));
  EXPECT_NEAR(static_cast<double>(found.keypoints[0].response), expected, 0.03 * expected);
}

}  // namespace
}  // namespace sphc
