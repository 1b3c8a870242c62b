#include "host/publish/fakes/spread_draw.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

constexpr double kReachRad = 0.1;

std::vector<Site> someSites(size_t count) {
  Random random(5);
  std::vector<Site> sites;
  for (size_t i = 0; i < count; ++i) sites.push_back({test::randomDirection(&random), 1 + 20 * random.uniform()});
  return sites;
}

std::vector<bool> drawn(const std::vector<Site> &sites, double share, uint8_t key = 1) {
  SecretRandom random({key});
  return spreadDraw(sites, share, kReachRad, &random);
}

size_t neighboursTogether(const std::vector<Site> &sites, const std::vector<bool> &drawn) {
  size_t pairs = 0;
  for (size_t i = 0; i < sites.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      pairs += drawn[i] && drawn[j] && (sites[i].direction - sites[j].direction).norm() < kReachRad;
  return pairs;
}

TEST(SpreadDraw, TakesTheShareOfTheSizes) {
  const auto sites = someSites(500);
  const double all = std::accumulate(sites.begin(), sites.end(), 0.0,
                                     [](double sum, const Site &site) { return sum + site.size; });
  for (double share : {0.1, 1.0 / 3, 0.5, 0.75}) {
    const auto real = drawn(sites, share);
    double taken = 0;
    for (size_t i = 0; i < sites.size(); ++i) taken += real[i] ? sites[i].size : 0;
    EXPECT_NEAR(taken / all, share, 0.006);
  }
}

TEST(SpreadDraw, NeighboursAreRarelyTogether) {
  const auto sites = someSites(1000);
  const std::vector<bool> real = drawn(sites, 1.0 / 3);
  const std::vector<bool> by_chance(real.rbegin(), real.rend());  // the sites come in no order
  EXPECT_LT(neighboursTogether(sites, real), neighboursTogether(sites, by_chance) / 2);
}

TEST(SpreadDraw, NoCornerGoesWithout) {
  const auto sites = someSites(2000);
  const auto real = drawn(sites, 1.0 / 3);
  Random random(8);
  for (int i = 0; i < 100; ++i) {
    const Vector3 middle = test::randomDirection(&random);
    double near = 0, taken = 0;
    for (size_t k = 0; k < sites.size(); ++k) {
      if ((sites[k].direction - middle).norm() > 0.3) continue;
      near += sites[k].size;
      taken += real[k] ? sites[k].size : 0;
    }
    EXPECT_NEAR(taken / near, 1.0 / 3, 0.13);
  }
}

TEST(SpreadDraw, TheKeyDecides) {
  const auto sites = someSites(300);
  EXPECT_EQ(drawn(sites, 0.5), drawn(sites, 0.5));
  EXPECT_NE(drawn(sites, 0.5), drawn(sites, 0.5, 2));
  EXPECT_TRUE(drawn({}, 0.5).empty());
}

}  // namespace
}  // namespace sphc::host
