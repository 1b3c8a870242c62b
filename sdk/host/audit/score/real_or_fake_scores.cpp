#include "host/audit/score/real_or_fake_scores.h"

#include <algorithm>

#include "host/audit/score/auc.h"
#include "host/audit/score/precision.h"

namespace sphc::host {

std::vector<RealOrFakeScores> scoreRealOrFake(const std::vector<RealOrFakeGuess> &guesses,
                                              const std::vector<bool> &real) {
  const auto reals = static_cast<double>(std::count(real.begin(), real.end(), true));
  const double eta = reals / static_cast<double>(real.size());
  std::vector<RealOrFakeScores> scores;
  for (const RealOrFakeGuess &guess : guesses)
    scores.push_back({guess.attacker, areaUnderCurve(guess.scores, real).value,
                      precisionAtTop(guess.scores, real, eta), precisionAtTop(guess.scores, real, 0.1)});
  RealOrFakeScores strongest =
      *std::max_element(scores.begin(), scores.end(),
                        [](const RealOrFakeScores &a, const RealOrFakeScores &b) { return a.auc < b.auc; });
  strongest.attacker = "strongest";
  scores.push_back(strongest);
  return scores;
}

std::vector<PrivacyRow> realOrFakeRows(const std::vector<RealOrFakeScores> &scores, const std::string &map,
                                       const std::string &strategy, double eta) {
  std::vector<PrivacyRow> rows;
  for (const RealOrFakeScores &score : scores) {
    const auto add = [&](const char *metric, double value) {
      rows.push_back({"real_or_fake", map, strategy, eta, score.attacker, metric, value});
    };
    add("auc", score.auc);
    add("precision_at_eta", score.precision_at_eta);
    add("precision_at_tenth", score.precision_at_tenth);
  }
  return rows;
}

}  // namespace sphc::host
