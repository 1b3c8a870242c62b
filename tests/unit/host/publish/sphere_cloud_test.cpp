#include "host/publish/sphere_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>

#include "host/publish/release.h"
#include "tests/support/random_numbers.h"

namespace sphc::host {
namespace {

uint32_t nameOf(const Descriptor &d) {
  uint32_t name;
  std::memcpy(&name, d.bytes, sizeof name);
  return name;
}

// Points whose descriptor says which they are.
PointModel namedModel(uint32_t count) {
  Random random(1);
  PointModel model;
  for (uint32_t i = 0; i < count; ++i) {
    const Vector3 position = Vector3(2, 1, 0.5).cwiseProduct(test::normalVector(&random)) + Vector3(10, -4, 2);
    ModelPoint point = {position, test::randomDescriptor(&random), 0.01, 3};
    std::memcpy(point.descriptor.bytes, &i, sizeof i);
    model.points.push_back(point);
  }
  return model;
}

struct Built {
  SphereCloud cloud;
  Vector3 centre_m;
};

// By the only way there is.
Built build(const PointModel &model, double eta, uint8_t key = 1) {
  const auto strategy = gaussianFakes();
  ReleaseRequest request;
  request.key = {key};
  request.strategy = strategy.get();
  request.eta = eta;
  const NewRelease made = makeRelease(model, request);
  return {publishedCloud(made.place, request.key), made.place.centre_m};
}

// Is this point's direction the one of the model point that has its descriptor?
bool isReal(const PointModel &model, const Built &built, const SpherePoint &point) {
  const Vector3 &position = model.points[nameOf(point.descriptor)].position_m;
  return ((position - built.centre_m).normalized() - point.direction).norm() < 1e-4;  // as packed
}

TEST(SphereCloud, CentreIsTheCentroid) {
  const PointModel model = namedModel(500);
  Vector3 mean = Vector3::Zero();
  for (const ModelPoint &point : model.points) mean += point.position_m / 500;
  EXPECT_LT((build(model, 0.5).centre_m - mean).norm(), 1e-12);
}

TEST(SphereCloud, TheShareOfRealDirectionsIsEta) {
  const PointModel model = namedModel(3000);
  for (double eta : {1.0, 0.5, 1.0 / 3, 0.25, 0.01}) {
    const Built built = build(model, eta);
    const auto real = std::count_if(built.cloud.points.begin(), built.cloud.points.end(),
                                    [&](const SpherePoint &p) { return isReal(model, built, p); });
    EXPECT_NEAR(static_cast<double>(real), eta * 3000, 1) << eta;
  }
}

TEST(SphereCloud, EveryDescriptorAppearsExactlyOnceAndUnchanged) {
  const PointModel model = namedModel(1000);
  const Built built = build(model, 1.0 / 3);
  ASSERT_EQ(built.cloud.points.size(), 1000u);
  std::vector<int> seen(1000);
  for (const SpherePoint &point : built.cloud.points) {
    const uint32_t name = nameOf(point.descriptor);
    ASSERT_LT(name, 1000u);
    ++seen[name];
    EXPECT_EQ(std::memcmp(&point.descriptor, &model.points[name].descriptor, sizeof(Descriptor)), 0);
  }
  for (int count : seen) EXPECT_EQ(count, 1);
}

TEST(SphereCloud, AllDirectionsAreUnit) {
  for (const SpherePoint &point : build(namedModel(2000), 0.25).cloud.points)
    EXPECT_NEAR(point.direction.norm(), 1, 1e-6);
}

// Which points keep their direction must not hang on where they stood in the model, nor show in the map's order.
TEST(SphereCloud, OrderTellsNothing) {
  const PointModel model = namedModel(2000);
  double first_half_real = 0, first_half_input = 0, displacement = 0;
  constexpr int kKeys = 20;
  for (uint8_t key = 1; key <= kKeys; ++key) {
    const Built built = build(model, 0.5, key);
    for (size_t i = 0; i < 2000; ++i) {
      const bool real = isReal(model, built, built.cloud.points[i]);
      const uint32_t input = nameOf(built.cloud.points[i].descriptor);
      first_half_real += i < 1000 && real;
      first_half_input += input < 1000 && real;
      displacement += std::abs(static_cast<double>(input) - static_cast<double>(i));
    }
  }
  EXPECT_NEAR(first_half_real / (kKeys * 1000), 0.5, 0.015);
  EXPECT_NEAR(first_half_input / (kKeys * 1000), 0.5, 0.015);
  EXPECT_NEAR(displacement / (kKeys * 2000) / 2000, 1.0 / 3, 0.01);  // of two independent uniforms
}

TEST(SphereCloud, APointAtTheCentreHasNoDirection) {
  PointModel model = namedModel(100);
  for (size_t i = 0; i < 100; ++i)
    model.points[i].position_m = Vector3(i % 2 ? 1 : -1, 0.1 * static_cast<double>(i / 2), 0);
  model.points.push_back(model.points[0]);
  Vector3 mean = Vector3::Zero();
  for (size_t i = 0; i < 100; ++i) mean += model.points[i].position_m / 100;
  model.points[100].position_m = mean;
  EXPECT_EQ(build(model, 1).cloud.points.size(), 100u);
}

TEST(SphereCloud, BadRequestsAreExplained) {
  const PointModel model = namedModel(100);
  for (double eta : {0.0, -0.1, 1.01, std::nan("")}) EXPECT_THROW(build(model, eta), std::runtime_error) << eta;
  EXPECT_THROW(build(namedModel(63), 1), std::runtime_error);
  EXPECT_THROW(build(model, 0.001), std::runtime_error);  // not one real direction
  // Nearly all points at one place, so that too few have a direction.
  PointModel heap = model;
  for (ModelPoint &point : heap.points) point.position_m = Vector3(1, 1, 1);
  EXPECT_THROW(build(heap, 1), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
