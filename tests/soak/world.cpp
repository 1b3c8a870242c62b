#include "tests/soak/world.h"

#include <algorithm>
#include <cstdlib>

namespace sphc::soak {
namespace {

constexpr double kEtas[kReleases] = {0.7, 0.5};
constexpr uint32_t kViews = 3;

}  // namespace

sphc_localizer_config soakConfig() {
  sphc_localizer_config config = test::sceneConfig();
  config.rig.color_camera = test::pinhole(240, 180, 190);
  config.rig.depth_camera = test::pinhole(150, 120, 105);
  config.mode = SPHC_MODE_TRACKING;
  config.max_keypoints = 200;
  config.max_maps = kMappedRooms;
  config.depth_offset_sigma_m = 0.01;
  config.depth_slope_sigma = 0.01;
  return config;
}

World::World() {
  const sphc_localizer_config config = soakConfig();
  const sphc_rig &rig = config.rig;
  for (uint32_t room = 0; room < kRooms; ++room)
    for (uint32_t place = 0; place < kPlaces; ++place)
      images_.push_back(test::renderScene(rig.color_camera, rig.depth_camera, cameraFromWorld(place),
                                          rigidFromC(rig.color_from_depth), room));
  sphc_memory need = {};
  sphc_map_memory(&need);
  for (uint32_t room = 0; room < kMappedRooms; ++room)
    for (const double eta : kEtas) {
      Release made = {test::makeSceneMap(rig.color_camera, config.max_keypoints, kViews, eta, room),
                      test::GuardedMemory(need.state_bytes, need.alignment)};
      if (sphc_map_init(made.memory.data(), made.memory.size(), made.scene.file.data(), made.scene.file.size(),
                        &made.map, nullptr) != SPHC_OK)
        std::abort();
      releases_.push_back(std::move(made));
    }
}

World::~World() {
  for (Release &release : releases_) sphc_map_fini(&release.map);
}

Rigid World::cameraFromMap(uint32_t room, uint32_t release, uint32_t place) const {
  const Rigid world_from_map = {Matrix3::Identity(), this->release(room, release).scene.centre_in_world_m};
  return cameraFromWorld(place) * world_from_map;
}

bool World::guardsIntact() const {
  return std::all_of(releases_.begin(), releases_.end(),
                     [](const Release &release) { return release.memory.guardsIntact(); });
}

}  // namespace sphc::soak
