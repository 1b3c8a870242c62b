// publish_cloud POINTS STRATEGY ETA SEED OUT: what would be published of private points, and the truth.
// POINTS as dump_points writes them.
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "host/import/near_duplicates.h"
#include "host/publish/fakes/strategy.h"
#include "host/publish/recognition.h"
#include "lab/train/point_file.h"
#include "lab/train/real_or_fake/cloud_file.h"
#include "lab/train/tool.h"

namespace sphc::host {
namespace {

PointModel readModel(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<Vector3> positions_m;
  std::vector<Descriptor> descriptors;
  readPoints(&in, &positions_m, &descriptors);
  if (!in || positions_m.empty())
    throw std::runtime_error(path + " is missing or has no points; dump_points makes them");
  PointModel model;
  for (size_t i = 0; i < positions_m.size(); ++i) model.points.push_back({positions_m[i], descriptors[i], 0, 1});
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
  return knownCloud(strategy.assignments(points, real_count, &random));
}

void run(char **arguments) {
  const auto strategy = makeFakes(arguments[2]);
  const PointModel model = withoutNearDuplicates(readModel(arguments[1]), kReleaseNearDuplicates);
  writeCloud(arguments[5], publish(model, *strategy, std::stod(arguments[3]), std::stoull(arguments[4])));
}

}  // namespace
}  // namespace sphc::host

int main(int argc, char **argv) {
  return sphc::host::runTool("publish_cloud POINTS STRATEGY ETA SEED OUT", argc == 6,
                             [&] { sphc::host::run(argv); });
}
