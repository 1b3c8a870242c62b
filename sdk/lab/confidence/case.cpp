#include "lab/confidence/case.h"

#include <algorithm>
#include <cmath>

#include "host/report/run.h"
#include "lab/common/normal.h"
#include "lab/pose/grown_case.h"

namespace sphc::host {
namespace {

constexpr double kFewestRows = 12, kMostRows = 150;
constexpr double kEtas[] = {1, 0.5, 0.33, 0.25, 0.15, 0.10};
constexpr double kDepthNoises[] = {0.5, 1, 1, 1, 2, 3};
constexpr double kAllRowsShare = 0.15, kWrongPlaceShare = 0.1;

template <typename T, size_t n>
T oneOf(const T (&values)[n], Random *random) {
  return values[random->below(n)];
}

double trueShare(const PoseCase &c) {
  const auto count = std::count(c.is_true.begin(), c.is_true.end(), true);
  return static_cast<double>(count) / static_cast<double>(std::max<size_t>(c.is_true.size(), 1));
}

// Adds what is missing, or states more than there is.
void misjudgeDepth(double factor, double noise_scale, Random *random, LiftedPoint *lifted) {
  if (factor < 1) {
    lifted->along_m /= factor;
    return;
  }
  const double missing_m = std::sqrt(factor * factor - 1) * noise_scale * lifted->along_m * normalOf(random);
  lifted->point_m *= std::max(0.1, 1 + missing_m / lifted->point_m.norm());
}

void shuffleDirections(std::vector<Correspondence> *rows, std::vector<bool> *is_true, Random *random) {
  for (size_t i = rows->size(); i > 1; --i)
    std::swap((*rows)[i - 1].direction, (*rows)[random->below(static_cast<uint32_t>(i))].direction);
  is_true->assign(is_true->size(), false);
}

}  // namespace

Hardship drawHardship(Random *random) {
  Hardship hardship;
  const double log_rows = std::log(kFewestRows) + random->uniform() * (std::log(kMostRows) - std::log(kFewestRows));
  if (random->uniform() > kAllRowsShare) hardship.rows = static_cast<size_t>(std::lround(std::exp(log_rows)));
  hardship.eta = oneOf(kEtas, random);
  hardship.depth_noise = oneOf(kDepthNoises, random);
  hardship.wrong_place = random->uniform() < kWrongPlaceShare;
  return hardship;
}

std::string describe(const Hardship &h) {
  return (h.rows ? "rows " + std::to_string(h.rows) : "all rows") + " eta " + fixed(100 * h.eta, 0) +
         " depth noise " + fixed(h.depth_noise, 1) + (h.wrong_place ? " wrong place" : "");
}

ConfidenceQuery hardQuery(const ConfidenceQuery &original, const Hardship &hardship, const CaseNoise &noise,
                          Random *random) {
  PoseCase c = original.pose_case;
  if (hardship.eta < trueShare(c)) c = turnedCase(c, hardship.eta, random);
  if (hardship.rows > 0 && hardship.rows < c.correspondences.size())
    c = resizedCase(c, hardship.rows, noise, random);
  for (Correspondence &row : c.correspondences)
    misjudgeDepth(hardship.depth_noise, original.depth.noise_scale, random, &row.lifted);
  if (hardship.wrong_place) {
    shuffleDirections(&c.correspondences, &c.is_true, random);
    shuffleDirections(&c.without_depth, &c.without_depth_is_true, random);
  }
  return {c, original.depth};
}

}  // namespace sphc::host
