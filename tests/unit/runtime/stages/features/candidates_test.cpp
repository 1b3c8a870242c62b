#include "runtime/stages/features/candidates.h"

#include <gtest/gtest.h>

#include "tests/support/arena_memory.h"

namespace sphc {
namespace {

FeatureConfig configFor(uint32_t max_keypoints) {
  FeatureConfig config;
  config.width = 640;
  config.height = 480;
  config.max_keypoints = max_keypoints;
  return config;
}

class Candidates {
 public:
  explicit Candidates(uint32_t max_keypoints)
      : config_(configFor(max_keypoints)), memory_([this](Arena &arena, bool real) {
          CandidateList::layout(config_, arena, real ? &list_ : nullptr);
        }) {
    list_.clear();
  }
  // At a place of an octave, and of that scale.
  void push(float x, float y, float response, int8_t octave = 0, float sigma = 2) {
    list_.push({response, response * sigma, x, y, 1, octave, 1, false});
  }
  Span<Candidate> choose() { return list_.choose(config_, config_.max_keypoints); }

 private:
  FeatureConfig config_;
  CandidateList list_;
  test::ArenaMemory memory_;
};

TEST(Candidates, HighestResponseFirst) {
  Candidates candidates(10);
  for (const float response : {0.2f, 0.5f, 0.1f, 0.4f}) candidates.push(1000 * response, 100, response);
  const auto chosen = candidates.choose();
  ASSERT_EQ(chosen.size(), 4u);
  for (size_t i = 1; i < chosen.size(); ++i) EXPECT_GT(chosen[i - 1].response, chosen[i].response);
}

TEST(Candidates, OfOneStructureTheStrongerStays) {
  Candidates candidates(10);
  candidates.push(100, 100, 0.1f);
  candidates.push(100.5f, 100, 0.3f);         // within half a sigma
  candidates.push(50.1f, 50, 0.2f, 1, 2.2f);  // the same place from the octave above
  candidates.push(102, 100, 0.05f);           // beside it
  candidates.push(100, 100, 0.04f, 0, 4);     // larger
  const auto chosen = candidates.choose();
  ASSERT_EQ(chosen.size(), 3u);
  EXPECT_EQ(chosen[0].response, 0.3f);
  EXPECT_EQ(chosen[1].response, 0.05f);
  EXPECT_EQ(chosen[2].response, 0.04f);
}

// One corner of the image has the strongest, and does not get them all.
TEST(Candidates, CellsShareTheKeypoints) {
  Candidates candidates(96);  // 2 a cell; 3 times as many, and one, at first
  for (int i = 0; i < 100; ++i)
    candidates.push(static_cast<float>(4 * (i % 10)), static_cast<float>(4 * (i / 10)), 1);
  for (int i = 0; i < 90; ++i)
    candidates.push(300 + 4.0f * static_cast<float>(i % 10), 100 + 4.0f * static_cast<float>(i / 10), 0.1f);
  uint32_t weak = 0;
  const auto chosen = candidates.choose();
  ASSERT_EQ(chosen.size(), 96u);
  for (const Candidate &c : chosen) weak += c.response == 0.1f;
  EXPECT_GE(weak, 7u);
  EXPECT_LT(weak, 50u);
}

TEST(Candidates, TheWeakestMakeRoomWhereThereIsNone) {
  constexpr int kMany = 20000;
  Candidates candidates(100);
  for (int i = 0; i < kMany; ++i)  // the weakest first and last
    candidates.push(static_cast<float>(3 * (i % 200)), static_cast<float>(3 * (i / 200)),
                    i == kMany / 2 ? 0.9f : 0.1f + 1e-6f * static_cast<float>(i % 1000));
  const auto chosen = candidates.choose();
  ASSERT_EQ(chosen.size(), 100u);
  EXPECT_EQ(chosen[0].response, 0.9f);
}

}  // namespace
}  // namespace sphc
