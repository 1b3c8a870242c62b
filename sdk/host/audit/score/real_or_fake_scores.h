// How well real points were told from fake ones.
#pragma once
#include <string>
#include <vector>

#include "host/audit/attack/real_or_fake.h"
#include "host/audit/score/privacy_row.h"

namespace sphc::host {

struct RealOrFakeScores {
  std::string attacker;
  double auc, precision_at_eta, precision_at_tenth;
  double auc_of_layers;  // each point with the mean score of its layer; 0 where there are none
};

// A cue that points the other way in this map, so that its AUC is below 1/2, is turned over: who trains on such
// maps knows which way it points.
void turnCues(const std::vector<bool> &real, std::vector<RealOrFakeGuess> *guesses);
// What all that `networks` has guesses of a map whose truth is known, its cues turned.
std::vector<RealOrFakeGuess> turnedGuesses(const Published &map, const std::vector<bool> &real,
                                           const std::string &networks);

// One an attacker, and last "strongest": of each figure the most that any of them reaches.  `layers`: of layersOf,
// or of who made the fakes; empty where fakes lie in no layers.
std::vector<RealOrFakeScores> scoreRealOrFake(const std::vector<RealOrFakeGuess> &guesses,
                                              const std::vector<bool> &real,
                                              const std::vector<uint32_t> &layers = {});

// Rows of attack "real_or_fake".
std::vector<PrivacyRow> realOrFakeRows(const std::vector<RealOrFakeScores> &scores, const std::string &map,
                                       const std::string &strategy, double eta);

}  // namespace sphc::host
