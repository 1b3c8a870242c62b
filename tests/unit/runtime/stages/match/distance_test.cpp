#include "runtime/stages/match/distance.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

TEST(Distance, SimdEqualsScalarOnRandomDescriptors) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Descriptor a = test::randomDescriptor(&random), b = test::randomDescriptor(&random);
    ASSERT_EQ(distance2(a, b), distance2Scalar(a, b));
  }
}

TEST(Distance, Extremes) {
  Descriptor zero, full;
  std::memset(&zero, 0, sizeof zero);
  std::memset(&full, 255, sizeof full);
  EXPECT_EQ(distance2(zero, full), 128u * 255 * 255);
  EXPECT_EQ(distance2(full, zero), 128u * 255 * 255);
  EXPECT_EQ(distance2(full, full), 0u);
  for (size_t i = 0; i < kDescriptorBytes; ++i) {  // every byte counts, once
    Descriptor one = zero;
    one.bytes[i] = 3;
    EXPECT_EQ(distance2(zero, one), 9u);
  }
}

// A table with ties, and queries taken from it.
struct Tables {
  std::vector<Descriptor> map, queries;

  explicit Tables(uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < 517; ++i) map.push_back(test::randomDescriptor(&random));
    std::memset(&map[40], 0, sizeof map[40]);
    std::memset(&map[41], 255, sizeof map[41]);
    map[300] = map[299];  // a tie: the first one wins
    for (int i = 0; i < 33; ++i) queries.push_back(map[random.below(517)]);
    queries[0] = map[299];
    queries[1] = map[40];
    queries[2] = map[41];
    for (int i = 4; i < 33; i += 2) queries[static_cast<size_t>(i)].bytes[i] ^= 63;
  }
  Span<const Descriptor> mapSpan() const { return {map.data(), map.size()}; }
  Span<const Descriptor> querySpan() const { return {queries.data(), queries.size()}; }
};

void expectSame(const NearestTwo &a, const NearestTwo &b) {
  EXPECT_EQ(a.best2, b.best2);
  EXPECT_EQ(a.second2, b.second2);
  EXPECT_EQ(a.best_index, b.best_index);
}

TEST(Distance, RangeSearchEqualsScalar) {
  const Tables tables(2);
  const uint32_t ranges[][2] = {{0, 517}, {5, 6}, {9, 9}, {3, 131}, {3, 132}, {299, 301}};
  for (const size_t asked : {1u, 2u, 3u, 4u, 5u, 33u}) {
    std::vector<uint32_t> chosen;
    for (size_t k = 0; k < asked; ++k) chosen.push_back(static_cast<uint32_t>(k * 7 % 33));
    for (const auto &range : ranges) {
      for (const uint32_t start : {UINT32_MAX, 90000u}) {
        std::vector<NearestTwo> simd(33, {start, start, UINT32_MAX}), scalar = simd;
        const Span<const uint32_t> these(chosen.data(), chosen.size());
        searchRange(tables.mapSpan(), range[0], range[1], tables.querySpan(), these, {simd.data(), 33});
        searchRangeScalar(tables.mapSpan(), range[0], range[1], tables.querySpan(), these, {scalar.data(), 33});
        for (size_t q = 0; q < 33; ++q) expectSame(simd[q], scalar[q]);
      }
    }
  }
}

TEST(Distance, CandidateSearchEqualsScalar) {
  const Tables tables(3);
  Random random(4);
  for (uint32_t count = 0; count < 20; ++count) {
    std::vector<uint32_t> candidates;
    for (uint32_t i = 0; i < count; ++i) candidates.push_back(random.below(517));
    for (const Descriptor &query : tables.queries) {
      NearestTwo simd = {UINT32_MAX, UINT32_MAX, UINT32_MAX}, scalar = simd;
      searchCandidates(tables.mapSpan(), {candidates.data(), count}, query, &simd);
      searchCandidatesScalar(tables.mapSpan(), {candidates.data(), count}, query, &scalar);
      expectSame(simd, scalar);
    }
  }
}

// Cells in groups: of none, one and several rows.
class Cells {
 public:
  explicit Cells(const Tables &tables) {
    const size_t sizes[] = {1, 4, 0, 7, 3, 30, 2, 5};
    uint32_t begin = 0;
    for (size_t g = 0; g < 8; ++g) {
      groups_.push_back(tables.map[100 + g]);
      begins_.push_back(begin);
      begin += static_cast<uint32_t>(sizes[g]);
    }
    begins_.push_back(begin);
    cells_.assign(tables.map.begin() + 10, tables.map.begin() + 10 + begin);
    group_length2_.resize(groups_.size());
    cell_length2_.resize(cells_.size());
    wide_groups_.resize(groups_.size());
    wide_cells_.resize(cells_.size());
    widenRows({groups_.data(), groups_.size()}, {wide_groups_.data(), wide_groups_.size()},
              {group_length2_.data(), group_length2_.size()});
    widenRows({cells_.data(), cells_.size()}, {wide_cells_.data(), wide_cells_.size()},
              {cell_length2_.data(), cell_length2_.size()});
  }
  CellTable table() const {
    return {{wide_groups_.data(), wide_groups_.size()},
            {wide_cells_.data(), wide_cells_.size()},
            {begins_.data(), begins_.size()},
            {group_length2_.data(), group_length2_.size()},
            {cell_length2_.data(), cell_length2_.size()}};
  }

 private:
  std::vector<Descriptor> groups_, cells_;
  std::vector<WideRow> wide_groups_, wide_cells_;
  std::vector<uint32_t> begins_, group_length2_, cell_length2_;
};

TEST(Distance, RankingCellsEqualsScalarAndIsInOrder) {
  const Tables tables(5);
  const Cells cells(tables);
  for (const size_t visited : {1u, 3u, 8u})
    for (const size_t kept : {1u, 2u, 8u, 32u})
      for (const Descriptor &query : tables.queries) {
        const Ranked far = {UINT32_MAX, UINT32_MAX};
        std::vector<Ranked> groups(visited, far), scalar_groups = groups, simd(kept, far), scalar = simd;
        rankCells(cells.table(), query, {groups.data(), visited}, {simd.data(), kept});
        rankCellsScalar(cells.table(), query, {scalar_groups.data(), visited}, {scalar.data(), kept});
        for (size_t k = 0; k < kept; ++k) {
          ASSERT_EQ(simd[k].distance2, scalar[k].distance2);
          ASSERT_EQ(simd[k].index, scalar[k].index);
          ASSERT_LE(simd[k > 0 ? k - 1 : 0].distance2, simd[k].distance2);
        }
      }
}

TEST(Distance, WideRowsAndLengthsEqualScalar) {
  const Tables tables(6);
  const size_t count = tables.map.size();
  std::vector<WideRow> simd_rows(count), scalar_rows(count);
  std::vector<uint32_t> simd(count), scalar(count);
  widenRows(tables.mapSpan(), {simd_rows.data(), count}, {simd.data(), count});
  widenRowsScalar(tables.mapSpan(), {scalar_rows.data(), count}, {scalar.data(), count});
  EXPECT_EQ(simd, scalar);
  EXPECT_EQ(simd[41], 128u * 255 * 255);
  EXPECT_EQ(std::memcmp(simd_rows.data(), scalar_rows.data(), count * sizeof(WideRow)), 0);
  EXPECT_EQ(simd_rows[41].lanes[127], 255);
}

}  // namespace
}  // namespace sphc
