// Every estimator that is here finds a pose without noise.
#include "lab/pose/ours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/pose/bench.h"
#include "lab/pose/peers.h"
#include "simulated_case.h"

namespace sphc::host {
namespace {

void expectFound(const PoseVariant &variant, const PoseCase &c) {
  PoseSample sample;
  judgePose(variant.run(c, 1), c.truth_camera_from_map, &sample);
  EXPECT_TRUE(sample.found) << variant.name;
  EXPECT_LT(sample.rotation_error_deg, 0.2) << variant.name;
  EXPECT_LT(sample.translation_error_m, 0.005) << variant.name;
}

TEST(PoseOurs, EveryVariantFindsThePose) {
  const auto variants = ourVariants();
  ASSERT_FALSE(variants.empty());
  EXPECT_EQ(variants[0].name, "ours");
  for (const PoseVariant &variant : variants) {
    for (const size_t rows : {120, 300, 90}) expectFound(variant, test::simulatedCase(rows, 3));
  }
}

TEST(PoseOurs, NoRowsGiveNoAnswer) {
  for (const PoseVariant &variant : ourVariants()) {
    for (const size_t rows : {0, 1, 2, 3})
      EXPECT_FALSE(variant.run(test::simulatedCase(rows, 1), 1).found) << variant.name;
  }
}

TEST(PosePeers, ThoseThatAreHereFindThePose) {
  for (const PoseVariant &variant : posePeers("python3")) {
    if (variant.run)
      expectFound(variant, test::simulatedCase(200, 2));
    else
      EXPECT_NE(variant.absent, "") << variant.name;
  }
}

TEST(PosePeers, APythonThatIsNotThereIsAbsenceWithACure) {
  for (const char *python : {"/nowhere/python", "true"}) {
    const PoseVariant peer = poseLibPeer(python);
    EXPECT_FALSE(peer.run) << python;
    EXPECT_THAT(peer.absent, testing::HasSubstr("pip install poselib"));
  }
}

}  // namespace
}  // namespace sphc::host
