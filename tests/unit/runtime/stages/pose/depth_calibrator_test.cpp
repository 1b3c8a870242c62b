// A simulated sensor with a known bias, frame by frame.
#include "runtime/stages/pose/depth_calibrator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/stages/pose/estimator.h"
#include "tests/support/sensor_world.h"
#include "tests/unit/runtime/stages/pose/pose_test_estimator.h"

namespace sphc {
namespace {

constexpr double kCalibratedMidM = 2, kOffsetSigmaM = 0.005, kSlopeSigma = 0.02;
constexpr int kFrames = 40;

DepthCalibration belief() {
  DepthCalibration prior;
  prior.mid_m = kCalibratedMidM;
  prior.covariance.diagonal() << kOffsetSigmaM * kOffsetSigmaM, kSlopeSigma * kSlopeSigma;
  return prior;
}

DepthCalibration nothingToLearn() {
  DepthCalibration known;
  known.mid_m = kCalibratedMidM;
  return known;
}

struct Sensor {
  Vector2 bias = Vector2::Zero();
  double stated_noise = 1;
};

test::PoseWorld frameOf(const Sensor &sensor, uint64_t seed) {
  test::SensorWorldOptions options;
  options.seed = seed;
  options.true_share = 0.33;
  options.bias = sensor.bias;
  options.mid_m = kCalibratedMidM;
  options.stated_depth_noise = sensor.stated_noise;
  return test::makeSensorWorld(options);
}

// A localizer in small: each frame is found with what the frames before it taught.
class Session {
 public:
  explicit Session(const DepthCalibration &prior) { calibrator.init(prior); }

  Estimate look(const test::PoseWorld &world, uint64_t seed) {
    PoseQuery query;
    query.seed = seed;
    query.depth = calibrator.current();
    return estimator_.search(world, query);
  }
  // Camera's error, m.
  double frame(const Sensor &sensor, uint64_t seed) {
    const test::PoseWorld world = frameOf(sensor, seed);
    const Estimate estimate = look(world, seed);
    calibrator.learn(estimate);
    return test::translationErrorM(estimate.camera_from_map, world.camera_from_map);
  }
  double sigma(int unknown) const { return std::sqrt(calibrator.current().covariance(unknown, unknown)); }

  DepthCalibrator calibrator;

