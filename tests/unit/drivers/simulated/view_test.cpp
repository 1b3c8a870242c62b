// Cameras that the headset does not have.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "handle.h"

namespace sphc::simulated::test {
namespace {

class SimulatedView : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    sphc_simulated_config config = defaults();
    config.seed = 3;
    config.color_noise = config.motion_blur = 0;
    handle_ = new Handle(config);
    ASSERT_EQ(sphc_simulated_rig(room(), &rig_), SPHC_OK);
    ASSERT_EQ(sphc_simulated_frame_times(room(), 5, &time_ns_, nullptr), SPHC_OK);
    ASSERT_EQ(sphc_simulated_pose_at(room(), time_ns_, &world_from_color_), SPHC_OK);
  }
  static void TearDownTestSuite() {
    delete handle_;
    handle_ = nullptr;
  }
  static sphc_simulated *room() { return handle_->get(); }

  static Handle *handle_;
  static sphc_rig rig_;
  static int64_t time_ns_;
  static sphc_rigid world_from_color_;
};
Handle *SimulatedView::handle_ = nullptr;
sphc_rig SimulatedView::rig_;
int64_t SimulatedView::time_ns_ = 0;
sphc_rigid SimulatedView::world_from_color_;

TEST_F(SimulatedView, OfTheColourCameraIsItsImage) {
  std::vector<uint8_t> expected(3 * kColorPixels), rgb(expected.size());
  std::vector<float> depth_m(kColorPixels), exact_m(kColorPixels);
  ASSERT_EQ(sphc_simulated_render_color(room(), 5, expected.data()), SPHC_OK);
  ASSERT_EQ(sphc_simulated_oracle_depth(room(), time_ns_, exact_m.data()), SPHC_OK);
  ASSERT_EQ(sphc_simulated_render_view(room(), time_ns_, &rig_.color_camera, &world_from_color_, rgb.data(),
                                       nullptr, depth_m.data()),
            SPHC_OK);
  EXPECT_EQ(rgb, expected);
  EXPECT_EQ(depth_m, exact_m);
}

TEST_F(SimulatedView, DepthIsMeasuredAsByTheToFCamera) {
  const size_t pixels = size_t{SPHC_SIMULATED_DEPTH_WIDTH} * SPHC_SIMULATED_DEPTH_HEIGHT;
  std::vector<uint16_t> depth(pixels);
  std::vector<float> exact_m(pixels);
  ASSERT_EQ(sphc_simulated_render_view(room(), time_ns_, &rig_.depth_camera, &world_from_color_, nullptr,
                                       depth.data(), exact_m.data()),
            SPHC_OK);
  size_t measured = 0, near = 0;
  for (size_t i = 0; i < pixels; ++i) {
    measured += depth[i] > 0;
    near +=
        depth[i] > 0 && std::abs(depth[i] * SPHC_SIMULATED_DEPTH_UNIT_M - static_cast<double>(exact_m[i])) < 0.03;
  }
  EXPECT_GT(measured, pixels / 2);
  EXPECT_GT(near, 9 * measured / 10);
}

TEST(SimulatedIdealView, DepthIsExactWhereThatOfTheHeadsetIs) {
  sphc_simulated_config config = defaults();
  config.ideal_depth = 1;
  const Handle room(config);
  sphc_rig rig;
  int64_t color_ns = 0, depth_ns = 0;
  sphc_rigid world_from_color, world_from_depth;
  ASSERT_EQ(sphc_simulated_rig(room.get(), &rig), SPHC_OK);
  ASSERT_EQ(sphc_simulated_frame_times(room.get(), 5, &color_ns, &depth_ns), SPHC_OK);
  ASSERT_EQ(sphc_simulated_pose_at(room.get(), depth_ns, &world_from_color), SPHC_OK);
  sphc_rigid_compose(&world_from_color, &rig.color_from_depth, &world_from_depth);
  std::vector<uint16_t> of_headset(kDepthPixels), of_view(kDepthPixels);
  ASSERT_EQ(sphc_simulated_render_depth(room.get(), 5, of_headset.data()), SPHC_OK);
  ASSERT_EQ(sphc_simulated_render_view(room.get(), depth_ns, &rig.depth_camera, &world_from_depth, nullptr,
                                       of_view.data(), nullptr),
            SPHC_OK);
  size_t equal = 0;
  for (size_t i = 0; i < kDepthPixels; ++i) equal += std::abs(of_headset[i] - of_view[i]) <= 1;
  EXPECT_GT(equal, kDepthPixels - 50) << "but for the rounding of the pose, at edges";
}

TEST_F(SimulatedView, CamerasThatCannotBeDrawnAreRefused) {
  std::vector<uint8_t> rgb(3 * kColorPixels);
  const auto render = [&](const sphc_camera &camera) {
    return sphc_simulated_render_view(room(), time_ns_, &camera, &world_from_color_, rgb.data(), nullptr, nullptr);
  };
  sphc_camera camera = rig_.color_camera;
  camera.width = 636;
  EXPECT_EQ(render(camera), SPHC_E_ARGUMENT);
  camera.width = 0;
  EXPECT_EQ(render(camera), SPHC_E_ARGUMENT);
  camera = rig_.color_camera;
  camera.model = SPHC_CAMERA_PINHOLE;
  EXPECT_EQ(render(camera), SPHC_E_ARGUMENT);
  EXPECT_EQ(
      sphc_simulated_render_view(nullptr, time_ns_, &camera, &world_from_color_, rgb.data(), nullptr, nullptr),
      SPHC_E_ARGUMENT);
}

}  // namespace
}  // namespace sphc::simulated::test
