#include "host/cli/common/contradictions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <spherecloud/spherecloud.hpp>
#include <string>

namespace sphc::host {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

RgbdImportSummary soundWalk() {
  RgbdImportSummary summary;
  summary.frames_used = 40;
  summary.lifted = 40000;
  summary.merged = 16000;
  summary.moving.disagreement = 0.004;
  return summary;
}

TEST(Contradictions, ASoundWalkHasNone) {
  EXPECT_THAT(contradictionsOf(soundWalk()), IsEmpty());
  EXPECT_THAT(faultsOfFrames(soundWalk()), IsEmpty());
  RgbdImportSummary thin = soundWalk();  // views that hardly overlap
  thin.merged = 800;
  EXPECT_THAT(contradictionsOf(thin), IsEmpty());
}

TEST(Contradictions, PosesThatAreNotOfTheFramesAre) {
  RgbdImportSummary millimetres = soundWalk();
  millimetres.merged = 0;
  millimetres.moving.disagreement = 0;  // nothing lies where it could be compared
  EXPECT_THAT(contradictionsOf(millimetres), ElementsAre(HasSubstr("in metres")));
  RgbdImportSummary inverted = soundWalk();
  inverted.merged = 1300;
  inverted.moving.disagreement = 0.07;
  EXPECT_THAT(contradictionsOf(inverted), ElementsAre(HasSubstr("7 % of the depth")));
  inverted.merged = 16000;  // frames from step to step
  EXPECT_THAT(contradictionsOf(inverted), IsEmpty()) << "a telephone may be so";
  inverted.moving.disagreement = 0.09;
  EXPECT_THAT(contradictionsOf(inverted), ElementsAre(HasSubstr("9 % of the depth")));
  inverted.frames_used = 9;
  EXPECT_THAT(contradictionsOf(inverted), IsEmpty()) << "too few to tell";
}

TEST(Contradictions, AFaultOfMostFramesIsAndOneOfSomeIsTold) {
  RgbdImportSummary late = soundWalk();
  const auto in_all = [&](uint32_t frames) {
    while (late.frames_with_fault.of(SPHC_FAULT_DEPTH_COLOR_DISAGREE) < frames)
      late.frames_with_fault.add(SPHC_FAULT_DEPTH_COLOR_DISAGREE);
  };
  in_all(4);
  EXPECT_THAT(faultsOfFrames(late), IsEmpty()) << "of the scene, it may be";
  in_all(5);
  EXPECT_THAT(faultsOfFrames(late), ElementsAre(HasSubstr("depth and colour disagree in 5 of 40 frames: edges")));
  EXPECT_THAT(contradictionsOf(late), IsEmpty());
  in_all(31);
  EXPECT_THAT(contradictionsOf(late), ElementsAre(HasSubstr("in 31 of 40 frames")));
}

TEST(Contradictions, ThoseOfPosesAreWithoutFaultsOfImages) {
  RgbdImportSummary walk = soundWalk();
  walk.scale = {4300, 222, 3580, 0.5};
  for (int i = 0; i < 40; ++i) walk.frames_with_fault.add(SPHC_FAULT_DEPTH_COLOR_DISAGREE);
  EXPECT_THAT(contradictionsOf(walk), SizeIs(2));
  EXPECT_THAT(contradictionsOfPoses(walk), ElementsAre(HasSubstr("times as far by the poses as by depth")));
}

TEST(Contradictions, OfFewFramesAreNotFoundAndThatIsSaid) {
  EXPECT_THAT(doubtsOfPoses(soundWalk()), IsEmpty());
  RgbdImportSummary few = soundWalk();
  few.frames_used = 9;
  few.frames_without_pose = 90;
  few.frames_unreadable = 1;
  EXPECT_THAT(doubtsOfPoses(few), ElementsAre(HasSubstr("scale and consistency could not be checked: 9 of 100 "
                                                        "frames have a pose")));
}

TEST(Contradictions, AMistakeThatCorrectedPosesHaveNotIsNamed) {
  RgbdImportSummary walk = soundWalk();
  walk.scale = {3900, 3200, 3200, 1, 3100, "poses are inverse"};
  EXPECT_THAT(contradictionsOf(walk), IsEmpty()) << "of a camera that hardly turns";
  walk.scale = {3900, 200, 300, 2, 3100, "poses are inverse: invert each"};
  walk.moving.disagreement = 0.09;
  EXPECT_THAT(contradictionsOf(walk),
              ElementsAre("poses are inverse: invert each. Then 3100 of 3900 keypoints that two frames share lie "
                          "where the poses say, and now 200"))
      << "alone, since it says why the frames disagree";
  walk.moving.disagreement = 0.004;
  walk.scale = {60, 0, 0, 1, 30, "poses are inverse"};
  EXPECT_THAT(contradictionsOf(walk), IsEmpty()) << "too few to tell";
  walk.scale = {7000, 5, 12, 2, 77, "poses are inverse"};
  EXPECT_THAT(contradictionsOf(walk), ElementsAre(HasSubstr("only 12 lie where the poses say")))
      << "a correction by which hardly more agree is none";
}

// A walk of which four parts are so; the whole agrees by half, and no correction of all of it would help.
RgbdImportSummary walkOfParts(const PoseScale &first, const PoseScale &second, const PoseScale &third,
                              const PoseScale &fourth) {
  RgbdImportSummary walk = soundWalk();
  walk.scale = {1600, 770, 770, 1, 760, "poses are inverse"};
  walk.scale_parts = {{0, 0, 9, first}, {0, 10, 19, second}, {0, 20, 29, third}, {0, 30, 39, fourth}};
  return walk;
}

TEST(Contradictions, APartThatIsUnlikeOthersIsNamedWithItsFrames) {
  const PoseScale sound = {400, 320, 320, 1, 100, "poses are inverse"};
  const PoseScale inverse = {400, 20, 30, 2, 310, "poses are inverse"};
  const PoseScale twice = {400, 20, 300, 0.5}, odd = {400, 20, 30, 3};
  EXPECT_THAT(contradictionsOf(walkOfParts(sound, sound, sound, sound)), IsEmpty());
  EXPECT_THAT(
      contradictionsOf(walkOfParts(sound, sound, inverse, inverse)),
      ElementsAre("about frames 20 to 39, unlike others: poses are inverse. Then 620 of 800 keypoints that two "
                  "frames share lie where the poses say, and now 40"));
  EXPECT_THAT(contradictionsOf(walkOfParts(twice, sound, sound, odd)),
              ElementsAre(AllOf(HasSubstr("frames 0 to 9, unlike others: the camera goes about 2.0 times"),
                                HasSubstr("focal lengths"), Not(HasSubstr("depth_unit_m")))));
  EXPECT_THAT(contradictionsOf(walkOfParts(sound, sound, sound, odd)), IsEmpty()) << "it may have been shaken";
  const PoseScale few = {90, 5, 10, 2, 80, "poses are inverse"};
  EXPECT_THAT(contradictionsOf(walkOfParts(sound, sound, sound, few)), IsEmpty()) << "too few to tell";
  RgbdImportSummary all = walkOfParts(inverse, inverse, inverse, inverse);
  all.scale = {1600, 80, 120, 2, 1240, "poses are inverse"};
  EXPECT_THAT(contradictionsOf(all), ElementsAre(testing::StartsWith("poses are inverse.")));
  RgbdImportSummary two = walkOfParts(sound, sound, inverse, inverse);
  two.scale_parts[2].recording = two.scale_parts[3].recording = 1;
  EXPECT_THAT(contradictionsOf(two),
              ElementsAre(testing::StartsWith("about frames 20 to 39 of recording 2, unlike")));
  two = walkOfParts(sound, sound, twice, twice);
  two.scale_parts[2].recording = two.scale_parts[3].recording = 1;
  EXPECT_THAT(contradictionsOf(two), ElementsAre(HasSubstr("depth_unit_m"))) << "its own calibration";
}

TEST(Contradictions, AMenuOverMostOfWhatIsSeenIsNone) {
  RgbdImportSummary walk = soundWalk();
  walk.scale = {600, 90, 90, 1, 0, "", 450};
  EXPECT_THAT(contradictionsOf(walk), IsEmpty());
  walk.scale = {600, 5, 10, 3, 0, "", 560};
  EXPECT_THAT(contradictionsOf(walk), SizeIs(1)) << "a camera that rests, by poses that do not";
}

TEST(Contradictions, AShareBetweenSoundAndContradictionIsDoubted) {
  RgbdImportSummary walk = soundWalk();
  walk.scale = {303, 188, 188, 1};
  EXPECT_THAT(doubtsOfPoses(walk), IsEmpty());
  walk.scale = {303, 150, 150, 1};
  EXPECT_THAT(doubtsOfPoses(walk), ElementsAre(HasSubstr("only 49 % lie where poses and depth say, and of sound")));
  walk.scale = {90, 40, 40, 1};
  EXPECT_THAT(doubtsOfPoses(walk), IsEmpty()) << "too few to tell";
  const PoseScale sound = {400, 320, 320, 1}, weak = {400, 160, 160, 1}, thin = {120, 48, 48, 1};
  const PoseScale odd = {150, 6, 9, 3};
  EXPECT_THAT(doubtsOfPoses(walkOfParts(sound, sound, sound, odd)),
              ElementsAre(HasSubstr("only 4 % lie where poses and depth say in about frames 30 to 39")));
  EXPECT_THAT(doubtsOfPoses(walkOfParts(sound, sound, weak, sound)),
              ElementsAre(HasSubstr("only 40 % lie where poses and depth say in about frames 20 to 29")));
  EXPECT_THAT(doubtsOfPoses(walkOfParts(weak, sound, weak, weak)),
              ElementsAre(HasSubstr("only 48 % lie where poses and depth say, and")))
      << "once, for all";
  RgbdImportSummary far_apart = walkOfParts(sound, sound, thin, sound);
  far_apart.scale.agree = 1000;
  EXPECT_THAT(doubtsOfPoses(far_apart), IsEmpty()) << "as where frames are far apart";
  walk.scale = {600, 250, 250, 1, 0, "", 300};
  EXPECT_THAT(doubtsOfPoses(walk), IsEmpty()) << "under a menu that is drawn over the image";
  walk.scale = {4300, 222, 3580, 0.5};
  EXPECT_THAT(doubtsOfPoses(walk), IsEmpty()) << "it is a contradiction";
}

TEST(Contradictions, AnotherScaleIsNamed) {
  RgbdImportSummary walk = soundWalk();
  walk.scale = {3900, 3200, 3200, 1};
  EXPECT_THAT(contradictionsOf(walk), IsEmpty());
  walk.scale = {303, 188, 192, 1.06};
  EXPECT_THAT(contradictionsOf(walk), IsEmpty()) << "a few per cent are not told apart";
  walk.scale = {4300, 222, 3580, 0.5};
  EXPECT_THAT(contradictionsOf(walk), ElementsAre(HasSubstr("about 2.0 times as far by the poses as by depth")));
  walk.scale = {60, 0, 30, 0.5};
  EXPECT_THAT(contradictionsOf(walk), IsEmpty()) << "too few to tell";
  walk.scale = {400, 20, 90, 3};
  EXPECT_THAT(contradictionsOf(walk), ElementsAre(HasSubstr("about 0.3 times")));
  for (const uint32_t chance : {30u, 60u}) {  // of inverse poses some agree with some multiple
    walk.scale = {400, 20, chance, 3};
    EXPECT_THAT(contradictionsOf(walk),
                ElementsAre(HasSubstr("only " + std::to_string(chance) + " lie where the poses say")));
  }
}

}  // namespace
}  // namespace sphc::host
