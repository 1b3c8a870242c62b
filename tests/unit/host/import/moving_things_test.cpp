#include "host/import/moving_things.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_numbers.h"
#include "tests/unit/host/import/room_with_things.h"

namespace sphc::host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const Box kCupboard = {{-2.5, -0.5, 3}, {-1.5, 1.5, 3.6}}, kTable = {{0.8, 0.7, 3}, {1.8, 0.8, 3.8}};
const Box kSomebody = {{-0.3, -0.3, 2}, {0.3, 1.5, 2.3}};

// How poses and depth are off.
struct Faults {
  double scale = 1, position_m = 0, turn_rad = 0;
};

// A recording: the holder walks a step to the side between views and turns a little.
class RecordedRoom {
 public:
  explicit RecordedRoom(const Faults &faults = {}) : faults_(faults), random_(1) {}

  void see(const std::vector<Box> &things) {
    seeFrom(standing({0.4 * count_ - 1, 0, 0.1 * count_}, 0.1 - 0.05 * count_), things);
  }
  void seeFrom(const Rigid &camera, std::vector<Box> things) {
    things.insert(things.end(), {kCupboard, kTable});
    RoomView view(camera, things);
    for (uint16_t &mm : view.depth_mm) mm = static_cast<uint16_t>(faults_.scale * mm);
    view.world_from_camera.translation_m += faults_.position_m * test::normalVector(&random_);
    view.world_from_camera.rotation *= rotationFromVector(faults_.turn_rad * test::normalVector(&random_));
    views_.back().add(view.image(), view.world_from_camera);
    for (int32_t row = 2; row < kViewHeight; row += 7)
      for (int32_t column = 2; column < kViewWidth; column += 7) {
        points_.push_back(pointOf(view, column, row));
        points_.back().recording = static_cast<uint32_t>(views_.size() - 1);
      }
    ++count_;
  }
  // What is seen from now on is of a later recording.
  void beginAnother() { views_.emplace_back(depthRig(), 0.3, 6); }
  size_t points() const { return points_.size(); }
  MovingSummary drop() { return dropMoving(views_, &points_); }
  size_t pointsOn(const Box &box) const {
    const Vector3 slack = Vector3::Constant(0.01);
    return static_cast<size_t>(std::count_if(points_.begin(), points_.end(), [&](const TrackedPoint &tracked) {
      const Vector3 &p = tracked.point.position_m;
      return (p - (box.low_m - slack)).minCoeff() > 0 && ((box.high_m + slack) - p).minCoeff() > 0;
    }));
  }

 private:
  Faults faults_;
  Random random_;
  std::vector<DepthViews> views_{{depthRig(), 0.3, 6}};
  std::vector<TrackedPoint> points_;
  int count_ = 0;
};

TEST(MovingThings, WhoWalksThroughLeavesTheMapAndTheRoomStays) {
  RecordedRoom recording;
  for (int i = 0; i < 6; ++i) {
    Box somebody = kSomebody;
    for (Vector3 *corner : {&somebody.low_m, &somebody.high_m}) corner->x() += 0.65 * i - 1.6;
    recording.see({somebody});
  }
  const Box anywhere = {{-2, -0.3, 2}, {2, 1.4, 2.3}};
  const size_t before = recording.points(), on_somebody = recording.pointsOn(anywhere);
  ASSERT_GT(on_somebody, 50u);
  const MovingSummary summary = recording.drop();
  EXPECT_LE(recording.pointsOn(anywhere), on_somebody / 8);  // where one view alone looks
  EXPECT_GE(recording.points(), before - on_somebody - before / 50);
  EXPECT_EQ(summary.seen_through + summary.within_reach, before - recording.points());
  EXPECT_TRUE(summary.doubts.empty());
}

// A thing so small that depth edges of a still room would bring as many.
TEST(MovingThings, FewPointsAreNoMovement) {
  const Box small = {{-0.1, 0.2, 2}, {0.05, 0.35, 2.1}};
  RecordedRoom recording;
  recording.see({small});
  const size_t on_it = recording.pointsOn(small);
  ASSERT_GT(on_it, 0u);
  for (int i = 0; i < 7; ++i) recording.see({});
  const size_t before = recording.points();
  ASSERT_LT(on_it, before / 100);
  const MovingSummary summary = recording.drop();
  EXPECT_EQ(recording.points(), before);
  EXPECT_EQ(summary.seen_through + summary.within_reach, 0u);
}

