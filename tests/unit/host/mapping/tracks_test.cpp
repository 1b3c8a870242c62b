#include "host/mapping/tracks.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

FrameLink linkOf(uint32_t a, uint32_t b, std::vector<PointMatch> matches, uint32_t inliers) {
  FrameLink link;
  link.frames = {a, b};
  link.matches = std::move(matches);
  link.inliers = inliers;
  return link;
}

class TracksTest : public testing::Test {
 protected:
  TracksTest() {
    for (WalkFrame &frame : frames_) frame.points.resize(4);
  }
  std::vector<WalkFrame> frames_ = std::vector<WalkFrame>(4);
};

TEST_F(TracksTest, MatchesAreJoinedOverFrames) {
  const std::vector<Track> tracks = tracksOf(frames_, {linkOf(0, 1, {{0, 1}}, 50), linkOf(1, 3, {{1, 2}}, 40)});
  ASSERT_EQ(tracks.size(), 1u);
  ASSERT_EQ(tracks[0].size(), 3u);
  EXPECT_EQ(tracks[0][2].frame, 3u);
  EXPECT_EQ(tracks[0][2].point, 2u);
}

TEST_F(TracksTest, TwoKeypointsOfOneFrameAreNeverOnePoint) {
  // The weaker link says that keypoints 0 and 3 of frame 0 are one.
  const std::vector<Track> tracks =
      tracksOf(frames_, {linkOf(1, 2, {{1, 1}}, 90), linkOf(0, 2, {{3, 1}}, 20), linkOf(0, 1, {{0, 1}}, 60)});
  ASSERT_EQ(tracks.size(), 1u);
  ASSERT_EQ(tracks[0].size(), 3u);
  EXPECT_EQ(tracks[0][0].point, 0u);
}

TEST_F(TracksTest, KeypointsThatNothingMatchesAreInNone) {
  const std::vector<Track> tracks = tracksOf(frames_, {linkOf(0, 1, {{0, 0}}, 50)});
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].size(), 2u);
}

TEST_F(TracksTest, LongTracksComeFirstUntilEveryFrameHasEnough) {
  const Track longer = {{0, 0}, {1, 0}, {2, 0}}, shorter = {{0, 1}, {1, 1}}, other = {{2, 1}, {3, 1}};
  const std::vector<Track> taken = enoughTracks({shorter, other, longer}, 4, {1, 1, 10});
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_EQ(taken[0].size(), 3u);
  EXPECT_EQ(taken[1][1].frame, 3u);
}

TEST_F(TracksTest, PairsComeInWhereLongerTracksAreFew) {
  const std::vector<Track> tracks = {{{0, 0}, {1, 0}, {2, 0}}, {{0, 1}, {1, 1}}, {{2, 1}, {3, 1}}};
  EXPECT_EQ(enoughTracks(tracks, 4, {10, 0, 10}).size(), 1u);
  const std::vector<Track> taken = enoughTracks(tracks, 4, {10, 1, 10});
  ASSERT_EQ(taken.size(), 2u) << "frame 3 has nothing else";
  EXPECT_EQ(taken[1][1].frame, 3u);
}

TEST_F(TracksTest, OfALongTrackEvenlySpreadSightingsStay) {
  constexpr uint32_t kFrames = 100, kTracks = 50, kLongest = 10;
  std::vector<Track> tracks(kTracks);
  for (uint32_t i = 0; i < kTracks; ++i)
    for (uint32_t frame = 0; frame < kFrames; ++frame) tracks[i].push_back({frame, i});
  std::vector<size_t> of_frame(kFrames);
  for (const Track &track : enoughTracks(tracks, kFrames, {kTracks, 0, kLongest})) {
    ASSERT_EQ(track.size(), size_t{kLongest});
    for (size_t i = 1; i < track.size(); ++i) EXPECT_NEAR(track[i].frame - track[i - 1].frame, 10, 1);
    for (const Sighting &sighting : track) ++of_frame[sighting.frame];
  }
  // The same in every frame, though no track has them all.
  for (size_t sightings : of_frame) EXPECT_NEAR(static_cast<double>(sightings), 5, 1);
}

}  // namespace
}  // namespace sphc::host
