// One interleaved run of matchers on one map: every variant in turn, again and again, so that whatever slows the
// machine slows all alike.
#pragma once
#include <functional>

#include "lab/match/variant.h"

namespace sphc::host {

// Beyond this distance two descriptors have nothing to do with each other, as for the matcher itself.
constexpr double kUnrelatedDistance = 300;
constexpr double kMatchRatio = 0.8;

// The two nearest points of each query, by comparing with every one; in a cone around where it is expected, unless
// `cone_degrees` is 0.  `candidates`: points compared with a query, mean.
std::vector<TopTwo> exactTopTwo(const MatchCase &c, double cone_degrees, double *candidates);

// An answer held against the exact one.
struct MatchQuality {
  double recall1 = 0;       // of the queries whose exact nearest is related: how many have the same nearest
  double ratio_recall = 0;  // of the matches that the exact answer accepts by the ratio test: how many are accepted
  size_t accepted = 0;      // matches that pass the ratio test
  size_t correct = 0;       // of them, those within a degree of where the query is expected
};
MatchQuality judgeMatches(const MatchCase &c, const std::vector<TopTwo> &answer, const std::vector<TopTwo> &exact);

struct MatchRow {
  std::string name;
  double cone_degrees = 0;
  double candidates = 0;  // for guided: points in the cone, mean
  double time_ms = 0;     // median
  MatchQuality quality;
  double times_faster_than_ivf = 0;  // than the fastest faiss IVF of at least this ratio_recall; NaN without
};

struct MatchTable {
  size_t points = 0, queries = 0, cells = 0;
  double bytes_per_point = 0, build_seconds = 0;
  std::vector<MatchRow> rows;
};

using MatchDone = std::function<void(uint32_t done, uint32_t total)>;
// Absent variants are left out, and so are those for which the map is too large.
MatchTable runMatchBench(const MatchCase &c, const std::vector<MatchVariant> &variants, uint32_t repeats,
                         const MatchDone &done);

}  // namespace sphc::host
