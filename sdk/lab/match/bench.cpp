#include "lab/match/bench.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "host/base/median.h"

namespace sphc::host {
namespace {

constexpr double kSlowSeconds = 1;  // a search that takes longer is not repeated
constexpr double kCorrectDegrees = 1;
constexpr char kIvfPrefix[] = "faiss ivf";

float cosineOf(double degrees) { return static_cast<float>(std::cos(degrees * kPi / 180)); }

float dot(const Direction &a, const Direction &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

bool related(const TopTwo &two) { return two.index >= 0 && two.best < kUnrelatedDistance; }

bool accepted(const TopTwo &two) {
  return related(two) && two.best < kMatchRatio * std::min(two.second, kUnrelatedDistance);
}

uint32_t squaredDistance(const Descriptor &a, const Descriptor &b) {
  int32_t sum = 0;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const int32_t difference = a.bytes[i] - b.bytes[i];
    sum += difference * difference;
  }
  return static_cast<uint32_t>(sum);
}

struct Runner {
  const MatchVariant *variant;
  std::unique_ptr<MatchSearch> search;
  std::vector<double> seconds;
};

std::vector<Runner> prepareAll(const MatchCase &c, const std::vector<MatchVariant> &variants) {
  std::vector<Runner> runners;
  for (const MatchVariant &variant : variants)
    if (variant.prepare && c.map.pointCount() <= variant.largest_map)
      runners.push_back({&variant, variant.prepare(c), {}});
  return runners;
}

void compareWithIvf(std::vector<MatchRow> *rows) {
  for (MatchRow &row : *rows) {
    double best_ms = std::numeric_limits<double>::infinity();
    for (const MatchRow &peer : *rows)
      if (peer.name.rfind(kIvfPrefix, 0) == 0 && peer.quality.ratio_recall >= row.quality.ratio_recall)
        best_ms = std::min(best_ms, peer.time_ms);
    const bool comparable = row.cone_degrees == 0 && std::isfinite(best_ms);
    row.times_faster_than_ivf = comparable ? best_ms / row.time_ms : std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

std::vector<TopTwo> exactTopTwo(const MatchCase &c, double cone_degrees, double *candidates) {
  const float cosine = cosineOf(cone_degrees);
  std::vector<Direction> directions;
  for (uint32_t i = 0; i < c.map.pointCount(); ++i) directions.push_back(c.map.direction(i));
  std::vector<TopTwo> answer(c.queries.size());
  size_t compared = 0;
  for (size_t q = 0; q < c.queries.size(); ++q) {
    uint32_t best = UINT32_MAX, second = UINT32_MAX;
    for (uint32_t i = 0; i < c.map.pointCount(); ++i) {
      if (cone_degrees > 0 && !(dot(directions[i], c.expected[q]) > cosine)) continue;
      ++compared;
      const uint32_t distance2 = squaredDistance(c.map.descriptor(i), c.queries[q]);
      if (distance2 < best) {
        second = best;
        best = distance2;
        answer[q].index = i;
      } else if (distance2 < second) {
        second = distance2;
      }
    }
    answer[q].best = std::sqrt(best);
    answer[q].second = std::sqrt(second);
  }
  *candidates = static_cast<double>(compared) / static_cast<double>(c.queries.size());
  return answer;
}

MatchQuality judgeMatches(const MatchCase &c, const std::vector<TopTwo> &answer, const std::vector<TopTwo> &exact) {
  MatchQuality quality;
  size_t related_count = 0, same = 0, exact_accepted = 0, kept = 0;
  for (size_t q = 0; q < exact.size(); ++q) {
    // another point at the same distance is as good
    const bool agrees = answer[q].index >= 0 &&
                        (answer[q].index == exact[q].index || std::abs(answer[q].best - exact[q].best) < 1e-3);
    if (related(exact[q])) {
      ++related_count;
      same += agrees;
    }
    if (accepted(exact[q])) {
      ++exact_accepted;
      kept += agrees && accepted(answer[q]);
    }
    if (!accepted(answer[q])) continue;
    ++quality.accepted;
    const Direction found = c.map.direction(static_cast<uint32_t>(answer[q].index));
    quality.correct += dot(found, c.expected[q]) > cosineOf(kCorrectDegrees);
  }
  const auto share = [](size_t part, size_t all) {
    return all ? static_cast<double>(part) / static_cast<double>(all) : 1.0;
  };
  quality.recall1 = share(same, related_count);
  quality.ratio_recall = share(kept, exact_accepted);
  return quality;
}

MatchTable runMatchBench(const MatchCase &c, const std::vector<MatchVariant> &variants, uint32_t repeats,
                         const MatchDone &done) {
  MatchTable table = {c.map.pointCount(), c.queries.size(),
                      c.map.cellCount(),  c.map_bytes / c.map.pointCount(),
                      c.build_seconds,    {}};
  std::vector<Runner> runners = prepareAll(c, variants);
  for (uint32_t repeat = 0; repeat < repeats; ++repeat) {
    for (Runner &runner : runners)
      if (repeat == 0 || runner.seconds[0] < kSlowSeconds) runner.seconds.push_back(runner.search->seconds());
    if (done) done(repeat + 1, repeats);
  }
  std::map<double, std::pair<std::vector<TopTwo>, double>> exact;  // by cone
  for (const Runner &runner : runners) {
    const double cone = runner.variant->cone_degrees;
    if (!exact.count(cone)) exact[cone].first = exactTopTwo(c, cone, &exact[cone].second);
    MatchRow row;
    row.name = runner.variant->name;
    row.cone_degrees = cone;
    row.candidates = cone > 0 ? exact[cone].second : 0;
    row.time_ms = 1e3 * median(runner.seconds);
    row.quality = judgeMatches(c, runner.search->answer(), exact[cone].first);
    table.rows.push_back(row);
  }
  compareWithIvf(&table.rows);
  return table;
}

}  // namespace sphc::host
