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
};

// One an attacker, and last the strongest of them by AUC, again, as "strongest".
std::vector<RealOrFakeScores> scoreRealOrFake(const std::vector<RealOrFakeGuess> &guesses,
                                              const std::vector<bool> &real);

// Rows of attack "real_or_fake".
std::vector<PrivacyRow> realOrFakeRows(const std::vector<RealOrFakeScores> &scores, const std::string &map,
                                       const std::string &strategy, double eta);

}  // namespace sphc::host
