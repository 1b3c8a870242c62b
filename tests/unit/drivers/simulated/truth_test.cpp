#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "drivers/simulated/lens.h"
#include "drivers/simulated/vec.h"
#include "handle.h"

namespace sphc::simulated::test {
namespace {

class SimulatedTruth : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    sphc_simulated_config config = defaults();
    config.seed = 3;
    handle_ = new Handle(config);
    ASSERT_EQ(sphc_simulated_rig(handle_->get(), &rig_), SPHC_OK);
  }
  static void TearDownTestSuite() {
    delete handle_;
    handle_ = nullptr;
  }

  static Pose poseAt(int64_t time_ns) {
    sphc_rigid world_from_camera{};
    EXPECT_EQ(sphc_simulated_pose_at(handle_->get(), time_ns, &world_from_camera), SPHC_OK);
    return poseOf(world_from_camera);
  }
  static int64_t timeOf(uint32_t index, int64_t *depth_time_ns = nullptr) {
    int64_t time_ns = 0;
    EXPECT_EQ(sphc_simulated_frame_times(handle_->get(), index, &time_ns, depth_time_ns), SPHC_OK);
    return time_ns;
  }
  static std::vector<float> oracle(int64_t time_ns) {
    std::vector<float> z(kColorPixels);
    EXPECT_EQ(sphc_simulated_oracle_depth(handle_->get(), time_ns, z.data()), SPHC_OK);
    return z;
  }
  static double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  }

  // The walk is smooth, slow and closed.
  static void checkWalk() {
    constexpr double kStep_s = 0.01;
    const int64_t start_ns = timeOf(0);
    Pose last = poseAt(start_ns);
    for (int i = 1; i <= 3200; ++i) {
      const Pose now = poseAt(start_ns + static_cast<int64_t>(i * kStep_s * 1e9));
      const double speed = norm(now.center - last.center) / kStep_s;
      const Mat3d turn = transposed(last.rotation) * now.rotation;
      const double cosine = 0.5 * (turn.row[0].x + turn.row[1].y + turn.row[2].z - 1);
      const double rate = std::acos(std::clamp(cosine, -1.0, 1.0)) / kStep_s * 180 / 3.14159265;
      EXPECT_GT(speed, 0.15);
      EXPECT_LT(speed, 0.9);
      EXPECT_LT(rate, 55);
      last = now;
    }
    EXPECT_LT(norm(last.center - poseAt(start_ns).center), 1e-6);
  }

  // What is felt along a closed lap is gravity, and from moment to moment the change of velocity.
  static void checkFeltAccelerations() {
    constexpr int kCount = 3200;
    constexpr int64_t kPeriodNs = 5000000;  // 16 s in all
    Vec3d sum{};
    double squared_error = 0;
    for (int i = 0; i < kCount; ++i) {
      const int64_t time_ns = timeOf(0) + i * kPeriodNs;
      double felt[3], again[3];
      ASSERT_EQ(sphc_simulated_felt_at(handle_->get(), time_ns, felt), SPHC_OK);
      ASSERT_EQ(sphc_simulated_felt_at(handle_->get(), time_ns, again), SPHC_OK);
      EXPECT_EQ(felt[0], again[0]);
      const Pose now = poseAt(time_ns);
      const Vec3d world = now.rotation * Vec3d{felt[0], felt[1], felt[2]};
      sum = sum + world;
      const Vec3d before = poseAt(time_ns - 4 * kPeriodNs).center, after = poseAt(time_ns + 4 * kPeriodNs).center;
      const Vec3d change = (before + after - now.center * 2.0) * (1 / (0.02 * 0.02));
      const Vec3d error = world - change - Vec3d{0, 0, 9.81};
      squared_error += dot(error, error) / kCount;
    }
    const Vec3d mean = sum * (1.0 / kCount);
    EXPECT_NEAR(mean.x, 0, 0.15);
    EXPECT_NEAR(mean.y, 0, 0.15);
    EXPECT_NEAR(mean.z, 9.81, 0.15);
    EXPECT_GT(std::sqrt(squared_error), 0.03) << "it has noise";
    EXPECT_LT(std::sqrt(squared_error), 0.25);
    EXPECT_EQ(sphc_simulated_felt_at(handle_->get(), 0, nullptr), SPHC_E_ARGUMENT);
  }

  // A point seen in lap one is where lap two sees it.
  static void checkBothLaps() {
    const int64_t a_ns = timeOf(20), b_ns = timeOf(120);
    const Pose a = poseAt(a_ns), b = poseAt(b_ns);
    EXPECT_GT(norm(a.center - b.center), 0.02) << "another viewpoint";
    const std::vector<float> za = oracle(a_ns), zb = oracle(b_ns);
    std::vector<double> errors;
    int inside = 0;
    for (uint32_t y = 8; y < rig_.color_camera.height; y += 16) {
      for (uint32_t x = 8; x < rig_.color_camera.width; x += 16) {
        const double pixel_px[2] = {x + 0.5, y + 0.5};
        double xy[2], there_px[2];
        unproject(rig_.color_camera, pixel_px, xy);
        const double z = static_cast<double>(za[y * rig_.color_camera.width + x]);
        EXPECT_GT(z, 0.3);
        const Vec3d world = a.rotation * Vec3d{xy[0] * z, xy[1] * z, z} + a.center;
        const Vec3d in_b = transposed(b.rotation) * (world - b.center);
        if (in_b.z < 0.1) continue;
        project(rig_.color_camera, in_b.x / in_b.z, in_b.y / in_b.z, there_px);
        if (!(there_px[0] > 0 && there_px[0] < 640 && there_px[1] > 0 && there_px[1] < 480)) continue;
        ++inside;
        const auto column = static_cast<uint32_t>(there_px[0]), row = static_cast<uint32_t>(there_px[1]);
        errors.push_back(std::fabs(static_cast<double>(zb[row * rig_.color_camera.width + column]) - in_b.z));
      }
    }
    EXPECT_GT(inside, 500) << "the laps see the same places";
    EXPECT_LT(median(errors), 0.01) << "half a pixel on a slanted wall";
  }

  // Measured depth is the truth plus bias and noise.
  static void checkMeasuredDepth() {
    std::vector<uint16_t> depth(kDepthPixels);
    std::vector<float> truth(kDepthPixels);
    int64_t depth_ns = 0;
    timeOf(60, &depth_ns);
    ASSERT_EQ(sphc_simulated_render_depth(handle_->get(), 60, depth.data()), SPHC_OK);
    ASSERT_EQ(sphc_simulated_oracle_tof_depth(handle_->get(), depth_ns, truth.data()), SPHC_OK);
    std::vector<double> errors, sizes;
    for (size_t i = 0; i < kDepthPixels; ++i) {
      if (depth[i] == 0) continue;
      const double e = depth[i] * SPHC_SIMULATED_DEPTH_UNIT_M - static_cast<double>(truth[i]);
      errors.push_back(e);
      sizes.push_back(std::fabs(e));
    }
    const double missing = 1 - static_cast<double>(errors.size()) / kDepthPixels;
    EXPECT_GT(missing, 0.0005);
    EXPECT_LT(missing, 0.2);
    EXPECT_NEAR(median(errors), 0.003, 0.005);
    EXPECT_GT(median(sizes), 0.002);
    EXPECT_LT(median(sizes), 0.015);
    EXPECT_GT(*std::max_element(sizes.begin(), sizes.end()), 0.1) << "flying pixels";
  }

  // Both cameras see one room.
  static void checkBothCameras() {
    const int64_t time_ns = timeOf(60);
    const std::vector<float> z_color = oracle(time_ns);
    std::vector<float> z_depth(kDepthPixels);
    ASSERT_EQ(sphc_simulated_oracle_tof_depth(handle_->get(), time_ns, z_depth.data()), SPHC_OK);
    const Pose color_from_depth = poseOf(rig_.color_from_depth);
    std::vector<double> errors;
    for (uint32_t y = 4; y < rig_.depth_camera.height; y += 8) {
      for (uint32_t x = 4; x < rig_.depth_camera.width; x += 8) {
        const double pixel_px[2] = {x + 0.5, y + 0.5};
        double xy[2], there_px[2];
        unproject(rig_.depth_camera, pixel_px, xy);
        const double z = static_cast<double>(z_depth[y * rig_.depth_camera.width + x]);
        const Vec3d p = color_from_depth.rotation * Vec3d{xy[0] * z, xy[1] * z, z} + color_from_depth.center;
        project(rig_.color_camera, p.x / p.z, p.y / p.z, there_px);
        if (!(there_px[0] > 0 && there_px[0] < 640 && there_px[1] > 0 && there_px[1] < 480)) continue;
        const auto column = static_cast<uint32_t>(there_px[0]), row = static_cast<uint32_t>(there_px[1]);
        errors.push_back(std::fabs(static_cast<double>(z_color[row * rig_.color_camera.width + column]) - p.z));
      }
    }
    EXPECT_GT(errors.size(), 500u);
    EXPECT_LT(median(errors), 0.006);
  }

  static Handle *handle_;
  static sphc_rig rig_;
};
Handle *SimulatedTruth::handle_ = nullptr;
sphc_rig SimulatedTruth::rig_;

// One room, hence one test: every test case runs in a process of its own.
TEST_F(SimulatedTruth, PosesDepthAndImagesAgree) {
  checkWalk();
  checkFeltAccelerations();
  checkBothLaps();
  checkMeasuredDepth();
  checkBothCameras();
}

}  // namespace
}  // namespace sphc::simulated::test
