#include "host/audit/score/layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "host/audit/attack/stacks.h"
#include "host/publish/fakes/strategy.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

struct Layered {
  std::vector<EntryTruth> truth;
  std::vector<uint32_t> patches, found;
};

// 2500 points over a sixth of the sphere, as a strategy publishes them.
Layered layered(const FakeStrategy &strategy) {
  Random random(1);
  std::vector<SpherePoint> points;
  while (points.size() < 2500) {
    const Vector3 direction = test::randomDirection(&random);
    if (direction.z() > 0.7) points.push_back({direction, test::randomDescriptor(&random)});
  }
  SecretRandom secret({5});
  const auto assignments = strategy.assignments(points, points.size() / 3, &secret);
  Layered layered;
  std::vector<Vector3> shown;
  for (size_t i = 0; i < points.size(); ++i) {
    layered.truth.push_back({assignments[i].real, 2 * points[i].direction, 1});
    layered.patches.push_back(assignments[i].patch);
    shown.push_back(assignments[i].shown.direction);
  }
  layered.found = layersOf(layered.truth, stacksOf(shown));
  return layered;
}

// Of all points, those that are of their layer's most frequent patch.
double purity(const Layered &layered) {
  std::map<uint32_t, std::map<uint32_t, size_t>> counts;
  for (size_t i = 0; i < layered.found.size(); ++i) ++counts[layered.found[i]][layered.patches[i]];
  size_t pure = 0;
  for (const auto &[layer, of_patches] : counts) {
    size_t most = 0;
    for (const auto &[patch, count] : of_patches) most = std::max(most, count);
    pure += most;
  }
  return static_cast<double>(pure) / static_cast<double>(layered.found.size());
}

TEST(Layers, AreThePatchesThatAStrategyMoved) {
  for (const auto &strategy : {patchworkFakes(), warpedFakes()}) {
    const Layered places = layered(*strategy);
    EXPECT_GT(purity(places), 0.93) << strategy->name();
    std::map<uint32_t, bool> real;
    for (size_t i = 0; i < places.found.size(); ++i)
      EXPECT_EQ(real.emplace(places.found[i], places.truth[i].real).first->second, places.truth[i].real);
    EXPECT_LT(real.size(), 300u);  // patches are about 100; stacks that are cut in two have more layers
  }
}

TEST(Layers, ShareTheMeanOfTheirScores) {
  EXPECT_THAT(layerMeans({1, 2, 4, 8}, {0, 1, 0, 1}), testing::ElementsAre(2.5, 5, 2.5, 5));
}

}  // namespace
}  // namespace sphc::host
