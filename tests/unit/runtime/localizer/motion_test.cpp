#include "runtime/localizer/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/localizer/tracker.h"
#include "tests/support/dense_matrix.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

constexpr int64_t kMotionFrame = 33333333, kMotionSecond = 1000000000, kStart = 5 * kMotionSecond;
const Vector3 kTurn(0.3, -0.8, 0.2), kVelocity(0.4, -0.1, 0.3);  // rad/s in the camera, m/s in the map

// A camera that turns steadily while its centre goes in a straight line.
Rigid steady(double time_s) {
  const Matrix3 rotation = rotationFromVector(time_s * kTurn) * rotationFromVector(Vector3(1, 2, -0.5));
  return {rotation, -(rotation * Vector3(Vector3(0.2, 0.1, -0.3) + time_s * kVelocity))};
}

Motion steadyMotion() {
  Motion motion;
  motion.map = 3;
  motion.pose_time_ns = motion.time_ns = kStart;
  motion.camera_from_map = steady(0);
  motion.covariance = diagonalOf(0.002, 0.003);
  const Rigid before = steady(-1e-9 * kMotionFrame), now = steady(0);
  motion.step = {1e-9 * kMotionFrame, -(now.rotation.transpose() * (1e-9 * kMotionFrame * kTurn)),
                 now.inverse().translation_m - before.inverse().translation_m, diagonalOf(0.001, 0.002), 0};
  return motion;
}

double centreOffM(const Rigid &a, const Rigid &b) {
  return (a.inverse().translation_m - b.inverse().translation_m).norm();
}
double turnOffRad(const Rigid &a, const Rigid &b) { return rotationAngle(a.rotation * b.rotation.transpose()); }

double sigma(const Matrix6 &covariance, int i) { return std::sqrt(covariance(i, i)); }

TEST(Motion, GoesOnAsItWas) {
  for (const int64_t ahead_ns :
       {-kMotionFrame, int64_t{-9000000}, int64_t{0}, int64_t{11000000}, 3 * kMotionFrame, kMotionSecond}) {
    MovedPose moved;
    ASSERT_TRUE(moveTo(kStart + ahead_ns, steadyMotion(), &moved)) << ahead_ns;
    const Rigid truth = steady(1e-9 * static_cast<double>(ahead_ns));
    EXPECT_LT(centreOffM(moved.camera_from_map, truth), 1e-9) << ahead_ns;
    EXPECT_LT(turnOffRad(moved.camera_from_map, truth), 1e-8) << ahead_ns;
    EXPECT_EQ(moved.map, 3u);
    EXPECT_EQ(moved.pose_time_ns, kStart);
  }
}

TEST(Motion, VelocitiesAreThoseOfTheCameraInTheMap) {
  const double little_s = 1e-4;
  MovedPose moved;
  ASSERT_TRUE(moveTo(kStart + 20000000, steadyMotion(), &moved));
  const Rigid map_from_camera = steady(0.02).inverse(), later = steady(0.02 + little_s).inverse();
  const Vector3 velocity = (later.translation_m - map_from_camera.translation_m) / little_s;
  EXPECT_LT((moved.velocity_in_map_m_s - velocity).norm(), 1e-6);
  const Matrix3 turned = rotationFromVector(little_s * moved.angular_velocity_in_map_rad_s);
  EXPECT_LT(rotationAngle(turned * map_from_camera.rotation * later.rotation.transpose()), 1e-9);
}

TEST(Motion, AtTheTimeOfThePoseItIsThePose) {
  const Motion motion = steadyMotion();
  MovedPose moved;
  ASSERT_TRUE(moveTo(kStart, motion, &moved));
  EXPECT_LT((moved.covariance - motion.covariance).norm(), 1e-15);
}

