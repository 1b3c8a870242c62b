#include "host/frames/damage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sphc::host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(DamageText, OfAWholeRecordingIsNone) { EXPECT_THAT(sentencesOf(damageOf({})), IsEmpty()); }

TEST(DamageText, HasASentenceForEachKind) {
  recording::Recording recording;
  recording.lost_count = 5;
  recording.backward_count = 4;
  recording.bad_pose_count = 2;
  recording.bad_acceleration_count = 3;
  recording.is_cut = true;
  recording.pose_fault = "it has no poses: why";
  EXPECT_THAT(sentencesOf(damageOf(recording)),
              ElementsAre(StartsWith("it was cut off;"), StartsWith("missing: 1 image,"),
                          HasSubstr("4 images, whose times are not after those of the images before them: a clock"),
                          StartsWith("left out: 2 poses,"), StartsWith("left out: 3 accelerations,"),
                          "it has no poses: why"));
}

TEST(DamageText, OfChangedBytesHasTheCure) {
  recording::Recording recording;
  recording.bad_chunk_count = 1;
  EXPECT_THAT(sentencesOf(damageOf(recording)),
              ElementsAre("left out: 1 part with changed bytes; copy it again from where it was recorded"));
  recording.is_cut = true;
  EXPECT_THAT(sentencesOf(damageOf(recording)),
              ElementsAre(StartsWith("left out: 1 part"), StartsWith("it was cut off;")));
}

}  // namespace
}  // namespace sphc::host
