#include "lab/hints/conditions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace sphc::host {
namespace {

constexpr uint32_t kWidth = 32, kHeight = 16;

// Grey shots at 10 Hz of a camera that turns to the right.
Sequence madeSequence() {
  Sequence sequence;
  const sphc_camera camera = {SPHC_CAMERA_PINHOLE, kWidth, kHeight, 4, {30, 30, 16, 8}};
  sequence.rig.color_camera = sequence.rig.depth_camera = camera;
  sequence.rig.color_from_depth = {{1, 0, 0, 0}, {0, 0, 0}};
  sequence.rig.depth_unit_m = 0.001;
  sequence.color_format = SPHC_FORMAT_GRAY8;
  for (uint32_t i = 0; i < 3; ++i) {
    Shot shot;
    shot.color.assign(size_t{kWidth} * kHeight, 40);
    for (uint32_t y = 0; y < kHeight; ++y) shot.color[size_t{y} * kWidth + 16] = 250;  // an upright line
    shot.depth.assign(size_t{kWidth} * kHeight, 2000);
    shot.color_time_ns = shot.depth_time_ns = int64_t{100000000} * i;
    const double half_rad = 0.05 * i;
    shot.world_from_camera = sphc_rigid{{std::cos(half_rad), 0, std::sin(half_rad), 0}, {0, 0, 0}};
    sequence.shots.push_back(shot);
  }
  return sequence;
}

const HintCondition &named(const std::vector<HintCondition> &all, const std::string &name) {
  for (const HintCondition &condition : all)
    if (condition.name == name) return condition;
  throw std::runtime_error("no condition " + name);
}

TEST(HintConditions, EachHasANameAndChangesSomething) {
  std::set<std::string> names;
  for (const HintCondition &condition : hintConditions()) {
    EXPECT_TRUE(names.insert(condition.name).second) << condition.name;
    const Sequence healthy = madeSequence();
    Sequence changed = healthy;
    condition.apply(&changed);
    const bool is_same =
        changed.shots[1].color == healthy.shots[1].color && changed.shots[1].depth == healthy.shots[1].depth;
    EXPECT_EQ(is_same, condition.hint == 0) << condition.name;
  }
}

TEST(HintConditions, BlurGoesAlongTheMotion) {
  Sequence blurred = madeSequence();
  named(hintConditions(), "blurred by 12 px").apply(&blurred);
  const std::vector<uint8_t> &color = blurred.shots[1].color;
  EXPECT_LT(color[8 * kWidth + 16], 130) << "the upright line is spread";
  EXPECT_GT(color[8 * kWidth + 12], 60);
  EXPECT_NEAR(color[8 * kWidth + 12], color[8 * kWidth + 19], 20) << "evenly";
  EXPECT_NEAR(color[8 * kWidth + 4], 40, 10) << "not further than that";
}

TEST(HintConditions, LessLightHasMoreNoise) {
  const auto spread = [](const ExposureSetting &exposure) {
    std::vector<uint8_t> values(10000, 128);
    expose(exposure, 1, &values);
    double sum = 0, sum2 = 0;
    for (const uint8_t value : values) {
      sum += value;
      sum2 += value * value;
    }
    const double mean = sum / 1e4;
    return std::make_pair(mean, std::sqrt(sum2 / 1e4 - mean * mean));
  };
  EXPECT_NEAR(spread({1, 1}).first, 128, 1);
  EXPECT_NEAR(spread({1, 1}).second, 1.8, 0.2);
  EXPECT_NEAR(spread({0.04, 6}).first, 128 * std::sqrt(0.24), 2);
  EXPECT_GT(spread({0.04, 6}).second, 5);
}

}  // namespace
}  // namespace sphc::host