 private:
  test::TestEstimator estimator_{512, 20000};
};

// Errors of a session's frames from the tenth on.
std::vector<double> laterErrors(const DepthCalibration &prior, const Sensor &sensor, uint64_t first_seed) {
  Session session(prior);
  std::vector<double> errors;
  for (uint64_t i = 0; i < kFrames; ++i) {
    const double error_m = session.frame(sensor, first_seed + i);
    if (i >= 10) errors.push_back(error_m);
  }
  return errors;
}

double medianOverSessions(const DepthCalibration &prior, const Sensor &sensor) {
  std::vector<double> all;
  for (uint64_t session = 0; session < 10; ++session)
    for (double error_m : laterErrors(prior, sensor, 1 + 1000 * session)) all.push_back(error_m);
  return test::median(all);
}

TEST(DepthCalibrator, ConvergesToTheSensorsBias) {
  const Sensor sensor = {{0, 0.02}, 1};
  for (uint64_t first : {1u, 1001u, 2001u, 3001u, 4001u}) {
    Session session(belief());
    for (uint64_t i = 0; i < kFrames; ++i) session.frame(sensor, first + i);
    const Vector2 mean = session.calibrator.current().mean;
    EXPECT_NEAR(mean[1], 0.02, 2 * session.sigma(1)) << first;
    EXPECT_NEAR(mean[0], 0, 2 * session.sigma(0)) << first;
    EXPECT_NEAR(mean[1], 0.02, 0.006) << first;
    EXPECT_LT(session.sigma(1), 0.4 * kSlopeSigma);
  }
}

TEST(DepthCalibrator, MakesPosesOfABiasedSensorMoreExact) {
  const Sensor sensor = {{0, 0.02}, 1};
  const double with = medianOverSessions(belief(), sensor), without = medianOverSessions(nothingToLearn(), sensor);
  const double exact = medianOverSessions(nothingToLearn(), Sensor());
  RecordProperty("median_mm_with", std::to_string(1000 * with));
  RecordProperty("median_mm_without", std::to_string(1000 * without));
  RecordProperty("median_mm_unbiased", std::to_string(1000 * exact));
  EXPECT_LT(with, 0.8 * without);
}

TEST(DepthCalibrator, DoesNotHurtAnUnbiasedSensor) {
  const double with = medianOverSessions(belief(), Sensor()),
               without = medianOverSessions(nothingToLearn(), Sensor());
  RecordProperty("median_mm_with", std::to_string(1000 * with));
  RecordProperty("median_mm_without", std::to_string(1000 * without));
  EXPECT_LT(with, 1.05 * without);
}

TEST(DepthCalibrator, LearnsHowNoisyTheDepthIs) {
  for (double stated : {0.5, 1.0, 2.0}) {
    Session session(belief());
    double sum = 0;
    for (uint64_t i = 0; i < kFrames; ++i) {
      session.frame({Vector2::Zero(), stated}, 1 + i);
      if (i >= kFrames / 2) sum += session.calibrator.current().noise_scale / (kFrames / 2);
    }
    RecordProperty("stated_" + std::to_string(stated), std::to_string(sum));
    EXPECT_NEAR(sum * stated, 1, 0.15) << stated;
  }
}

TEST(DepthCalibrator, NoiseScaleStaysInBounds) {
  DepthCalibrator calibrator;
  calibrator.init(belief());
  Estimate estimate;
  estimate.depth = belief();
  for (double ratio : {1e6, 1e-6})
    for (int i = 0; i < 50; ++i) {
      estimate.noise_ratio = ratio;
      calibrator.learn(estimate);
      EXPECT_GE(calibrator.current().noise_scale, 0.25);
      EXPECT_LE(calibrator.current().noise_scale, 4);
    }
}

// One frame that is all wrong, at different times: how far off the slope is right after it, and 40 frames later.
struct Disturbance {
  double at_once, later, noise_scale_later;
};
Disturbance disturbedAt(uint64_t wrong_frame, const test::PoseWorld &wrong) {
  const Sensor sensor = {{0, 0.02}, 1};
  Session session(belief()), undisturbed(belief());
  Disturbance out = {};
  for (uint64_t i = 0; i <= wrong_frame + kFrames; ++i) {
    if (i == wrong_frame) {
      const double before = session.calibrator.current().mean[1];
      session.calibrator.learn(session.look(wrong, i));
      out.at_once = std::abs(session.calibrator.current().mean[1] - before);
    } else {
      session.frame(sensor, 1 + i);
      undisturbed.frame(sensor, 1 + i);
    }
  }
  const DepthCalibration &end = session.calibrator.current(), &plain = undisturbed.calibrator.current();
  out.later = std::abs(end.mean[1] - plain.mean[1]);
  out.noise_scale_later = std::abs(end.noise_scale - plain.noise_scale);
  return out;
}

void expectUnmoved(const test::PoseWorld &wrong) {
  for (uint64_t at : {0u, 3u, 20u}) {
    const Disturbance off = disturbedAt(at, wrong);
    ::testing::Test::RecordProperty("slope_after_frame_" + std::to_string(at), std::to_string(off.at_once));
    if (at > 0) {  // the first frame has nothing to be held against
      EXPECT_LT(off.at_once, 0.002) << at;
    }
    EXPECT_LT(off.later, 0.004);
    EXPECT_LT(off.noise_scale_later, 0.05);
  }
}

TEST(DepthCalibrator, AFrameOfWrongDepthsDoesNotThrowItOff) { expectUnmoved(frameOf({{0.2, -0.15}, 1}, 77)); }
TEST(DepthCalibrator, AFrameOfOtherBiasDoesNotThrowItOff) { expectUnmoved(frameOf({{-0.02, -0.06}, 1}, 77)); }
TEST(DepthCalibrator, AFrameOfFakesDoesNotThrowItOff) {
  test::SensorWorldOptions options;
  options.true_share = 0;
  expectUnmoved(test::makeSensorWorld(options));
}

// Depths that are all longer by one factor: the map cannot tell.
TEST(DepthCalibrator, ACommonScaleTeachesNothing) {
  const Sensor sensor = {{0.02 * kCalibratedMidM, 0.02}, 1};
  for (uint64_t first : {1u, 1001u, 2001u}) {
    Session session(belief());
    for (uint64_t i = 0; i < kFrames; ++i) session.frame(sensor, first + i);
    EXPECT_LT(std::abs(session.calibrator.current().mean[0]), 2 * session.sigma(0));
    EXPECT_LT(std::abs(session.calibrator.current().mean[1]), 2 * session.sigma(1));
    EXPECT_LT(std::abs(session.calibrator.current().mean[1]), 0.004);
  }
}

TEST(DepthCalibrator, NumbersThatAreNoneAreNotTakenIn) {
  DepthCalibrator calibrator;
  calibrator.init(belief());
  Estimate estimate;
  estimate.depth = belief();
  estimate.depth.mean[1] = std::nan("");
  calibrator.learn(estimate);
  EXPECT_EQ(calibrator.current().mean, belief().mean);
  estimate.depth = belief();
  estimate.depth.covariance.setZero();
  calibrator.learn(estimate);
  EXPECT_TRUE(isFinite(calibrator.current().mean.sum()));
  EXPECT_TRUE(isFinite(calibrator.current().covariance.sum()));
}

TEST(DepthCalibrator, AKnownSensorStaysAsItIs) {
  Session session(nothingToLearn());
  for (uint64_t i = 1; i <= 10; ++i) session.frame({{0, 0.02}, 1}, i);
  EXPECT_EQ(session.calibrator.current().mean.norm(), 0);
  EXPECT_TRUE(session.calibrator.current().isKnown());
}

// Never surer than it can be, nor less sure than at first, however long it looks.
TEST(DepthCalibrator, CertaintyIsBounded) {
  Session session(belief());
  for (uint64_t i = 1; i <= 300; ++i) {
    session.frame({{0, 0.02}, 1}, i);
    EXPECT_LE(session.sigma(0), kOffsetSigmaM);
    EXPECT_LE(session.sigma(1), kSlopeSigma);
    EXPECT_GT(session.sigma(1), 1e-4);
  }
}

}  // namespace
}  // namespace sphc