TEST(Motion, ErrorsGrowWithTheTimeFromThePose) {
  Motion motion = steadyMotion(), unknown = motion;
  unknown.step = {};
  double before_turn = 0.002, before_shift = 0.003;
  for (int64_t ahead_ns = kMotionFrame / 4; ahead_ns <= kMotionSecond; ahead_ns *= 2) {
    MovedPose moved, without;
    ASSERT_TRUE(moveTo(kStart + ahead_ns, motion, &moved) && moveTo(kStart + ahead_ns, unknown, &without));
    EXPECT_LT((moved.covariance - moved.covariance.transpose()).norm(), 1e-18);
    for (int i = 0; i < 3; ++i) {
      EXPECT_GT(sigma(moved.covariance, i), before_turn);
      EXPECT_GT(sigma(moved.covariance, i + 3), before_shift);
      if (ahead_ns > 2 * kMotionFrame) continue;
      EXPECT_GT(sigma(without.covariance, i), sigma(moved.covariance, i));
      EXPECT_GT(sigma(without.covariance, i + 3), sigma(moved.covariance, i + 3));
    }
    before_turn = sigma(moved.covariance, 0), before_shift = sigma(moved.covariance, 3);
    EXPECT_EQ(without.velocity_in_map_m_s, Vector3::Zero());
    EXPECT_GT(without.velocity_sigma_m_s, 0.5);
    EXPECT_GT(without.angular_velocity_sigma_rad_s, 0.5);
  }
}

// Between two poses less is unknown than at either.
TEST(Motion, BetweenTwoPosesTheirErrorsMeanOut) {
  Motion motion = steadyMotion();
  motion.step.covariance = 2 * motion.covariance;
  motion.step.share_in_pose = 0.5;
  MovedPose between, ahead;
  ASSERT_TRUE(moveTo(kStart - kMotionFrame / 2, motion, &between));
  EXPECT_LT(sigma(between.covariance, 0), 0.002);
  EXPECT_LT(sigma(between.covariance, 3), 0.003);
  ASSERT_TRUE(moveTo(kStart + kMotionFrame, motion, &ahead));
  EXPECT_GT(sigma(ahead.covariance, 3), 0.003 * std::sqrt(5.0));  // of 2 a - b
}

// Turn and shift of a pose go together, and the two rates are known as well as their steps were.
TEST(Motion, BetweenTwoPosesACovarianceIsLeft) {
  Matrix6 covariance = diagonalOf(0.0005, 0.01);
  covariance(1, 3) = covariance(3, 1) = 0.99 * 0.0005 * 0.01;
  for (const int64_t frame_ns : {kMotionFrame / 3, kMotionFrame}) {
    Trail trail;
    Motion motion = steadyMotion();
    for (int i = -4; i <= 0; ++i)
      trail.add(kStart + i * frame_ns, steady(1e-9 * static_cast<double>(i * frame_ns)), covariance);
    motion.covariance = covariance;
    motion.step = trail.step(4);
    for (const double part : {0.25, 0.5, 0.75}) {
      MovedPose between;
      ASSERT_TRUE(moveTo(kStart - static_cast<int64_t>(part * static_cast<double>(frame_ns)), motion, &between));
      const Matrix6 correlation = between.covariance.diagonal().cwiseSqrt().cwiseInverse().asDiagonal() *
                                  between.covariance *
                                  between.covariance.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
      EXPECT_GT(test::leastEigenvalue(correlation), 1e-4) << frame_ns << " " << part;
    }
  }
}

TEST(Motion, EndsASecondAfterThePoseAndATenthBeforeTheFrame) {
  Motion motion = steadyMotion();
  motion.pose_time_ns -= kMotionSecond / 2;  // odometry has led to here
  MovedPose moved;
  EXPECT_TRUE(moveTo(kStart + kMotionSecond / 2, motion, &moved));
  EXPECT_FALSE(moveTo(kStart + kMotionSecond / 2 + 1, motion, &moved));
  EXPECT_TRUE(moveTo(kStart - kMotionSecond / 10, motion, &moved));
  EXPECT_FALSE(moveTo(kStart - kMotionSecond / 10 - 1, motion, &moved));
  motion.pose_time_ns = kStart - 2 * kMotionSecond;
  EXPECT_FALSE(moveTo(kStart - kMotionSecond / 10, motion, &moved));
}

