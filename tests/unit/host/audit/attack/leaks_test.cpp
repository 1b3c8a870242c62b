#include "host/audit/attack/leaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/audit/score/release_scores.h"
#include "host/publish/map_writer.h"
#include "tests/unit/host/audit/made_up_releases.h"

namespace sphc::host {
namespace {

const test::MadeUpRelease &release() {
  static const test::MadeUpRelease made = test::released(test::madeUpRoom(6000, 1), 1, 1.0 / 3);
  return made;
}

TEST(Leaks, NoCueOfTheFileTellsRealFromFake) {
  const std::vector<Cue> cues = fileCues(release().map);
  ASSERT_FALSE(cues.empty());
  for (const Cue &cue : cues) {
    const Auc auc = scoreCue(cue, release().truth);
    // Equal directions are so rare that they say nothing either way.
    EXPECT_LT(std::abs(auc.value - 0.5), 4 * auc.standard_error) << cue.name;
  }
}

// A builder that writes real points first, or leaves a low bit unset, is caught.
TEST(Leaks, CuesOfACarelessBuilderAreSeen) {
  Published map = release().map;
  map.runs = {0, static_cast<uint32_t>(map.packed.size())};
  std::vector<size_t> order(map.packed.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [](size_t a, size_t b) { return release().truth[a].real > release().truth[b].real; });
  std::vector<EntryTruth> truth;
  for (size_t i = 0; i < order.size(); ++i) {
    map.packed[i] = release().map.packed[order[i]];
    truth.push_back(release().truth[order[i]]);
    if (!truth.back().real) map.packed[i].u &= static_cast<uint16_t>(~1u);
  }
  const std::vector<Cue> cues = fileCues(map);
  const auto aucOf = [&](const char *name) {
    const auto cue = std::find_if(cues.begin(), cues.end(), [&](const Cue &c) { return c.name == name; });
    return scoreCue(*cue, truth).value;
  };
  EXPECT_LT(aucOf("rank in run"), 0.01);
  EXPECT_LT(aucOf("rank in file"), 0.01);
  EXPECT_GT(aucOf("bit 0 of u"), 0.7);
}

TEST(Leaks, TheOrderOfFindingShows) {
  EXPECT_LT(std::abs(orderZ(release().map)), 4);
  Published found = release().map;  // as a camera walks past
  found.runs = {0, static_cast<uint32_t>(found.directions.size())};
  std::sort(found.directions.begin(), found.directions.end(),
            [](const Vector3 &a, const Vector3 &b) { return a.x() < b.x(); });
  EXPECT_GT(orderZ(found), 10);
}

TEST(Leaks, EveryByteIsAccountedFor) {
  std::vector<uint8_t> file = release().file;
  EXPECT_EQ(strayBytes(file), 0u);
  file.push_back(1);
  file[92] = 7;  // reserved, in the first row of the section table
  EXPECT_EQ(strayBytes(file), 2u);
  EXPECT_EQ(strayBytes({1, 2, 3}), 3u);
}

// What is shipped of a point: its direction and descriptor.  Colour, track length and sigma change no byte.
TEST(Leaks, NothingElseOfThePointsReachesTheFile) {
  PointModel room = test::madeUpRoom(1000, 1);
  for (ModelPoint &point : room.points) point.observations = 3;
  const std::vector<uint8_t> before = test::released(room, 1, 0.5).file;
  for (ModelPoint &point : room.points) point.observations = 9, point.sigma_m *= 3;
  EXPECT_EQ(test::released(room, 1, 0.5).file, before);
}

}  // namespace
}  // namespace sphc::host
