#include "lab/frame/peer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spherecloud/spherecloud.hpp>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "lab/frame/bench.h"
#include "runtime/base/random.h"

namespace sphc::host {
namespace {

using testing::HasSubstr;

constexpr uint32_t kWidth = 320, kHeight = 240;

TEST(FramePeers, APythonThatIsNotThereIsToldWithTheCure) {
  const FramePeers peers("/nowhere/python");
  ASSERT_EQ(peers.variants().size(), 1u);
  EXPECT_FALSE(peers.variants()[0].run);
  EXPECT_THAT(peers.variants()[0].absent, HasSubstr("--python"));
}

TEST(FramePeers, AProgramThatIsNoPythonIsToldToo) { EXPECT_FALSE(FramePeers("true").variants()[0].run); }

// The Python that has the packages, when there is one.
std::string peerPython() {
  const char *named = std::getenv("SPHC_PEER_PYTHON");
  return named ? named : "python3";
}

TEST(FramePeers, EachRunsOrNamesThePackagesItLacks) {
  const FramePeers peers(peerPython());
  std::vector<std::string> names;
  for (const FrameVariant &variant : peers.variants()) {
    names.push_back(variant.name);
    EXPECT_NE(static_cast<bool>(variant.run), variant.absent.find("pip install") != std::string::npos)
        << variant.name;
  }
  EXPECT_THAT(names, testing::Contains(std::string(kFramePeerName)));
}

// A wall of random squares, two metres away; colour and depth in one camera.
struct Wall {
  std::vector<uint8_t> color = std::vector<uint8_t>(3 * kWidth * kHeight);
  std::vector<uint16_t> depth = std::vector<uint16_t>(kWidth * kHeight, 2000);

  Wall() {
    Random random(1);
    std::vector<uint8_t> squares(40 * 30);
    for (uint8_t &square : squares) square = static_cast<uint8_t>(random.below(256));
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < 3 * kWidth; ++x) color[y * 3 * kWidth + x] = squares[y / 8 * 40 + x / 3 / 8];
  }
  sphc_localizer_frame frame() const {
    return spherecloud::frame(1, 0, spherecloud::image(color.data(), kWidth, kHeight, SPHC_FORMAT_BGR8), 0,
                              spherecloud::image(depth.data(), kWidth, kHeight, SPHC_FORMAT_DEPTH16));
  }
};

sphc_localizer_config wallConfig() {
  sphc_localizer_config config = spherecloud::defaultConfig();
  config.rig.color_camera = {SPHC_CAMERA_PINHOLE, kWidth, kHeight, 4, {300, 300, 160, 120}};
  config.rig.depth_camera = config.rig.color_camera;
  return config;
}

TEST(FramePeers, AFrameThatWasMappedIsFoundWhereItWasTaken) {
  FramePeers peers(peerPython());
  std::vector<std::string> names;
  for (const FrameVariant &variant : peers.variants())
    if (variant.run) names.push_back(variant.name);
  if (names.empty()) GTEST_SKIP() << "no peers: " << peers.variants()[0].absent;
  const Wall wall;
  FrameCase frame = {1, wall.frame(), {rotationFromVector({0.1, -0.2, 0.3}), Vector3(1, 2, 3)}};
  peers.begin(wallConfig(), names);
  peers.addMappingFrame(frame.image, frame.truth_camera_from_world.inverse());
  EXPECT_LT(peers.index(3000), 3000u);
  for (const FrameVariant &variant : peers.variants()) {
    if (!variant.run) continue;
    const FrameAnswer answer = variant.run(frame, 0);
    PoseSample sample;
    judgePose(answer.pose, frame.truth_camera_from_world, &sample);
    EXPECT_LT(sample.translation_error_m, 0.05) << variant.name;
    EXPECT_LT(sample.rotation_error_deg, 1) << variant.name;
    EXPECT_GT(answer.stages[kFeatures], 0) << variant.name;
  }
}

TEST(FramePeers, AFisheyeIsRefusedWithTheCure) {
  FramePeers peers(peerPython());
  sphc_localizer_config config = wallConfig();
  config.rig.color_camera = {SPHC_CAMERA_KANNALA_BRANDT4, kWidth, kHeight, 8, {300, 300, 160, 120, 0, 0, 0, 0}};
  EXPECT_THROW(peers.begin(config, {}), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
