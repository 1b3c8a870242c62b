#include "host/audit/score/release_scores.h"

#include <cmath>
#include <set>
#include <string>

#include "host/base/median.h"

namespace sphc::host {

Exposure scoreEntries(const std::vector<uint32_t> &believed, const std::vector<EntryTruth> &truth) {
  Exposure exposure;
  for (uint32_t entry : believed) {
    ++exposure.believed;
    exposure.real += truth[entry].real;
  }
  return exposure;
}

size_t distinctReal(const std::vector<std::vector<uint32_t>> &believed, const std::vector<Published> &releases,
                    const std::vector<std::vector<EntryTruth>> &truths) {
  std::set<std::string> names;
  for (size_t r = 0; r < releases.size(); ++r)
    for (uint32_t entry : believed[r]) {
      const uint8_t *bytes = releases[r].descriptors[entry].bytes;
      if (truths[r][entry].real) names.emplace(bytes, bytes + kDescriptorBytes);
    }
  return names.size();
}

TriangulationScore scoreTriangulation(const Triangulation &attack, const std::vector<EntryTruth> &truth_a,
                                      const std::vector<EntryTruth> &truth_b, double centres_m) {
  TriangulationScore score = {};
  std::vector<double> errors_m;
  for (const TriangulatedPoint &point : attack.points) {
    ++score.both_real.believed;
    score.both_real.real += truth_a[point.a].real && truth_b[point.b].real;
    errors_m.push_back((centres_m * point.position - truth_a[point.a].position_m).norm());
  }
  score.median_error_m = median(std::move(errors_m));
  return score;
}

LearnedScore scoreLearned(const std::vector<std::optional<Vector3>> &learned,
                          const std::vector<EntryTruth> &truth) {
  LearnedScore score;
  std::vector<double> errors_m;
  size_t all_real = 0;
  for (size_t i = 0; i < learned.size(); ++i) {
    all_real += truth[i].real;
    if (!learned[i]) continue;
    ++score.learned.believed;
    score.learned.real += truth[i].real;
    errors_m.push_back(std::abs(learned[i]->norm() - truth[i].position_m.norm()));
  }
  score.share_of_real = all_real ? static_cast<double>(score.learned.real) / static_cast<double>(all_real) : 0;
  score.median_error_m = median(std::move(errors_m));
  return score;
}

Auc scoreCue(const Cue &cue, const std::vector<EntryTruth> &truth) {
  std::vector<bool> real;
  for (const EntryTruth &entry : truth) real.push_back(entry.real);
  return areaUnderCurve(cue.scores, real);
}

}  // namespace sphc::host
