#include "host/publish/fakes/spread_draw.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sphc::host {
namespace {

constexpr size_t kTries = 200;    // exchanges tried, per site
constexpr double kSlack = 0.003;  // of the sizes: how far an exchange may lead from the share

// Minimises the sum over pairs of sites of (drawn - share) (drawn - share) size size nearness, by exchanges.
class SpreadDraw {
 public:
  SpreadDraw(const std::vector<Site> &sites, double share, double reach_rad)
      : sites_(sites), reach2_(reach_rad * reach_rad), drawn_(sites.size()), crowd_(sites.size()) {
    for (const Site &site : sites) total_ += site.size;
    owed_ = share * total_;
    for (size_t i = 0; i < sites.size(); ++i) spread(i, -share);
  }

  std::vector<bool> draw(SecretRandom *random) {
    std::vector<size_t> order(sites_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    shuffle(&order, random);
    for (size_t i : order)
      if (owed_ >= sites_[i].size / 2) set(i, true);
    for (size_t t = 0; t < kTries * order.size(); ++t) {
      const size_t out = random->below(order.size()), in = random->below(order.size());
      if (drawn_[out] && !drawn_[in] && isBetter(out, in)) {
        set(out, false);
        set(in, true);
      }
    }
    return drawn_;
  }

 private:
  double nearness(size_t a, size_t b) const {
    return a == b ? 0 : std::exp(-(sites_[a].direction - sites_[b].direction).squaredNorm() / (2 * reach2_));
  }

  void spread(size_t site, double times) {
    for (size_t i = 0; i < sites_.size(); ++i) crowd_[i] += times * sites_[site].size * nearness(i, site);
  }

  void set(size_t site, bool drawn) {
    drawn_[site] = drawn;
    owed_ += drawn ? -sites_[site].size : sites_[site].size;
    spread(site, drawn ? 1 : -1);
  }

  bool isBetter(size_t out, size_t in) const {
    const double o = sites_[out].size, i = sites_[in].size, owed_after = owed_ + o - i;
    return std::abs(owed_after) <= std::max(std::abs(owed_), kSlack * total_) &&
           i * (crowd_[in] - o * nearness(in, out)) < o * crowd_[out];
  }

  const std::vector<Site> &sites_;
  double reach2_, total_ = 0;
  double owed_ = 0;  // size that is still to be drawn
  std::vector<bool> drawn_;
  std::vector<double> crowd_;  // of each site, by all others
};

}  // namespace

std::vector<bool> spreadDraw(const std::vector<Site> &sites, double share, double reach_rad, SecretRandom *random) {
  return SpreadDraw(sites, share, reach_rad).draw(random);
}

}  // namespace sphc::host
