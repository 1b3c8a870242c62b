#include "drivers/simulated/cameras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "handle.h"

namespace sphc::simulated::test {
namespace {

constexpr const char *kNames[] = {"headset", "phone", "wide", "glasses"};

sphc_simulated_config configWith(uint32_t cameras) {
  sphc_simulated_config config = defaults();
  config.seed = 3;
  config.cameras = cameras;
  return config;
}

size_t pixelsOf(const sphc_camera &camera) { return size_t{camera.width} * camera.height; }

TEST(SimulatedCameras, HaveNamesAndRigsThatTheLibraryTakes) {
  for (uint32_t kind = 0; kind < 4; ++kind) {
    uint32_t parsed = 99;
    EXPECT_EQ(sphc_simulated_parse_cameras(kNames[kind], &parsed, nullptr), SPHC_OK);
    EXPECT_EQ(parsed, kind);
    EXPECT_STREQ(sphc_simulated_cameras_name(kind), kNames[kind]);
    sphc_message message{};
    const sphc_rig rig = camerasOf(kind).rig;
    EXPECT_EQ(sphc_rig_check(&rig, &message), SPHC_OK) << message.text;
  }
}

TEST(SimulatedCameras, UnknownOnesAreRefusedWithThoseThatThereAre) {
  uint32_t cameras = 99;
  sphc_message message{};
  EXPECT_EQ(sphc_simulated_parse_cameras("watch", &cameras, &message), SPHC_E_ARGUMENT);
  EXPECT_THAT(std::string(message.text), testing::HasSubstr("'watch' are unknown; there are headset, phone, wide"));
  EXPECT_EQ(sphc_simulated_parse_cameras("", &cameras, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_simulated_parse_cameras(nullptr, &cameras, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(sphc_simulated_parse_cameras("wide", nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(cameras, 99u);
  EXPECT_STREQ(sphc_simulated_cameras_name(99), "unknown");
}

TEST(SimulatedCameras, TheSourceGivesImagesOfTheRigsSizes) {
  for (uint32_t kind = 0; kind < 4; ++kind) {
    const Handle handle(configWith(kind));
    sphc_rig rig;
    ASSERT_EQ(sphc_simulated_rig(handle.get(), &rig), SPHC_OK);
    sphc_source source{};
    source.struct_size = sizeof source;
    ASSERT_EQ(sphc_simulated_source(handle.get(), &source), SPHC_OK);
    ASSERT_EQ(source.start(source.self), SPHC_OK);
    for (const sphc_camera &camera : {rig.color_camera, rig.depth_camera}) {
      sphc_capture capture{};
      capture.struct_size = sizeof capture;
      ASSERT_EQ(source.acquire(source.self, 0, &capture), SPHC_OK);
      EXPECT_EQ(capture.image.width, camera.width) << kNames[kind];
      EXPECT_EQ(capture.image.height, camera.height) << kNames[kind];
      source.release(source.self, &capture);
    }
    source.stop(source.self);
  }
}

// Depth of a colour camera at a pixel, and the same point by the headset's.
class TwoViews {
 public:
  TwoViews(const Handle &a, const Handle &b) {
    EXPECT_EQ(sphc_simulated_rig(a.get(), &rig_), SPHC_OK);
    EXPECT_EQ(sphc_simulated_rig(b.get(), &other_rig_), SPHC_OK);
    EXPECT_EQ(sphc_simulated_frame_times(a.get(), 5, &time_ns_, nullptr), SPHC_OK);
    depth_m_ = depthOf(a, rig_);
    other_depth_m_ = depthOf(b, other_rig_);
  }
  // Of the points that both see, how many are at the same depth.
  double shareThatAgrees() const {
    const sphc_camera &camera = rig_.color_camera, &other = other_rig_.color_camera;
    size_t both = 0, equal = 0;
    for (uint32_t y = 0; y < camera.height; y += 7)
      for (uint32_t x = 0; x < camera.width; x += 7) {
        const double pixel_px[2] = {x + 0.5, y + 0.5};
        double bearing[3], other_px[2];
        if (sphc_camera_unproject(&camera, pixel_px, bearing) != SPHC_OK) continue;
        if (sphc_camera_project(&other, bearing, other_px) != SPHC_OK) continue;
        if (other_px[0] < 0 || other_px[1] < 0 || other_px[0] >= other.width || other_px[1] >= other.height)
          continue;
        const size_t at = static_cast<size_t>(other_px[1]) * other.width + static_cast<size_t>(other_px[0]);
        const double z = static_cast<double>(depth_m_[size_t{y} * camera.width + x]);
        ++both;
        equal += std::abs(static_cast<double>(other_depth_m_[at]) / z - 1) < 0.02;
      }
    EXPECT_GT(both, 1000u);
    return static_cast<double>(equal) / static_cast<double>(both);
  }

 private:
  std::vector<float> depthOf(const Handle &handle, const sphc_rig &rig) const {
    std::vector<float> depth_m(pixelsOf(rig.color_camera));
    EXPECT_EQ(sphc_simulated_oracle_depth(handle.get(), time_ns_, depth_m.data()), SPHC_OK);
    return depth_m;
  }
  sphc_rig rig_{}, other_rig_{};
  int64_t time_ns_ = 0;
  std::vector<float> depth_m_, other_depth_m_;
};

TEST(SimulatedCameras, SeeTheSameRoomFromTheSamePlace) {
  const Handle headset(configWith(SPHC_SIMULATED_CAMERAS_HEADSET));
  for (uint32_t kind = 1; kind < 4; ++kind) {
    const Handle other(configWith(kind));
    EXPECT_GT(TwoViews(headset, other).shareThatAgrees(), 0.96) << kNames[kind];
  }
}

TEST(SimulatedCameras, DepthOfAPhoneHasFewHoles) {
  const Handle phone(configWith(SPHC_SIMULATED_CAMERAS_PHONE)), wide(configWith(SPHC_SIMULATED_CAMERAS_WIDE));
  const auto holes = [](const Handle &handle) {
    sphc_rig rig;
    EXPECT_EQ(sphc_simulated_rig(handle.get(), &rig), SPHC_OK);
    std::vector<uint16_t> depth(pixelsOf(rig.depth_camera));
    EXPECT_EQ(sphc_simulated_render_depth(handle.get(), 5, depth.data()), SPHC_OK);
    return std::count(depth.begin(), depth.end(), 0);
  };
  EXPECT_GT(holes(wide), 200);
  EXPECT_LT(holes(phone), 20);
}

}  // namespace
}  // namespace sphc::simulated::test
