// How much attacks on several releases won, by the owner's ledger.
#pragma once
#include <optional>
#include <vector>

#include "host/audit/attack/leaks.h"
#include "host/audit/attack/triangulation.h"
#include "host/audit/score/auc.h"
#include "host/audit/score/truth.h"

namespace sphc::host {

// Entries that an attack takes for real.
struct Exposure {
  size_t believed = 0, real = 0;
  // The share of these that are real.  One release tells eta without any attack.
  double precision() const { return believed ? static_cast<double>(real) / static_cast<double>(believed) : 0; }
};

Exposure scoreEntries(const std::vector<uint32_t> &believed, const std::vector<EntryTruth> &truth);
// Distinct descriptors among the entries that are real of all releases.
size_t distinctReal(const std::vector<std::vector<uint32_t>> &believed, const std::vector<Published> &releases,
                    const std::vector<std::vector<EntryTruth>> &truths);

struct TriangulationScore {
  Exposure both_real;     // pairs
  double median_error_m;  // of the pairs, with the centres' distance told to the attacker; 0 without pairs
};
// `centres_m`: distance of the centres.
TriangulationScore scoreTriangulation(const Triangulation &attack, const std::vector<EntryTruth> &truth_a,
                                      const std::vector<EntryTruth> &truth_b, double centres_m);

struct LearnedScore {
  Exposure learned;
  double share_of_real = 0;   // that is known now
  double median_error_m = 0;  // of the distance from the centre
};
LearnedScore scoreLearned(const std::vector<std::optional<Vector3>> &learned, const std::vector<EntryTruth> &truth);

Auc scoreCue(const Cue &cue, const std::vector<EntryTruth> &truth);

}  // namespace sphc::host
