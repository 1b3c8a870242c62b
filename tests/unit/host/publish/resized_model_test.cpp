#include "host/publish/resized_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>

#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

PointModel modelOfCount(uint32_t count, uint64_t seed) {
  Random random(seed);
  PointModel model;
  for (uint32_t i = 0; i < count; ++i)
    model.points.push_back(
        {test::normalVector(&random) + Vector3(10, -4, 2), test::randomDescriptor(&random), 0.01, 1 + i % 5});
  return model;
}

std::string bytesOf(const Descriptor &d) {
  return std::string(reinterpret_cast<const char *>(d.bytes), sizeof d.bytes);
}

std::set<std::string> descriptorsOf(const PointModel &model) {
  std::set<std::string> all;
  for (const ModelPoint &point : model.points) all.insert(bytesOf(point.descriptor));
  return all;
}

size_t countFrom(const PointModel &resized, const std::set<std::string> &known) {
  return static_cast<size_t>(
      std::count_if(resized.points.begin(), resized.points.end(),
                    [&](const ModelPoint &point) { return known.count(bytesOf(point.descriptor)) > 0; }));
}

TEST(ResizedModel, CutsToThePointsThatMostFramesSaw) {
  const PointModel own = modelOfCount(100, 1);
  SecretRandom random({1});
  const PointModel cut = resizedModel(own, {}, 30, &random);
  ASSERT_EQ(cut.points.size(), 30u);
  for (const ModelPoint &point : cut.points) EXPECT_GE(point.observations, 4u);
}

TEST(ResizedModel, FillsUpWithForeignPointsAfterAllItsOwn) {
  const PointModel own = modelOfCount(100, 1), foreign = modelOfCount(50, 2);
  SecretRandom random({1});
  const PointModel grown = resizedModel(own, {foreign}, 140, &random);
  ASSERT_EQ(grown.points.size(), 140u);
  EXPECT_EQ(countFrom(grown, descriptorsOf(own)), 100u);
  EXPECT_EQ(countFrom(grown, descriptorsOf(foreign)), 40u);
}

TEST(ResizedModel, GrowsBeyondWhatThereIsWithoutCopies) {
  const PointModel own = modelOfCount(100, 1);
  SecretRandom random({1});
  const PointModel grown = resizedModel(own, {}, 2000, &random);
  ASSERT_EQ(grown.points.size(), 2000u);
  EXPECT_EQ(descriptorsOf(grown).size(), 2000u);
}

TEST(ResizedModel, TheCentreStaysAboutWhereItIs) {
  const PointModel own = modelOfCount(2000, 1);
  SecretRandom random({1});
  const PointModel grown = resizedModel(own, {}, 20000, &random);
  Vector3 before = Vector3::Zero(), after = Vector3::Zero();
  for (const ModelPoint &point : own.points) before += point.position_m / 2000;
  for (const ModelPoint &point : grown.points) after += point.position_m / 20000;
  EXPECT_LT((after - before).norm(), 0.05);
}

TEST(ResizedModel, TheSameKeyGivesTheSamePoints) {
  const PointModel own = modelOfCount(50, 1);
  SecretRandom a({1}), b({1});
  const PointModel first = resizedModel(own, {}, 500, &a), second = resizedModel(own, {}, 500, &b);
  for (size_t i = 0; i < 500; ++i) {
    EXPECT_EQ(bytesOf(first.points[i].descriptor), bytesOf(second.points[i].descriptor));
    EXPECT_EQ(first.points[i].position_m, second.points[i].position_m);
  }
}

TEST(ResizedModel, NothingCannotBeResized) {
  SecretRandom random({1});
  EXPECT_THROW(resizedModel({}, {}, 10, &random), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