TEST(Motion, TimesMayLieAnywhere) {
  constexpr int64_t kFirst = std::numeric_limits<int64_t>::min(), kLast = std::numeric_limits<int64_t>::max();
  Motion motion = steadyMotion();
  MovedPose moved;
  for (const int64_t pose_ns : {kFirst, int64_t{-1}, int64_t{0}, kLast}) {
    motion.pose_time_ns = motion.time_ns = pose_ns;
    for (const int64_t time_ns : {kFirst, int64_t{-1}, int64_t{0}, kLast}) {
      const bool near = pose_ns == time_ns || (pose_ns == -1 && time_ns == 0) || (pose_ns == 0 && time_ns == -1);
      EXPECT_EQ(moveTo(time_ns, motion, &moved), near) << pose_ns << " " << time_ns;
    }
  }
}

TEST(Rate, AStepCountsAsMuchAsItsErrorAllows) {
  const Vector3 steady(0.5, -0.2, 0.1);
  Rate exact, noisy;
  exact.variance = noisy.variance = 0.49;
  exact.add(steady, 1e-6, 0);
  EXPECT_LT((exact.a_second - steady).norm(), 1e-5);
  EXPECT_NEAR(exact.gain, 1, 1e-5);
  EXPECT_NEAR(exact.variance, 1e-6, 1e-10);
  double last_gain = 1;
  for (int i = 0; i < 50; ++i) {
    noisy.add(steady + Vector3::Constant(i % 2 ? 0.3 : -0.3), 0.09, 0);
    EXPECT_LT(noisy.gain, last_gain);
    last_gain = noisy.gain;
  }
  EXPECT_LT((noisy.a_second - steady).norm(), 0.03);
  EXPECT_NEAR(noisy.variance, 0.09 / 50, 1e-4);
  noisy.add(Vector3::Zero(), 0.09, 100);  // what was known is outdated
  EXPECT_GT(noisy.gain, 0.99);
  EXPECT_LT(noisy.a_second.norm(), 0.01);
}

// T exp(xi) = exp(Ad xi) T.
// A step from a vague pose to an exact one, or the other way round, says as little of the rate.
TEST(Trail, AStepIsAsVagueAsItsVaguerPose) {
  const auto wayOf = [](double from_m, double to_m) {
    Trail trail;
    trail.add(kStart, steady(0), diagonalOf(0.001, from_m));
    trail.add(kStart + kMotionFrame, steady(1e-9 * kMotionFrame), diagonalOf(0.001, to_m));
    return trail.step(1).way_in_map_m.norm();
  };
  const double whole_m = kVelocity.norm() * 1e-9 * kMotionFrame;
  EXPECT_NEAR(wayOf(1e-4, 1e-4), whole_m, 0.01 * whole_m);
  EXPECT_LT(wayOf(0.1, 1e-4), 0.1 * whole_m);
  EXPECT_NEAR(wayOf(1e-4, 0.1), wayOf(0.1, 1e-4), 1e-9);
}

TEST(Motion, CovarianceIsCarriedAlong) {
  Random random(1);
  const auto small = [](const Vector6 &xi) { return Rigid{rotationFromVector(xi.head<3>()), xi.tail<3>()}; };
  const Rigid now_from_before = {test::randomRotation(&random), Vector3(0.5, -2, 1)};
  Vector6 xi;
  xi << 1e-6 * test::normalVector(&random), 1e-6 * test::normalVector(&random);
  const Rigid moved = now_from_before * small(xi) * now_from_before.inverse();
  Vector6 moved_xi;
  moved_xi << vectorFromRotation(moved.rotation), moved.translation_m;
  const Matrix6 expected = moved_xi * moved_xi.transpose();
  EXPECT_LT((carried(xi * xi.transpose(), now_from_before) - expected).norm(), 1e-5 * expected.norm());
}

