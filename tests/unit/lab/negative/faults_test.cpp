#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string>

#include "lab/negative/fault.h"

namespace sphc::host {
namespace {

// Twelve small shots at 10 Hz, each another one; what is done to them is the same for large ones.
Sequence madeSequence() {
  Sequence sequence;
  const sphc_camera camera = {SPHC_CAMERA_PINHOLE, 32, 16, 4, {30, 30, 16, 8}};
  sequence.rig.color_camera = sequence.rig.depth_camera = camera;
  sequence.rig.color_from_depth = {{1, 0, 0, 0}, {0, 0, 0}};
  sequence.rig.depth_unit_m = 0.001;
  for (uint32_t i = 0; i < 12; ++i) {
    Shot shot;
    for (uint32_t pixel = 0; pixel < 32 * 16; ++pixel) {
      shot.depth.push_back(static_cast<uint16_t>(900 + 7 * pixel + 100 * i));
      for (uint32_t k = 0; k < 3; ++k) shot.color.push_back(static_cast<uint8_t>(5 * pixel + 3 * k + 11 * i));
    }
    shot.color_time_ns = shot.depth_time_ns = int64_t{100000000} * i;
    shot.world_from_camera = sphc_rigid{{1, 0, 0, 0}, {0.01 * i, 0, 0}};
    shot.prior.flags = SPHC_PRIOR_ODOMETRY;
    shot.prior.odometry_from_camera = *shot.world_from_camera;
    sequence.shots.push_back(shot);
  }
  return sequence;
}

bool isSame(const Sequence &a, const Sequence &b) {
  if (a.shots.size() != b.shots.size() || std::memcmp(&a.rig, &b.rig, sizeof a.rig) != 0) return false;
  for (size_t i = 0; i < a.shots.size(); ++i)
    if (a.shots[i].color != b.shots[i].color || a.shots[i].depth != b.shots[i].depth ||
        a.shots[i].prior.flags != b.shots[i].prior.flags ||
        std::memcmp(&a.shots[i].prior.odometry_from_camera, &b.shots[i].prior.odometry_from_camera,
                    sizeof(sphc_rigid)) != 0)
      return false;
  return true;
}

TEST(SensorFaults, EachHasANameAndBreaksSomething) {
  std::set<std::string> names;
  for (const SensorFault &fault : allFaults()) {
    EXPECT_TRUE(names.insert(fault.name).second) << fault.name;
    Sequence broken = madeSequence();
    fault.apply(&broken);
    const bool is_healthy = fault.name == "healthy" || fault.name == "healthy, odometry";
    EXPECT_EQ(isSame(broken, madeSequence()), is_healthy) << fault.name;
    for (const Shot &shot : broken.shots) {
      EXPECT_EQ(shot.color.size(), size_t{32} * 16 * 3) << fault.name;
      EXPECT_EQ(shot.depth.size(), size_t{32} * 16) << fault.name;
    }
  }
}

TEST(SensorFaults, SoundFramesMayBeNoisyOrBright) {
  for (const SensorFault &fault : allFaults()) {
    Sequence changed = madeSequence();
    fault.apply(&changed);
    const Shot before = madeSequence().shots[0], &after = changed.shots[0];
    if (fault.name == "healthy, depth noise 2.5 %") {
      double sum2 = 0;
      for (size_t i = 0; i < after.depth.size(); ++i)
        sum2 += std::pow(1.0 * after.depth[i] / before.depth[i] - 1, 2);
      EXPECT_NEAR(std::sqrt(sum2 / static_cast<double>(after.depth.size())), 0.025, 0.005);
      EXPECT_EQ(fault.named_by, 0u);
    }
    if (fault.name == "healthy, twice the light") {
      for (size_t i = 0; i < after.color.size(); ++i) EXPECT_GE(after.color[i], before.color[i]);
      EXPECT_EQ(fault.named_by, 0u);
    }
  }
}

TEST(SensorFaults, ASmoothedDepthIsTheMeanOfWhatIsMeasuredAround) {
  const std::string name = "healthy, depth smoothed", filled = name + ", holes filled";
  uint32_t looked_at = 0;
  for (const SensorFault &fault : allFaults()) {
    if (fault.name != name && fault.name != filled) continue;
    Sequence changed = madeSequence();
    std::vector<uint16_t> &depth = changed.shots[0].depth;
    std::fill(depth.begin(), depth.end(), uint16_t{1000});
    depth[5 * 32 + 5] = 0;
    depth[9 * 32 + 9] = 1900;
    fault.apply(&changed);
    EXPECT_EQ(fault.named_by, 0u);
    EXPECT_EQ(depth[5 * 32 + 5], fault.name == filled ? 1000 : 0);
    for (const size_t at : {8 * 32 + 8, 9 * 32 + 9, 10 * 32 + 9}) EXPECT_EQ(depth[at], 1100);
    for (const size_t at : {0, 9 * 32 + 11, 15 * 32 + 31}) EXPECT_EQ(depth[at], 1000);
    ++looked_at;
  }
  EXPECT_EQ(looked_at, 2u);
}

TEST(SensorFaults, LateDepthIsThatOfEarlierFrames) {
  uint32_t looked_at = 0;
  for (const SensorFault &fault : depthFaults()) {
    if (fault.name.find("depth 0.3 s late") == std::string::npos) continue;
    const bool is_told = fault.name.find("times told") != std::string::npos;
    const Sequence healthy = madeSequence();
    Sequence broken = healthy;
    fault.apply(&broken);
    ASSERT_EQ(broken.shots.size(), 9u) << fault.name;
    for (size_t i = 0; i < broken.shots.size(); ++i) {
      EXPECT_EQ(broken.shots[i].depth, healthy.shots[i].depth) << i;
      EXPECT_EQ(broken.shots[i].color, healthy.shots[i + 3].color) << i;
      EXPECT_EQ(broken.shots[i].depth_time_ns, healthy.shots[is_told ? i : i + 3].depth_time_ns) << i;
    }
    ++looked_at;
  }
  EXPECT_EQ(looked_at, 3u);
}

TEST(SensorFaults, TwoMirrorsShowThePlace) {
  for (const SensorFault &fault : colorFaults()) {
    if (!fault.is_elsewhere) continue;
    Sequence twice = madeSequence();
    fault.apply(&twice);
    fault.apply(&twice);
    EXPECT_TRUE(isSame(twice, madeSequence()));
  }
}

}  // namespace
}  // namespace sphc::host
