#include <time.h>

#include <cmath>

#include "lab/match/variant.h"
#include "runtime/stages/match/matcher.h"

namespace sphc::host {

const char kExactName[] = "ours, exact";

double cpuSeconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

namespace {

constexpr float kRatio = 0.8f;
constexpr uint32_t kProbes[] = {4, 8, 16, 32};
constexpr double kConeDegrees[] = {3, 6};

// How a search is asked: the whole map exactly (no probes), through the index, or in cones.
struct Way {
  uint32_t probes = 0;
  double cone_degrees = 0;
};

class OurSearch : public MatchSearch {
 public:
  OurSearch(const MatchCase &c, const Way &way)
      : case_(c), way_(way), cone_cosine_(static_cast<float>(std::cos(way.cone_degrees * kPi / 180))) {
    Arena measure;
    const auto count = static_cast<uint32_t>(c.queries.size());
    Matcher::layout(count, measure, nullptr);
    memory_.resize(measure.used() / sizeof(Line));
    Arena arena(memory_.data());
    Matcher::layout(count, arena, &matcher_);
    matches_.resize(c.queries.size());
  }

  double seconds() override {
    const double begin = cpuSeconds();
    match(0, case_.queries.size(), kRatio);
    return cpuSeconds() - begin;
  }

  // Each query alone: among others it may lose its point to one that is nearer.
  std::vector<TopTwo> answer() override {
    std::vector<TopTwo> answer(case_.queries.size());
    for (size_t q = 0; q < answer.size(); ++q)
      if (match(q, 1, 1.0f) == 1)
        answer[q] = {matches_[0].point_index, std::sqrt(matches_[0].distance2), std::sqrt(matches_[0].second2)};
    return answer;
  }

 private:
  struct alignas(kArenaAlignment) Line {
    unsigned char bytes[kArenaAlignment];
  };

  uint32_t match(size_t first, size_t count, float ratio) {
    const Span<const Descriptor> queries(&case_.queries[first], count);
    const Span<Match> matches(matches_.data(), matches_.size());
    matcher_.ask(case_.map, queries, way_.probes);
    if (way_.cone_degrees > 0)
      return matcher_.matchNear({&case_.expected[first], count}, cone_cosine_, ratio, matches);
    return way_.probes > 0 ? matcher_.matchAll(count, ratio, matches) : matcher_.matchExact(ratio, matches);
  }

  const MatchCase &case_;
  Way way_;
  float cone_cosine_;
  std::vector<Line> memory_;
  Matcher matcher_;
  std::vector<Match> matches_;
};

MatchVariant variantOf(const std::string &name, const Way &way) {
  MatchVariant variant;
  variant.name = name;
  variant.cone_degrees = way.cone_degrees;
  variant.prepare = [way](const MatchCase &c) { return std::make_unique<OurSearch>(c, way); };
  return variant;
}

}  // namespace

std::vector<MatchVariant> ourMatchVariants() {
  std::vector<MatchVariant> variants = {variantOf(kExactName, {})};
  for (const uint32_t probes : kProbes)
    variants.push_back(variantOf("ours, " + std::to_string(probes) + " probes", {probes, 0}));
  for (const double degrees : kConeDegrees)
    variants.push_back(
        variantOf("ours, guided " + std::to_string(static_cast<int>(degrees)) + " deg", {0, degrees}));
  return variants;
}

}  // namespace sphc::host
