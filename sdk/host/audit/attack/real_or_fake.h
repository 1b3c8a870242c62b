// Tells real points from fake ones in one map: five cues by themselves, and classifiers that have learned on other
// places how a strategy's fakes look (docs/real_or_fake.md).
#pragma once
#include <string>
#include <vector>

#include "host/audit/attack/mlp.h"
#include "host/audit/attack/real_or_fake_features.h"

namespace sphc::host {

class RealOrFakeClassifier {
 public:
  // Throws std::runtime_error when the file is no such model.
  explicit RealOrFakeClassifier(const std::string &path);

  // For each point the probability that it is real.
  Eigen::ArrayXf probabilities(const RealOrFakeFeatures &features, const Neighbours &beside) const;

 private:
  explicit RealOrFakeClassifier(const nlohmann::json &json);

  Mlp first_, second_;  // the second also knows what the first makes of the neighbours
};

// What the second stage learns from.
Eigen::MatrixXf withNeighboursScores(const RealOrFakeFeatures &features, const Neighbours &beside,
                                     const Eigen::ArrayXf &scores);

struct RealOrFakeGuess {
  std::string attacker;        // a cue, or the strategy whose fakes it knows
  std::vector<double> scores;  // a point each; larger: rather real
  bool is_cue = false;         // nothing was learned of which way it points
};

// By all that `folder` (networks/ beside this file) has.  The strongest is the one to count.
std::vector<RealOrFakeGuess> guessRealOrFake(const Published &map, const std::string &folder);

}  // namespace sphc::host
