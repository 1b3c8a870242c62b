#include "host/live/consistency_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/unit/host/live/rendered_walk.h"

namespace sphc::host {
namespace {

constexpr uint32_t kFrames = 8;
constexpr int64_t kPeriodNs = 100000000;
constexpr double kDepthMinM = 0.25, kDepthMaxM = 6;

// A walk through the simulated room, rendered once.
class ConsistencyCheckTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { images_ = renderWalk(kFrames, 1e9 / kPeriodNs, &rig_); }
  static void TearDownTestSuite() { images_.clear(); }

  using Spoil = std::function<void(uint32_t i, WalkImages *images)>;
  Findings look(const Spoil &spoil, double depth_max_m = kDepthMaxM) {
    ConsistencyCheck check(rig_, kDepthMinM, depth_max_m);
    const sphc_camera &c = rig_.color_camera, &d = rig_.depth_camera;
    for (uint32_t i = 0; i < kFrames; ++i) {
      WalkImages images = images_[i];
      spoil(i, &images);
      check.look({images.color.data(), c.width, c.height, 3 * c.width, SPHC_FORMAT_RGB8}, i * kPeriodNs,
                 {images.depth.data(), d.width, d.height, 2 * d.width, SPHC_FORMAT_DEPTH16}, i * kPeriodNs);
    }
    return check.findings();
  }

  static inline sphc_rig rig_ = {};
  static inline std::vector<WalkImages> images_;
};

TEST_F(ConsistencyCheckTest, SoundCamerasDoNotContradictThemselves) {
  const Findings findings = look([](uint32_t, WalkImages *) {});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].grade, Finding::Grade::kFine);
}

TEST_F(ConsistencyCheckTest, AFrozenStreamIsNamedWithItsCure) {
  const Findings findings = look([](uint32_t, WalkImages *images) { images->depth = images_[0].depth; });
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].what, "depth frozen");
  EXPECT_EQ(findings[0].grade, Finding::Grade::kWrong);
  EXPECT_NE(findings[0].text.find("restart the depth stream"), std::string::npos) << findings[0].text;
}

TEST_F(ConsistencyCheckTest, EveryFaultIsOneFinding) {
  const Findings findings = look([](uint32_t i, WalkImages *images) {
    std::fill(images->depth.begin(), images->depth.end(), i % 2 ? 1000 : 65000);
  });
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].what, "depth out of range");
  EXPECT_EQ(findings[1].what, "depth constant");
}

TEST_F(ConsistencyCheckTest, AHallIsInTheRangeThatIsTold) {
  const Spoil enlarge = [](uint32_t, WalkImages *images) {
    for (uint16_t &depth : images->depth) depth = static_cast<uint16_t>(10 * depth);
  };
  const Findings beyond = look(enlarge);
  ASSERT_EQ(beyond.size(), 1u);
  EXPECT_EQ(beyond[0].what, "depth out of range");
  for (const Finding &finding : look(enlarge, 60)) EXPECT_NE(finding.what, "depth out of range");
}

TEST_F(ConsistencyCheckTest, WithoutAPairNothingIsSaid) {
  EXPECT_TRUE(ConsistencyCheck(rig_, kDepthMinM, kDepthMaxM).findings().empty());
}

}  // namespace
}  // namespace sphc::host
