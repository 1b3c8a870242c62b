#include "host/audit/attack/real_or_fake.h"

#include <nlohmann/json.hpp>

#include "host/audit/attack/stack_classifier.h"
#include "host/audit/attack/stack_features.h"
#include "host/audit/attack/stacks.h"

namespace sphc::host {
namespace {

constexpr Eigen::Index kFromNeighbours = 5;
const char *const kKnownStrategies[] = {"gaussian", "patchwork"}, *const kStackedStrategies[] = {"patchwork",
                                                                                                 "warped"};

Eigen::ArrayXf sigmoid(const Eigen::ArrayXf &logits) { return 1 / (1 + (-logits).exp()); }

RealOrFakeGuess guess(const std::string &attacker, const Eigen::ArrayXf &scores) {
  return {attacker, {scores.begin(), scores.end()}};
}

RealOrFakeGuess cue(const std::string &attacker, const Eigen::ArrayXf &scores) {
  return {attacker, {scores.begin(), scores.end()}, true};
}

}  // namespace

RealOrFakeClassifier::RealOrFakeClassifier(const std::string &path)
    : RealOrFakeClassifier(readModel(path, "spherecloud real-or-fake 1")) {}

RealOrFakeClassifier::RealOrFakeClassifier(const nlohmann::json &json)
    : first_(json.value("first", nlohmann::json()), kRealOrFakeFeatures),
      second_(json.value("second", nlohmann::json()), kRealOrFakeFeatures + kFromNeighbours) {}

Eigen::ArrayXf RealOrFakeClassifier::probabilities(const RealOrFakeFeatures &features,
                                                   const Neighbours &beside) const {
  const Eigen::ArrayXf alone = sigmoid(first_(features.values));
  return sigmoid(second_(withNeighboursScores(features, beside, alone)));
}

Eigen::MatrixXf withNeighboursScores(const RealOrFakeFeatures &features, const Neighbours &beside,
                                     const Eigen::ArrayXf &scores) {
  const Eigen::ArrayXXi &indices = beside.indices;
  Eigen::ArrayXXf theirs(indices.rows(), indices.cols());
  for (Eigen::Index k = 0; k < indices.cols(); ++k)
    for (Eigen::Index i = 0; i < indices.rows(); ++i) theirs(i, k) = scores[indices(i, k)];
  Eigen::MatrixXf values(features.values.rows(), features.values.cols() + kFromNeighbours);
  values << features.values, scores.matrix(), theirs.leftCols(4).rowwise().mean().matrix(),
      theirs.leftCols(16).rowwise().mean().matrix(), theirs.rowwise().mean().matrix(),
      theirs.leftCols(16).rowwise().maxCoeff().matrix();
  return values;
}

std::vector<RealOrFakeGuess> guessRealOrFake(const Published &map, const std::string &folder) {
  const MapNeighbours neighbours = neighboursIn(map);
  const RealOrFakeFeatures features =
      realOrFakeFeatures(map, neighbours, CoOccurrence(folder + "/co_occurrence.json"));
  const std::vector<uint32_t> stacks = stacksOf(map.directions);
  std::vector<RealOrFakeGuess> guesses = {
      cue("density", features.density), cue("lookalikes", features.lookalikes),
      cue("other stacks", lookalikesInOtherStacks(map.directions, neighbours.alike, stacks)),
      cue("mirror", features.mirror), cue("co-occurrence", features.co_occurrence)};
  for (const std::string strategy : kKnownStrategies) {
    const RealOrFakeClassifier classifier(folder + "/real_or_fake_" + strategy + ".json");
    guesses.push_back(guess("knows " + strategy, classifier.probabilities(features, neighbours.beside)));
  }
  const Eigen::MatrixXf in_stacks = stackFeatures(map.directions, neighbours, stacks);
  for (const std::string strategy : kStackedStrategies) {
    const StackClassifier classifier(folder + "/stacks_" + strategy + ".json");
    guesses.push_back(guess("stacks of " + strategy, classifier.logits(map, stacks, in_stacks)));
  }
  return guesses;
}

}  // namespace sphc::host