TEST(MovingThings, WhoStaysIsARoomsThing) {
  RecordedRoom recording;
  for (int i = 0; i < 6; ++i) recording.see({kSomebody});
  const size_t before = recording.points();
  const MovingSummary summary = recording.drop();
  EXPECT_EQ(recording.points(), before);
  EXPECT_EQ(summary.seen_through, 0u);
}

// Of two confirmations and one contradiction nothing follows.
TEST(MovingThings, OneContradictionAgainstTwoConfirmationsIsNotEnough) {
  for (int with : {1, 2}) {
    RecordedRoom recording;
    for (int i = 0; i < with; ++i) recording.see({kSomebody});
    recording.see({});
    const size_t on_somebody = recording.pointsOn(kSomebody);
    ASSERT_GT(on_somebody, 10u);
    recording.drop();
    EXPECT_EQ(recording.pointsOn(kSomebody) > on_somebody / 2, with == 2);
  }
}

TEST(MovingThings, AHandThatNobodyElseConfirmsIsDropped) {
  for (bool is_there_later : {false, true}) {
    const Box hand = {{-0.05, 0.1, 0.4}, {0.05, 0.2, 0.45}};
    RecordedRoom recording;
    recording.seeFrom(standing({0, 0, 0}, 0), {hand});
    // From elsewhere: past it, or towards it.
    recording.seeFrom(standing({0.5, 0, 0}, is_there_later ? -0.5 : 0.9), {hand});
    const size_t on_hand = recording.pointsOn(hand);
    ASSERT_GT(on_hand, 4u);
    const MovingSummary summary = recording.drop();
    EXPECT_EQ(recording.pointsOn(hand) > on_hand / 2, is_there_later);
    EXPECT_EQ(summary.within_reach > 0, !is_there_later);
  }
}

// It looks around and the feet stay where they are: every frame agrees, and none from elsewhere.
TEST(MovingThings, FeetOfOneWhoOnlyLooksAroundAreDropped) {
  const Box shoe = {{-0.1, 1.35, 0.1}, {0.1, 1.45, 0.4}};
  RecordedRoom recording;
  for (int i = 0; i < 4; ++i) {
    const Matrix3 down = rotationFromVector(Vector3(-0.9, 0, 0));
    recording.seeFrom({rotationFromVector(Vector3(0, 0.3 * i - 0.45, 0)) * down, {0, 0, 0}}, {shoe});
    recording.seeFrom(standing({0, 0, 0}, 1.5 * i), {});
  }
  ASSERT_GT(recording.pointsOn(shoe), 4u);
  const size_t on_table = recording.pointsOn(kTable);
  const MovingSummary summary = recording.drop();
  EXPECT_EQ(recording.pointsOn(shoe), 0u);
  EXPECT_EQ(recording.pointsOn(kTable), on_table);
  EXPECT_GT(summary.within_reach, 0u);
}

// Poses of some centimetres and depth of some percent are what a real room gives.
TEST(MovingThings, FaultsOfARealRecordingCostFewPoints) {
  for (const Faults &faults :
       {Faults{1.03, 0, 0}, Faults{0.97, 0, 0}, Faults{1, 0.02, 0.01}, Faults{1.03, 0.02, 0.01}}) {
    RecordedRoom recording(faults);
    for (int i = 0; i < 8; ++i) recording.see({kSomebody});
    const size_t before = recording.points();
    const MovingSummary summary = recording.drop();
    EXPECT_GE(recording.points(), before - before / 20);
    EXPECT_TRUE(summary.doubts.empty());
  }
}

TEST(MovingThings, WherePosesAreWrongNothingIsDroppedAndTheCauseIsNamed) {
  RecordedRoom recording({1, 0.4, 0.3});
  for (int i = 0; i < 8; ++i) recording.see({kSomebody});
  const size_t before = recording.points();
  const MovingSummary summary = recording.drop();
  EXPECT_EQ(recording.points(), before);
  EXPECT_THAT(summary.doubts, ElementsAre(HasSubstr("correct the poses")));
}

// What most frames saw before a wall was taken away is seen through by some after it.
TEST(MovingThings, MoreThanAThirdIsNoMovement) {
  const Box wall = {{-3, -1.1, 2}, {3, 1.5, 2.2}};
  RecordedRoom recording;
  for (int i = 0; i < 4; ++i) recording.seeFrom(standing({0.1 * i, 0, 0}, 0), {wall});
  for (int i = 0; i < 4; ++i) recording.seeFrom(standing({0.1 * i, 0.1, 0}, 0), {});
  const size_t before = recording.points();
  const MovingSummary summary = recording.drop();
  EXPECT_EQ(recording.points(), before);
  EXPECT_EQ(summary.seen_through, 0u);
  EXPECT_THAT(summary.doubts, ElementsAre(HasSubstr("that is no movement")));
}

