// Rooms that a headset walks through, seen from many places, and two releases of the map of each.
#pragma once
#include <vector>

#include "tests/support/session.h"

namespace sphc::soak {

constexpr uint32_t kMappedRooms = 3, kRooms = 4;  // the last one has no map
constexpr uint32_t kReleases = 2, kPlaces = 13;   // of each room

sphc_localizer_config soakConfig();

struct Release {
  test::SceneMap scene;
  test::GuardedMemory memory;
  sphc_map *map = nullptr;
};

class World {
 public:
  World();
  ~World();
  World(const World &) = delete;
  World &operator=(const World &) = delete;

  const test::SceneImages &images(uint32_t room, uint32_t place) const { return images_[room * kPlaces + place]; }
  Rigid cameraFromWorld(uint32_t place) const { return test::sceneViewpoint(place / 4.0); }
  Rigid cameraFromMap(uint32_t room, uint32_t release, uint32_t place) const;
  const Release &release(uint32_t room, uint32_t release) const { return releases_[room * kReleases + release]; }
  bool guardsIntact() const;

 private:
  std::vector<test::SceneImages> images_;
  std::vector<Release> releases_;
};

}  // namespace sphc::soak
