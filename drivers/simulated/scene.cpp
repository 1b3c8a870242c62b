#include "drivers/simulated/scene.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "drivers/simulated/flat.h"
#include "drivers/simulated/painter.h"

namespace sphc::simulated {
namespace {

// The room stands on the first floor of a house, in a street of this size.
void addOutdoors(Builder &builder) {
  constexpr Vec3d kHalf{28, 28, 12}, kCenter{0, 0, 8};
  const Finish house{Material::kStreet, 0.04f};
  const Finish faces[kMaxFaces] = {house, house, house, house, {Material::kLawn, 0.1f}, {Material::kSky, 2}};
  builder.solid(Kind::kRoom, kCenter, yawRotation(0), kHalf, faces);
}

std::vector<Portal> portalsOf(const std::vector<Job> &jobs, bool clear_windows) {
  std::vector<Portal> portals;
  for (const Job &job : jobs) {
    const bool mirrors = job.material == Material::kMirror;
    if (mirrors || (clear_windows && job.material == Material::kWindow)) portals.push_back({job.shape, mirrors});
  }
  return portals;
}

}  // namespace

Scene buildScene(const sphc_simulated_config &config, std::vector<Job> &jobs) {
  Builder builder(config.seed, config.arrangement_seed);
  Scene scene;
  if ((config.with & SPHC_SIMULATED_FLAT) != 0) {
    scene.plan = layOutFlat(builder, config.with);
  } else {
    scene.plan.rooms.push_back(layOutRoom(builder, config.with));
  }
  scene.lighting = lightingOf(config.with);
  scene.fixed_count = static_cast<uint32_t>(builder.shapes.size());
  scene.actors = Actors(builder, config.with);
  const bool clear_windows = (config.with & SPHC_SIMULATED_WINDOW) != 0;
  if (clear_windows) addOutdoors(builder);
  scene.shapes = std::move(builder.shapes);
  scene.pool = std::move(builder.pool);
  scene.portals = portalsOf(builder.jobs, clear_windows);
  jobs = std::move(builder.jobs);
  if (clear_windows) {
    scene.outdoors.push_back(scene.shapes.back());
    scene.shapes.pop_back();
  }
  return scene;
}

Scene makeScene(const sphc_simulated_config &config) {
  std::vector<Job> jobs;
  Scene scene = buildScene(config, jobs);
  const auto painter = std::make_shared<const Painter>(scene, jobs);
  scene.pool.allocate(
      [painter](uint32_t index, const Texture &texture, Texel *texels) { painter->paint(index, texture, texels); });
  return scene;
}

float clearance(const Scene &scene, const Vec3f &point) {
  float nearest = kFar;
  for (uint32_t i = 0; i < scene.fixed_count; ++i) nearest = std::min(nearest, distanceTo(scene.shapes[i], point));
  return nearest;
}

}  // namespace sphc::simulated
