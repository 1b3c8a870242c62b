#include "host/mapping/walk_times.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/recording/calibration_json.h"
#include "host/recording/mcap/records.h"
#include "spotted_images.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

constexpr double kPeriodS = 1.0 / 30;

// Lists of images that nobody reads, for ten seconds.
class WalkTimesTest : public testing::Test {
 protected:
  static std::string list(double from_s, double period_s, double pause_s = 0) {
    std::string text;
    for (int i = 0; i < static_cast<int>(10 / period_s); ++i)
      text += std::to_string(100 + from_s + i * period_s + (i >= 60 ? pause_s : 0)) + " none.png\n";
    return text;
  }
  WalkTimes times(const std::string &color, const std::string &depth) const {
    folder_.write("rgb.txt", color);
    folder_.write("depth.txt", depth);
    recording::writeCalibration(folder_ / "calibration.json", spottedRig());
    return timesOf(recording::RecordingReader(folder_.path()));
  }
  test::TempFolder folder_;
};

TEST_F(WalkTimesTest, SoundClocksShowNothing) {
  const WalkTimes found = times(list(0, kPeriodS), list(0.003, kPeriodS));
  EXPECT_NEAR(found.apart_s, 0.003, 1e-5);
  EXPECT_NEAR(found.drifted_s, 0, 1e-5);
  EXPECT_EQ(found.unpaired, 0);
  EXPECT_TRUE(found.pauses.empty());
}

TEST_F(WalkTimesTest, ADepthCameraOfAnotherPaceIsNoFault) {
  const WalkTimes found = times(list(0, kPeriodS), list(0.001, 6 * kPeriodS));
  EXPECT_EQ(found.unpaired, 0);
  EXPECT_NEAR(found.drifted_s, 0, 1e-3);
}

// Depth runs 1 % slow: in ten seconds it falls behind by three images, and each colour image still finds one.
TEST_F(WalkTimesTest, ADriftIsSeenThroughChangingPartners) {
  const WalkTimes found = times(list(0, kPeriodS), list(0, 1.01 * kPeriodS));
  EXPECT_NEAR(std::abs(found.drift_s_per_s), 0.01, 1e-3);
  EXPECT_NEAR(std::abs(found.drifted_s), 0.1, 0.01);
}

TEST_F(WalkTimesTest, ImagesWithoutAPartnerAreCounted) {
  const WalkTimes found = times(list(0, 0.1), list(0.045, 0.1) + std::to_string(111.0) + " none.png\n");
  EXPECT_GT(found.unpaired, 0.9);
}

TEST_F(WalkTimesTest, APauseIsNamedByItsTimes) {
  const WalkTimes found = times(list(0, kPeriodS, 5), list(0, kPeriodS, 5));
  ASSERT_EQ(found.pauses.size(), 1u);
  EXPECT_NEAR(found.pauses[0].from_s, 59 * kPeriodS, 1e-5);
  EXPECT_NEAR(found.pauses[0].to_s, 60 * kPeriodS + 5, 1e-5);
}

// A clock is set back by a second after the third frame.
TEST_F(WalkTimesTest, ImagesWhoseTimesGoBackwardsAreCounted) {
  using recording::Bytes, recording::Kind;
  Bytes records, file(recording::kMcapMagic, recording::kMcapMagic + sizeof recording::kMcapMagic);
  recording::putSchemasAndChannels(records, {Kind::kColorImage, Kind::kDepthImage});
  uint32_t sequence = 0;
  for (const uint64_t time_ms : {2000, 2033, 2066, 1099, 1132}) {
    for (const Kind kind : {Kind::kColorImage, Kind::kDepthImage})
      recording::putMessage(records, static_cast<uint16_t>(kind), sequence, 1000000 * time_ms,
                            recording::viewOf(Bytes(64)));
    ++sequence;
  }
  recording::putHeader(file, "ros2", "test");
  recording::putRecord(file, recording::Op::kChunk, [&] {
    recording::putChunkHead(file, {0, 0, records.size(), 0, "", records.size()});
    recording::append(file, records.data(), records.size());
  });
  recording::putDataEnd(file, 0);
  folder_.write("walk.mcap", {file.begin(), file.end()});
  recording::ReaderOptions options;
  options.calibration = folder_ / "calibration.json";
  recording::writeCalibration(options.calibration, spottedRig());
  const recording::RecordingReader reader(folder_ / "walk.mcap", options);
  EXPECT_EQ(timesOf(reader).backward, 4u);
  EXPECT_EQ(reader.frameCount(), 3u);
}

}  // namespace
}  // namespace sphc::host