// ---- are the stated errors those that are made? ----

// A head that walks, nods and looks around: accelerations of 1.3 m/s^2 and 2.6 rad/s^2 an axis, RMS.
class Head {
 public:
  explicit Head(uint64_t seed) : random_(seed) {
    for (Wave &wave : waves_) {
      wave.hz = test::uniformIn(&random_, 0.3, 1.4);
      wave.phase = test::uniformIn(&random_, 0, 2 * kPi);
      const double square = 4 * kPi * kPi * wave.hz * wave.hz;
      wave.way_m = 1.3 / square * test::normalVector(&random_);
      wave.turn_rad = 2.6 / square * test::normalVector(&random_);
    }
  }
  Rigid cameraFromMap(double time_s) const {
    Vector3 centre(0, 0, 0), turn(0, 0, 0);
    for (const Wave &wave : waves_) {
      const double sine = std::sin(2 * kPi * wave.hz * time_s + wave.phase);
      centre += sine * wave.way_m, turn += sine * wave.turn_rad;
    }
    const Matrix3 rotation = rotationFromVector(turn);
    return {rotation, -(rotation * centre)};
  }

 private:
  struct Wave {
    double hz, phase;
    Vector3 way_m, turn_rad;
  };
  Random random_;
  Wave waves_[2];
};

Vector6 errorOf(const Rigid &found, const Rigid &truth) {  // truth = exp(xi) found
  const Rigid off = truth * found.inverse();
  Vector6 xi;
  xi << vectorFromRotation(off.rotation), off.translation_m;
  return xi;
}

Rigid disturbed(const Rigid &pose, double turn_sigma, double shift_sigma, Random *random) {
  return Rigid{rotationFromVector(turn_sigma * test::normalVector(random)),
               shift_sigma * test::normalVector(random)} *
         pose;
}

struct Honesty {
  double turn = 0, shift = 0;         // RMS of errors over stated sigmas
  double turn_rad = 0, shift_m = 0;   // RMS an axis
  double still_rad = 0, still_m = 0;  // of the last pose instead
};

// Poses at 30 Hz with errors of 2 mrad and 4 mm, as is stated; odometry with a fifth of these.
Honesty honestyOf(int64_t ahead_ns, bool odometry) {
  constexpr double kTurnSigma = 2e-3, kShiftSigma = 4e-3;
  Honesty sums;
  double count = 0;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    const Head head(seed);
    Random random(seed);
    Tracker tracker;
    Trail trail;
    Rigid drift;
    for (int frame = 0; frame < 60; ++frame) {
      const double time_s = 1e-9 * kMotionFrame * frame;
      const Rigid truth = head.cameraFromMap(time_s);
      drift = disturbed(drift, 0.2 * kTurnSigma, 0.2 * kShiftSigma, &random);
      const Odometry told = {(drift * truth).inverse(), 0.2 * kTurnSigma, 0.2 * kShiftSigma};
      tracker.advance(kStart + frame * kMotionFrame, odometry ? &told : nullptr);
      Estimate estimate;
      estimate.inliers = 200;
      estimate.covariance = diagonalOf(kTurnSigma, kShiftSigma);
      estimate.camera_from_map = disturbed(truth, kTurnSigma, kShiftSigma, &random);
      tracker.accept(0, estimate, 1);
      trail.add(kStart + frame * kMotionFrame, estimate.camera_from_map, estimate.covariance);
      Motion motion;
      MovedPose moved;
      if (frame < 3) continue;
      const bool is_known =
          tracker.motion(trail, &motion) && moveTo(kStart + frame * kMotionFrame + ahead_ns, motion, &moved);
      EXPECT_TRUE(is_known);
      const Rigid then = head.cameraFromMap(time_s + 1e-9 * static_cast<double>(ahead_ns));
      const Vector6 error = errorOf(moved.camera_from_map, then), still = errorOf(estimate.camera_from_map, then);
      for (int i = 0; i < 3; ++i) {
        sums.turn += error[i] * error[i] / moved.covariance(i, i);
        sums.shift += error[i + 3] * error[i + 3] / moved.covariance(i + 3, i + 3);
      }
      sums.turn_rad += error.head<3>().squaredNorm(), sums.shift_m += error.tail<3>().squaredNorm();
      sums.still_rad += still.head<3>().squaredNorm(), sums.still_m += still.tail<3>().squaredNorm();
      count += 3;
    }
  }
  const auto rms = [count](double sum) { return std::sqrt(sum / count); };
  return {rms(sums.turn),    rms(sums.shift),     rms(sums.turn_rad),
          rms(sums.shift_m), rms(sums.still_rad), rms(sums.still_m)};
}

