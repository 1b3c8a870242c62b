// publish_cloud POINTS STRATEGY ETA SEED OUT: what would be published of private points, and the truth.
// POINTS as dump_points writes them: uint32 count, of all points float32 x, y, z in metres, of all 128 bytes.
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "host/audit/train/real_or_fake/cloud_file.h"
#include "host/audit/train/real_or_fake/plain_values.h"
#include "host/build/fakes/strategy.h"
#include "host/import/twins.h"

namespace sphc::host {
namespace {

PointModel readPoints(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  const auto count = readPlain<uint32_t>(&in);
  PointModel model;
  for (uint32_t i = 0; i < count && in; ++i) {
    const float x = readPlain<float>(&in), y = readPlain<float>(&in), z = readPlain<float>(&in);
    model.points.push_back({Eigen::Vector3f(x, y, z).cast<double>(), {}, 0, 1});
  }
  for (ModelPoint &point : model.points) point.descriptor = readPlain<Descriptor>(&in);
  if (!in || model.points.empty())
    throw std::runtime_error(path + " is missing or has no points; dump_points makes them");
  return model;
}

std::vector<SpherePoint> project(const PointModel &model) {
  Vector3 centre = Vector3::Zero();
  for (const ModelPoint &point : model.points)
    centre += point.position_m / static_cast<double>(model.points.size());
  std::vector<SpherePoint> points;
  for (const ModelPoint &point : model.points)
    points.push_back({(point.position_m - centre).normalized(), point.descriptor});
  return points;
}

KnownCloud publish(const PointModel &model, const FakeStrategy &strategy, double eta, uint64_t seed) {
  SecretKey key = {};
  std::memcpy(key.data(), &seed, sizeof seed);
  SecretRandom random(key);
  std::vector<SpherePoint> points = project(model);
  shuffle(&points, &random);
  const auto real_count = static_cast<size_t>(eta * static_cast<double>(points.size()));
  const std::vector<Fate> fates = strategy.fates(points, real_count, &random);
  KnownCloud cloud;
  for (const Fate &fate : fates) {
    cloud.published.directions.push_back(fate.shown.direction);
    cloud.published.descriptors.push_back(fate.shown.descriptor);
    cloud.real.push_back(fate.real);
  }
  return cloud;
}

std::unique_ptr<FakeStrategy> strategyNamed(const std::string &name) {
  if (name == "gaussian") return gaussianFakes();
  if (name == "patchwork") return patchworkFakes();
  throw std::runtime_error("there is no strategy " + name);
}

void run(char **arguments) {
  const auto strategy = strategyNamed(arguments[2]);
  const PointModel model = withoutTwins(readPoints(arguments[1]), {0.06, 260});
  writeCloud(arguments[5], publish(model, *strategy, std::stod(arguments[3]), std::stoull(arguments[4])));
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  if (argc != 6) {
    std::cerr << "usage: publish_cloud POINTS STRATEGY ETA SEED OUT\n";
    return 2;
  }
  try {
    sphc::host::run(argv);
  } catch (const std::exception &failure) {
    std::cerr << "publish_cloud: " << failure.what() << '\n';
    return 1;
  }
  return 0;
}
