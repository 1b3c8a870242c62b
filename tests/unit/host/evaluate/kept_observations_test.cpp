#include "host/evaluate/kept_observations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace sphc::host {
namespace {

// TMPDIR is another folder while it lives.
class TemporaryFilesIn {
 public:
  explicit TemporaryFilesIn(const std::string &folder) {
    if (const char *before = std::getenv("TMPDIR")) before_ = before;
    setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryFilesIn() { before_.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before_.c_str(), 1); }

 private:
  std::string before_;
};

std::vector<sphc_localizer_observation> madeUp(uint32_t count, uint32_t first_point) {
  std::vector<sphc_localizer_observation> observations(count);
  for (uint32_t i = 0; i < count; ++i)
    observations[i] = {0.5f * static_cast<float>(i), 3, 2, 1, first_point + i, SPHC_OBSERVATION_MATCHED, 0};
  return observations;
}

std::vector<uint32_t> pointsOf(const std::vector<sphc_localizer_observation> &observations) {
  std::vector<uint32_t> points;
  for (const sphc_localizer_observation &seen : observations) points.push_back(seen.point_index);
  return points;
}

TEST(KeptObservations, AreThoseOfTheirFrameInAnyOrder) {
  KeptObservations kept;
  const uint32_t counts[] = {3, 0, 4096, 1};
  for (uint32_t frame = 0; frame < 4; ++frame) {
    const auto observations = madeUp(counts[frame], 10000 * frame);
    kept.add(observations.data(), observations.size());
    EXPECT_EQ(pointsOf(kept.of(frame)), pointsOf(observations)) << "what comes next goes behind it";
  }
  for (const uint32_t frame : {3u, 0u, 2u, 1u, 2u})
    EXPECT_EQ(pointsOf(kept.of(frame)), pointsOf(madeUp(counts[frame], 10000 * frame)));
}

TEST(KeptObservations, LeaveNoFileBehind) {
  const test::TempFolder folder;
  const TemporaryFilesIn there(folder.path());
  KeptObservations kept;
  const auto observations = madeUp(100, 0);
  kept.add(observations.data(), observations.size());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "not even while it is used";
}

TEST(KeptObservations, AFolderThatIsNotThereIsNamedWithItsCure) {
  const TemporaryFilesIn nowhere("/nonexistent");
  EXPECT_THAT(test::refusal([] { KeptObservations kept; }),
              testing::AllOf(testing::HasSubstr("No such file or directory"),
                             testing::HasSubstr("; make room there, or let TMPDIR name another folder")));
}

}  // namespace
}  // namespace sphc::host