TEST(Motion, StatesItsErrorsHonestly) {
  for (const bool odometry : {false, true})
    for (const int64_t ahead_ns : {0, 5000000, 11000000, 16000000, 33000000, 50000000}) {
      const Honesty honesty = honestyOf(ahead_ns, odometry);
      const testing::Message which = testing::Message() << ahead_ns << (odometry ? " by odometry" : " by poses");
      EXPECT_LT(honesty.turn, 1.1) << which;
      EXPECT_LT(honesty.shift, 1.1) << which;
      EXPECT_GT(honesty.turn, 0.3) << which;
      EXPECT_GT(honesty.shift, 0.3) << which;
      if (ahead_ns >= 11000000) {
        EXPECT_LT(honesty.turn_rad, 0.6 * honesty.still_rad) << which;
        EXPECT_LT(honesty.shift_m, 0.95 * honesty.still_m) << which;
      }
    }
}

// Errors of turn and shift that go together, as those of poses do, by poses at 30 Hz: the mean squared error, in
// all six and what is stated of how they go together, over what it should be.
double alikenessOf(int64_t ahead_ns) {
  constexpr double kTurnSigma = 2e-3, kShiftSigma = 4e-3, kAlike = 0.995;
  const double rest = std::sqrt(1 - kAlike * kAlike);
  Matrix6 covariance = diagonalOf(kTurnSigma, kShiftSigma);
  for (int i = 0; i < 3; ++i) covariance(i, i + 3) = covariance(i + 3, i) = kAlike * kTurnSigma * kShiftSigma;
  double sum = 0, count = 0;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    const Head head(seed);
    Random random(seed);
    Tracker tracker;
    Trail trail;
    for (int frame = 0; frame < 60; ++frame) {
      const double time_s = 1e-9 * kMotionFrame * frame;
      const Vector3 turn = test::normalVector(&random), own = test::normalVector(&random);
      Estimate estimate;
      estimate.inliers = 200;
      estimate.covariance = covariance;
      estimate.camera_from_map =
          Rigid{rotationFromVector(kTurnSigma * turn), kShiftSigma * (kAlike * turn + rest * own)} *
          head.cameraFromMap(time_s);
      tracker.advance(kStart + frame * kMotionFrame, nullptr);
      tracker.accept(0, estimate, 1);
      trail.add(kStart + frame * kMotionFrame, estimate.camera_from_map, estimate.covariance);
      Motion motion;
      MovedPose moved;
      if (frame < 6) continue;
      EXPECT_TRUE(tracker.motion(trail, &motion) &&
                  moveTo(kStart + frame * kMotionFrame + ahead_ns, motion, &moved));
      const Vector6 error =
          errorOf(moved.camera_from_map, head.cameraFromMap(time_s + 1e-9 * static_cast<double>(ahead_ns)));
      sum += test::normalisedSquared(error, moved.covariance) / 6;
      count += 1;
    }
  }
  return sum / count;
}

TEST(Motion, StatesHonestlyHowTurnAndShiftGoTogether) {
  for (const int64_t ahead_ns : {-45000000, -30000000, -15000000, 0, 15000000})
    EXPECT_LT(alikenessOf(ahead_ns), 1.3) << ahead_ns;
}

}  // namespace
}  // namespace sphc
