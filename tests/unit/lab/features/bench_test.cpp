#include <gtest/gtest.h>

#include <cmath>

#include "lab/features/table.h"
#include "lab/features/verify.h"
#include "runtime/base/random.h"

namespace sphc::host {
namespace {

FeaturesVariant bytesVariant(uint32_t bytes, bool binary) { return {"test", bytes, binary, nullptr, ""}; }

FoundFeatures featuresOf(std::vector<uint8_t> descriptors, size_t count) {
  FoundFeatures found;
  found.pixels_px.resize(count, Vector2::Zero());
  found.descriptors = std::move(descriptors);
  return found;
}

TEST(FeaturesVerify, TheRatioIsOfDistancesNotOfSquares) {
  const FoundFeatures a = featuresOf({0, 0}, 1);
  // at 7 and 10: 0.7; at 9 and 10: 0.9
  EXPECT_EQ(matchByRatio(bytesVariant(2, false), a, featuresOf({0, 10, 7, 0}, 2), 0.8).size(), 1u);
  EXPECT_EQ(matchByRatio(bytesVariant(2, false), a, featuresOf({0, 10, 7, 0}, 2), 0.8)[0].second, 1u);
  EXPECT_TRUE(matchByRatio(bytesVariant(2, false), a, featuresOf({0, 10, 9, 0}, 2), 0.8).empty());
}

TEST(FeaturesVerify, BinaryDescriptorsAreComparedBitByBit) {
  const FoundFeatures a = featuresOf({0, 0}, 1);
  EXPECT_EQ(matchByRatio(bytesVariant(2, true), a, featuresOf({0x80, 0, 0x07, 0}, 2), 0.8)[0].second, 0u);
  EXPECT_TRUE(matchByRatio(bytesVariant(2, true), a, featuresOf({0x80, 0, 0x01, 0}, 2), 0.8).empty());
}

sphc_camera pinhole() {
  sphc_camera camera = {};
  camera.model = SPHC_CAMERA_PINHOLE;
  camera.width = 640;
  camera.height = 480;
  camera.param_count = 4;
  camera.params[0] = camera.params[1] = 500;
  camera.params[2] = 320;
  camera.params[3] = 240;
  return camera;
}

// Points seen from two places; `shift_px` moves the second image's pixels across the epipolar lines.
std::vector<double> errorsOf(double shift_px) {
  const Camera camera(pinhole());
  Rigid b_from_a;
  b_from_a.translation_m = {-0.3, 0, 0};  // lines are rows
  FoundFeatures a, b;
  std::vector<FeatureMatch> matches;
  Random random(3);
  for (uint32_t i = 0; i < 20; ++i) {
    const Vector3 point(random.uniform() - 0.5, random.uniform() - 0.5, 2 + random.uniform());
    Vector2 in_a, in_b;
    EXPECT_TRUE(camera.project(point, &in_a) && camera.project(b_from_a * point, &in_b));
    a.pixels_px.push_back(in_a);
    b.pixels_px.push_back(in_b + Vector2(0, shift_px));
    matches.push_back({i, i});
  }
  const auto errors = sampsonErrors(camera, b_from_a, a, b, matches);
  EXPECT_EQ(errors.size(), 20u);
  return errors;
}

TEST(FeaturesVerify, SampsonErrorIsInPixels) {
  for (const double error : errorsOf(0)) EXPECT_NEAR(error, 0, 1e-9);
  // Half of the distance in each image: their root sum of squares.
  for (const double error : errorsOf(3)) EXPECT_NEAR(error, 3 / std::sqrt(2.0), 1e-6);
}

GrayRecording flatRecording(size_t frames) {
  GrayRecording recording = {Camera(pinhole()), {}};
  recording.frames.resize(frames);
  for (size_t i = 0; i < frames; ++i) {
    GrayFrame &frame = recording.frames[i];
    frame.pixels.assign(640 * 480, static_cast<uint8_t>(i));
    frame.has_pose = i != 3;
    frame.world_from_camera.translation_m = {0.1 * static_cast<double>(i), 0, 0};
  }
  return recording;
}

// Two features that stay in their rows, and one that does not.
FoundFeatures drawn(const GrayView &image, double seconds) {
  const double frame = image.data[0];
  FoundFeatures found = featuresOf({0, 0, 100, 0, 0, 200}, 3);
  found.pixels_px = {{400 - frame, 100}, {300 - frame, 200}, {200 - frame, 100 + 9 * frame}};
  found.seconds = seconds;
  return found;
}

TEST(FeaturesBench, CountsMatchesThatThePosesConfirm) {
  const std::vector<FeaturesVariant> variants = {
      {kOpenCvSiftName, 2, false, [](const GrayView &image) { return drawn(image, 0.06); }, ""},
      {"fast", 2, false, [](const GrayView &image) { return drawn(image, 0.003); }, ""},
      {"absent", 2, false, nullptr, "install it"}};
  FeaturesOptions options;
  options.every = 1;
  uint32_t shown = 0;
  const auto summaries =
      runFeaturesBench(flatRecording(24), variants, options, [&](uint32_t done, uint32_t) { shown = done; });
  EXPECT_EQ(shown, 24u);
  ASSERT_EQ(summaries.size(), 2u);
  const FeaturesSummary &fast = summaries[1];
  EXPECT_DOUBLE_EQ(fast.keypoints, 3);
  EXPECT_NEAR(fast.median_ms, 3, 1e-9);
  EXPECT_NEAR(fast.times_faster_than_opencv, 20, 1e-9);
  EXPECT_EQ(fast.gaps[0].pairs, 15u);  // of 16, one without a pose
  EXPECT_EQ(fast.gaps[1].pairs, 3u);
  for (const PairQuality &quality : fast.gaps) {
    EXPECT_DOUBLE_EQ(quality.matches, 3);
    EXPECT_DOUBLE_EQ(quality.verified, 2);
    EXPECT_NEAR(quality.sampson_px, 0, 1e-9);
  }
}

TEST(FeaturesBench, TheLedgerHasNoMilliseconds) {
  FeaturesSummary summary;
  summary.name = "ours 800, scalar";
  summary.keypoints = 800;
  summary.median_ms = 4.321;
  summary.times_faster_than_opencv = 15.0;
  summary.gaps[0] = {10, 300.0, 250.0, 0.4};
  const std::string results = featuresResults({{"kitchen", 180, {summary}}});
  EXPECT_NE(results.find("kitchen,\"ours 800, scalar\",800,15.0,300.0,250.0,0.400,"), std::string::npos) << results;
  EXPECT_EQ(results.find("4.3"), std::string::npos);
  EXPECT_NE(featuresText({"kitchen", 180, {summary}}).find("4.32"), std::string::npos);
  EXPECT_EQ(featuresJson({{"kitchen", 180, {summary}}})[0]["variants"][0]["gaps"][0]["pairs"], 10);
}

TEST(FeaturesBench, RootSiftHasItsLength) {
  std::vector<float> histogram(128, 0.0f);
  histogram[5] = 3;
  histogram[7] = 1;
  std::vector<uint8_t> bytes;
  appendRootSift(histogram.data(), &bytes);
  ASSERT_EQ(bytes.size(), 128u);
  EXPECT_EQ(bytes[5], 255);  // 443, at most
  EXPECT_EQ(bytes[7], 255);  // 256, at most
  EXPECT_EQ(bytes[0], 0);
}

TEST(FeaturesBench, OursFindTheSameWithAndWithoutSimd) {
  std::vector<uint8_t> pixels(160 * 120);
  Random random(4);
  for (uint8_t &pixel : pixels) pixel = static_cast<uint8_t>(random.below(256));
  const auto variants = ourFeatures(160, 120);
  ASSERT_EQ(variants.size(), 3u);
  const GrayView image = {pixels.data(), 160, 120, 160};
  const FoundFeatures fast = variants[0].run(image), plain = variants[2].run(image);
  EXPECT_GT(fast.pixels_px.size(), 20u);
  EXPECT_EQ(fast.descriptors, plain.descriptors);
  EXPECT_GT(fast.seconds, 0);
}

}  // namespace
}  // namespace sphc::host
