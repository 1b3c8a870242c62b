// A whole session through the C interface on the test room: map, config, memory, frames.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "spherecloud/spherecloud.h"
#include "tests/support/guarded_memory.h"
#include "tests/support/scene.h"
#include "tests/support/scene_map.h"

namespace sphc::test {

// The room's cameras: colour 320 x 240, a smaller depth camera 4 cm beside it.
sphc_localizer_config sceneConfig();
// A frame and the images it borrows.
struct SceneFrame {
  SceneImages images;
  sphc_localizer_frame frame;
};
std::unique_ptr<SceneFrame> sceneFrame(const sphc_localizer_config &config, uint32_t viewpoint, uint32_t room = 0);

class Session {
 public:
  // Asserts, by aborting, that every step works.
  explicit Session(const sphc_localizer_config &config, double eta = 0.5, uint32_t rooms = 1);
  ~Session();
  Session(const Session &) = delete;
  Session &operator=(const Session &) = delete;

  const SceneMap &sceneMap(uint32_t room = 0) const { return rooms_[room].scene; }
  sphc_map *map(uint32_t room = 0) { return maps_[room]; }  // whose id is `room`
  sphc_localizer *localizer() { return localizer_; }
  GuardedMemory &state() { return state_; }
  GuardedMemory &scratch() { return scratch_; }
  void setParameter(sphc_localizer_parameter parameter, double value);
  sphc_status process(const sphc_localizer_frame &frame, sphc_localizer_result *result);
  // Distance of the result's camera centre from the truth.
  double errorM(const sphc_localizer_result &result, uint32_t viewpoint) const;

 private:
  struct Room {
    SceneMap scene;
    GuardedMemory memory;
  };
  void requireOf(sphc_status status);
  void openMap(const sphc_localizer_config &config, double eta, uint32_t room);

  std::vector<Room> rooms_;
  std::vector<sphc_map *> maps_;
  GuardedMemory state_, scratch_;
  sphc_localizer *localizer_ = nullptr;
};

}  // namespace sphc::test
