// The test room as frames of a recording, and its map.
#pragma once
#include "host/evaluate/map_file.h"
#include "lab/negative/sequence.h"
#include "tests/support/session.h"

namespace sphc::test {

struct RoomFrames {
  sphc_localizer_config config = sceneConfig();
  host::Sequence sequence;
  host::MapFile map;
  std::array<double, 3> centre_in_world_m = {};

  explicit RoomFrames(uint32_t shots) {
    const SceneMap made = makeSceneMap(config.rig.color_camera, config.max_keypoints, 3, 0.5);
    map = host::openMapBytes(made.file);
    sequence.rig = config.rig;
    sequence.color_format = SPHC_FORMAT_GRAY8;
    for (uint32_t i = 0; i < shots; ++i) {
      const auto frame = sceneFrame(config, i);
      host::Shot shot;
      shot.color = frame->images.gray;
      shot.depth = frame->images.depth_mm;
      shot.color_time_ns = shot.depth_time_ns = int64_t{1000000000} * (i + 1);
      shot.world_from_camera = rigidToC(sceneViewpoint(i).inverse());
      sequence.shots.push_back(shot);
    }
    for (size_t k = 0; k < 3; ++k) centre_in_world_m[k] = made.centre_in_world_m[static_cast<int>(k)];
  }
};

}  // namespace sphc::test