// Most frames saw the thing, few of a later day see through it: the later ones are right.
TEST(MovingThings, WhatALaterRecordingSeesThroughIsGoneAndWhatItShowsIsNew) {
  Box elsewhere = kSomebody;
  for (Vector3 *corner : {&elsewhere.low_m, &elsewhere.high_m}) corner->x() += 1;
  for (bool are_days : {false, true}) {
    RecordedRoom recording;
    for (int i = 0; i < 10; ++i) recording.seeFrom(standing({0.1 * i - 0.5, 0, 0}, 0), {kSomebody});
    if (are_days) recording.beginAnother();
    for (int i = 0; i < 4; ++i) recording.seeFrom(standing({0.2 * i - 0.4, 0, 0}, 0), {elsewhere});
    const size_t new_ones = recording.pointsOn(elsewhere);
    ASSERT_GT(recording.pointsOn(kSomebody), 100u);
    ASSERT_GT(new_ones, 20u);
    const MovingSummary summary = recording.drop();
    EXPECT_EQ(recording.pointsOn(kSomebody) == 0, are_days);
    EXPECT_EQ(recording.pointsOn(elsewhere) > new_ones * 9 / 10, are_days);
    EXPECT_EQ(summary.gone > 100, are_days);
  }
}

TEST(MovingThings, WhatIsGoneFromOneCornerOfALargePlaceIsGone) {
  RecordedRoom recording;
  for (int i = 0; i < 3; ++i) recording.seeFrom(standing({0.1 * i - 0.1, 0, 0}, 0), {kSomebody});
  for (int i = 0; i < 60; ++i) recording.seeFrom(standing({0.01 * i, 0, 0}, kPi), {kSomebody});
  recording.beginAnother();
  for (int i = 0; i < 4; ++i) recording.seeFrom(standing({0.2 * i - 0.4, 0, 0}, 0), {});
  const size_t on_somebody = recording.pointsOn(kSomebody);
  ASSERT_GT(on_somebody, 20u);
  ASSERT_LT(on_somebody, recording.points() / 100);
  EXPECT_EQ(recording.drop().gone, on_somebody);
  EXPECT_EQ(recording.pointsOn(kSomebody), 0u);
}

// The first day's view says nothing of what came later, and two views of a day are too few.
TEST(MovingThings, OnlyLaterRecordingsTakeAwayAndNotByTwoViews) {
  for (bool is_first : {false, true}) {
    RecordedRoom recording;
    const auto empty = [&] {
      for (int i = 0; i < (is_first ? 6 : 2); ++i) recording.seeFrom(standing({0.2 * i - 0.4, 0, 0}, 0), {});
    };
    if (is_first) empty(), recording.beginAnother();
    for (int i = 0; i < 5; ++i) recording.seeFrom(standing({0.1 * i - 0.2, 0, 0}, 0), {kSomebody});
    if (!is_first) recording.beginAnother(), empty();
    const size_t on_somebody = recording.pointsOn(kSomebody);
    const MovingSummary summary = recording.drop();
    EXPECT_EQ(recording.pointsOn(kSomebody), on_somebody);
    EXPECT_EQ(summary.gone, 0u);
  }
}

TEST(MovingThings, AnotherArrangementOfTheWholePlaceIsNamed) {
  const Box wall = {{-3, -1.1, 2}, {3, 1.5, 2.2}};
  RecordedRoom recording;
  for (int i = 0; i < 8; ++i) recording.seeFrom(standing({0.1 * i, 0, 0}, 0), {wall});
  recording.beginAnother();
  for (int i = 0; i < 4; ++i) recording.seeFrom(standing({0.1 * i, 0.1, 0}, 0), {});
  const size_t before = recording.points();
  const MovingSummary summary = recording.drop();
  EXPECT_EQ(recording.points(), before);
  EXPECT_THAT(summary.doubts, ElementsAre(HasSubstr("map the later recordings alone")));
}

TEST(MovingThings, OneFrameContradictsNothing) {
  RecordedRoom recording;
  recording.seeFrom(standing({0, 0, 0}, 0), {{{-0.05, 0.1, 0.4}, {0.05, 0.2, 0.45}}});
  const size_t before = recording.points();
  recording.drop();
  EXPECT_EQ(recording.points(), before);
}

}  // namespace
}  // namespace sphc::host
