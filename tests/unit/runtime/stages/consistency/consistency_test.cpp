#include "runtime/stages/consistency/consistency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/base/random.h"
#include "tests/unit/runtime/stages/consistency/made_view.h"

namespace sphc {
namespace {

constexpr int64_t kStepNs = 100000000;

TEST(Consistency, AHealthyFrameHasNoFault) {
  HeldConsistency held(false);
  const MadeView view;
  EXPECT_EQ(held.consistency.look(view.view()), Faults{0});
  EXPECT_FALSE(held.consistency.isDoubtful());
  EXPECT_GT(held.consistency.agreement().edges, 20u);
  EXPECT_GT(held.consistency.agreement().middle(), 0.7);
}

TEST(Consistency, NamesDepthThatIsConstant) {
  HeldConsistency held(false);
  MadeView view;
  std::fill(view.depth().begin(), view.depth().end(), uint16_t{2000});
  EXPECT_EQ(held.consistency.look(view.view()) & kDepthConstant, kDepthConstant);
}

// z is another one at each pixel.
TEST(Consistency, NamesARangeThatIsConstant) {
  MadeView view;
  for (int32_t y = 0; y < MadeView::kHeight; ++y)
    for (int32_t x = 0; x < MadeView::kWidth; ++x) {
      const double u = (x + 0.5 - 160) / MadeView::kFocal, v = (y + 0.5 - 120) / MadeView::kFocal;
      view.depth()[static_cast<size_t>(y * MadeView::kWidth + x)] =
          static_cast<uint16_t>(2000 / std::sqrt(1 + u * u + v * v) + 0.5);
    }
  HeldConsistency of_z(false), of_range(false);
  ConsistencyConfig config = MadeView::config(false);
  config.depth_is_range = true;
  of_range.consistency.init(config);
  EXPECT_EQ(of_z.consistency.look(view.view()) & kDepthConstant, Faults{0});
  EXPECT_EQ(of_range.consistency.look(view.view()) & kDepthConstant, kDepthConstant);
}

TEST(Consistency, NamesDepthOutOfRange) {
  HeldConsistency held(false);
  MadeView view;
  for (const uint16_t far_or_near : {uint16_t{65535}, uint16_t{100}}) {
    std::fill(view.depth().begin(), view.depth().end(), far_or_near);
    EXPECT_EQ(held.consistency.look(view.view()), kDepthRange) << far_or_near;
  }
}

TEST(Consistency, ABlindSensorIsNoContradiction) {
  HeldConsistency held(false);
  MadeView view;
  std::fill(view.depth().begin(), view.depth().end(), uint16_t{0});
  EXPECT_EQ(held.consistency.look(view.view()), Faults{0});
}

// A wall alone: its inverse depth is linear, and no longer so once far and near are swapped.
TEST(Consistency, NamesDepthThatIsInverted) {
  for (const bool inverted : {false, true}) {
    HeldConsistency held(false);
    MadeView view;
    for (int32_t y = 0; y < MadeView::kHeight; ++y)
      for (int32_t x = 0; x < MadeView::kWidth; ++x) {
        const double z = 1e6 / (500 - 1.2 * (x - 160));
        view.depth()[static_cast<size_t>(y * MadeView::kWidth + x)] =
            static_cast<uint16_t>(inverted ? 6250 - z : z);
      }
    EXPECT_EQ(held.consistency.look(view.view()) & kDepthBent, inverted ? kDepthBent : 0) << inverted;
  }
}

TEST(Consistency, EdgesThatLieElsewhereAreNamedInTheEnd) {
  HeldConsistency held(true);
  Faults faults = 0;
  for (int32_t i = 0; i < 8; ++i) faults = held.consistency.look(MadeView(3 * i, 3 * i + 14).view(i * kStepNs));
  EXPECT_EQ(faults & kDepthColorDisagree, kDepthColorDisagree);
  held.consistency.reset();
  EXPECT_EQ(held.consistency.look(MadeView().view(9 * kStepNs)) & kDepthColorDisagree, Faults{0});
}

TEST(Consistency, WhatImagesOfOtherTimesSaidIsNotCarriedOver) {
  HeldConsistency held(true);
  const auto look = [&](int32_t i, int32_t off, bool are_apart) {
    const MadeView made(3 * i, 3 * i + off);
    ConsistencyView view = made.view(i * kStepNs);
    view.are_apart = are_apart;
    return held.consistency.look(view) & kDepthColorDisagree;
  };
  Faults faults = 0;
  for (int32_t i = 0; i < 8; ++i) faults = look(i, 14, true);
  EXPECT_EQ(faults, kDepthColorDisagree);
  EXPECT_EQ(look(8, 0, false), Faults{0});
  EXPECT_FALSE(held.consistency.isDoubtful());
  for (int32_t i = 9; i < 17; ++i) faults = look(i, 14, false);
  EXPECT_EQ(faults, kDepthColorDisagree);
}

// What edges said of images that are apart fades with time alone, however many frames tell nothing meanwhile.
TEST(Consistency, WhatEdgesSaidFadesByTheTimeSinceTheySaidIt) {
  const auto doubtsAfter = [](int32_t silent_frames, int64_t silent_ns) {
    HeldConsistency held(true);
    const auto look = [&](const MadeView &made, int64_t time_ns, bool are_silent) {
      ConsistencyView view = made.view(time_ns);
      view.are_apart = true;
      if (are_silent) view.hides_edges = [](GrayView) { return true; };
      return held.consistency.look(view) & kDepthColorDisagree;
    };
    Faults faults = 0;
    for (int32_t i = 0; i < 12; ++i) faults = look(MadeView(3 * i, 3 * i + 14), i * kStepNs, false);
    EXPECT_EQ(faults, kDepthColorDisagree);
    for (int32_t i = 1; i <= silent_frames; ++i)
      faults = look(MadeView(33 + 3 * i, 47 + 3 * i), 11 * kStepNs + silent_ns * i / silent_frames, true);
    return faults == kDepthColorDisagree;
  };
  EXPECT_TRUE(doubtsAfter(1, 1000000000));
  EXPECT_TRUE(doubtsAfter(20, 1000000000));
  EXPECT_FALSE(doubtsAfter(1, 4000000000));
  EXPECT_FALSE(doubtsAfter(20, 4000000000));
}

// A sensor may smooth its depth, and no step is left at an edge.
TEST(Consistency, DepthThatIsSmoothIsNoContradiction) {
  for (const int32_t radius_px : {1, 2, 4}) {
    HeldConsistency held(true);
    for (int32_t i = 0; i < 16; ++i) {
      MadeView made(3 * i, 3 * i);
      made.smoothDepth(radius_px);
      EXPECT_EQ(held.consistency.look(made.view(i * kStepNs)) & kDepthColorDisagree, Faults{0}) << radius_px;
      EXPECT_FALSE(held.consistency.isDoubtful()) << radius_px;
    }
    EXPECT_GT(held.consistency.agreement().edges, 20u) << radius_px;
  }
}

// Noise has its edges anywhere.
TEST(Consistency, InTheDarkEdgesSayNothing) {
  for (const bool follows : {false, true}) {
    HeldConsistency held(follows);
    for (int32_t i = 0; i < 8; ++i) {
      const MadeView made(3 * i, 3 * i + 14);
      ConsistencyView view = made.view(i * kStepNs);
      view.hides_edges = [](GrayView) { return true; };
      EXPECT_EQ(held.consistency.look(view) & kDepthColorDisagree, Faults{0}) << i;
      EXPECT_FALSE(held.consistency.isDoubtful()) << i;
    }
  }
}

// Depth of 3 % noise has steps of a tenth between neighbours all over the image, and no edges there.
TEST(Consistency, NoiseOfDepthIsNoEdge) {
  HeldConsistency held(true);
  Random random(7);
  for (int32_t i = 0; i < 20; ++i) {
    MadeView made(3 * i, 3 * i);
    for (uint16_t &depth : made.depth()) {
      double sum = -6;  // of twelve even numbers: nearly normal
      for (int j = 0; j < 12; ++j) sum += random.uniform();
      depth = static_cast<uint16_t>(depth * (1 + 0.03 * sum));
    }
    EXPECT_EQ(held.consistency.look(made.view(i * kStepNs)) & kDepthColorDisagree, Faults{0}) << i;
    EXPECT_GT(held.consistency.agreement().edges, 20u);
    EXPECT_GT(held.consistency.agreement().middle(), 0.7);
  }
}

// Of a sound sensor one measurement is enough: a cable before a wall.
TEST(Consistency, AThinThingHasEdges) {
  HeldConsistency held(false);
  MadeView made;
  for (size_t i = 0; i < made.depth().size(); ++i)
    if (i % 40 == 20) made.depth()[i] = 900;
  const uint32_t boxes = [] {
    HeldConsistency without(false);
    without.consistency.look(MadeView().view());
    return without.consistency.agreement().edges;
  }();
  held.consistency.look(made.view());
  EXPECT_GT(held.consistency.agreement().edges, boxes + 20);
}

// Else the same few edges that lie badly would be counted thirty times a second.
TEST(Consistency, FramesThatFollowAtOnceCountForAPartOfOne) {
  const auto framesUntilNamed = [](int64_t step_ns) {
    HeldConsistency held(true);
    for (int32_t i = 0; i < 100; ++i)
      if (held.consistency.look(MadeView(3 * i, 3 * i + 8).view(i * step_ns)) & kDepthColorDisagree) return i;
    return 100;
  };
  const int32_t slow = framesUntilNamed(1000000000), quick = framesUntilNamed(33000000);
  EXPECT_LT(slow, 10);
  EXPECT_GT(quick, 4 * slow);
  EXPECT_LT(quick, 100);
}

TEST(Consistency, NamesAStreamThatStandsStill) {
  HeldConsistency depth_stands(true), color_stands(true);
  Faults of_depth = 0, of_color = 0;
  for (int32_t i = 0; i < 4; ++i) {
    of_depth = depth_stands.consistency.look(MadeView(15 * i, 0).view(i * kStepNs));
    of_color = color_stands.consistency.look(MadeView(0, 15 * i).view(i * kStepNs));
  }
  EXPECT_EQ(of_depth & kDepthFrozen, kDepthFrozen);
  EXPECT_EQ(of_color & kColorFrozen, kColorFrozen);
}

// Cameras that run freely give one image twice now and then.
TEST(Consistency, AnImageThatComesTwiceIsNotFrozen) {
  constexpr int64_t kThirtiethNs = 33000000;
  for (const bool of_depth : {false, true}) {
    HeldConsistency held(true);
    Faults faults = 0;
    for (int32_t i = 0; i < 4; ++i) {
      const MadeView view = of_depth ? MadeView(25 * i, 0) : MadeView(0, 25 * i);
      faults = held.consistency.look(view.view(i * kThirtiethNs)) & (kDepthFrozen | kColorFrozen);
      EXPECT_EQ(faults != 0, i >= 2) << of_depth << " " << i;
    }
  }
}

TEST(Consistency, AfterAResetNothingStoodStill) {
  for (const bool of_depth : {false, true}) {
    HeldConsistency held(true);
    held.consistency.look(MadeView().view(0));
    held.consistency.reset();
    const MadeView view = of_depth ? MadeView(25, 0) : MadeView(0, 25);
    EXPECT_EQ(held.consistency.look(view.view(10 * kStepNs)) & (kDepthFrozen | kColorFrozen), Faults{0});
  }
}

// The least time is one that nobody knew.
TEST(Consistency, TimesMayBeAsFarApartAsTheyCan) {
  HeldConsistency held(true);
  for (const int64_t time_ns : {INT64_MIN, INT64_MAX, INT64_MIN})
    EXPECT_EQ(held.consistency.look(MadeView().view(time_ns)), Faults{0}) << time_ns;
}

TEST(Consistency, TheFirstTimeMayBeAnything) {
  for (const int64_t time_ns : {INT64_MIN, int64_t{0}, INT64_MAX / 2 + kStepNs, INT64_MAX}) {
    HeldConsistency held(true);
    EXPECT_EQ(held.consistency.look(MadeView().view(time_ns)), Faults{0}) << time_ns;
  }
}

TEST(Consistency, ACameraThatRestsIsNoFault) {
  HeldConsistency held(true);
  for (int32_t i = 0; i < 4; ++i) EXPECT_EQ(held.consistency.look(MadeView().view(i * kStepNs)), Faults{0}) << i;
}

// The light went out and on again.
TEST(Consistency, LightIsNoMotion) {
  HeldConsistency held(true);
  for (int32_t i = 0; i < 6; ++i) {
    MadeView view;
    if (i % 3 == 1) std::fill(view.gray().begin(), view.gray().end(), uint8_t{9});
    EXPECT_EQ(held.consistency.look(view.view(i * kStepNs)) & (kDepthFrozen | kColorFrozen), Faults{0}) << i;
  }
}

// Nothing is kept from frame to frame where each is looked at alone.
TEST(Consistency, AloneAFrameHasNoBefore) {
  HeldConsistency held(false);
  const Faults first = held.consistency.look(MadeView(0, 14).view(0));
  for (int32_t i = 1; i < 6; ++i) EXPECT_EQ(held.consistency.look(MadeView(0, 14).view(i * kStepNs)), first) << i;
}

}  // namespace
}  // namespace sphc
