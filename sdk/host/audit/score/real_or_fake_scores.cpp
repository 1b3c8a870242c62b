#include "host/audit/score/real_or_fake_scores.h"

#include <algorithm>

#include "host/audit/score/auc.h"
#include "host/audit/score/layers.h"
#include "host/audit/score/precision.h"

namespace sphc::host {

void turnCues(const std::vector<bool> &real, std::vector<RealOrFakeGuess> *guesses) {
  for (RealOrFakeGuess &guess : *guesses) {
    if (!guess.is_cue || areaUnderCurve(guess.scores, real).value >= 0.5) continue;
    for (double &score : guess.scores) score = -score;
  }
}

std::vector<RealOrFakeGuess> turnedGuesses(const Published &map, const std::vector<bool> &real,
                                           const std::string &networks) {
  std::vector<RealOrFakeGuess> guesses = guessRealOrFake(map, networks);
  turnCues(real, &guesses);
  return guesses;
}

std::vector<RealOrFakeScores> scoreRealOrFake(const std::vector<RealOrFakeGuess> &guesses,
                                              const std::vector<bool> &real, const std::vector<uint32_t> &layers) {
  const auto reals = static_cast<double>(std::count(real.begin(), real.end(), true));
  const double eta = reals / static_cast<double>(real.size());
  RealOrFakeScores strongest = {"strongest", 0, 0, 0, 0};
  std::vector<RealOrFakeScores> scores;
  for (const RealOrFakeGuess &guess : guesses) {
    const RealOrFakeScores own = {
        guess.attacker, areaUnderCurve(guess.scores, real).value, precisionAtTop(guess.scores, real, eta),
        precisionAtTop(guess.scores, real, 0.1),
        layers.empty() ? 0 : areaUnderCurve(layerMeans(guess.scores, layers), real).value};
    for (double RealOrFakeScores::*figure :
         {&RealOrFakeScores::auc, &RealOrFakeScores::precision_at_eta, &RealOrFakeScores::precision_at_tenth,
          &RealOrFakeScores::auc_of_layers})
      strongest.*figure = std::max(strongest.*figure, own.*figure);
    scores.push_back(own);
  }
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
    if (score.auc_of_layers > 0) add("auc_of_layers", score.auc_of_layers);
  }
  return rows;
}

}  // namespace sphc::host
