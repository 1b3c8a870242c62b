#include "tests/support/session.h"

#include <cstdio>
#include <cstdlib>

namespace sphc::test {
namespace {

void require(sphc_status status, const sphc_message &message) {
  if (status == SPHC_OK) return;
  std::fprintf(stderr, "%s: %s\n", sphc_status_name(status), message.text);
  std::abort();
}

}  // namespace

sphc_localizer_config sceneConfig() {
  sphc_localizer_config config;
  sphc_localizer_config_init(&config, sizeof config);
  config.rig.color_camera = pinhole(320, 240, 250);
  config.rig.depth_camera = pinhole(200, 160, 140);
  config.rig.color_from_depth.t_m[0] = 0.04;
  config.mode = SPHC_MODE_SINGLE;
  config.max_keypoints = 400;
  config.depth_sigma_m = 0.002;
  config.depth_offset_sigma_m = config.depth_slope_sigma =
      0;  // the scene's sensor is known: frames have no history
  return config;
}

std::unique_ptr<SceneFrame> sceneFrame(const sphc_localizer_config &config, uint32_t viewpoint, uint32_t room) {
  auto made = std::make_unique<SceneFrame>();
  made->images = renderScene(config.rig.color_camera, config.rig.depth_camera, sceneViewpoint(viewpoint),
                             rigidFromC(config.rig.color_from_depth), room);
  const sphc_camera &c = config.rig.color_camera, &d = config.rig.depth_camera;
  made->frame = {};
  made->frame.struct_size = sizeof(sphc_localizer_frame);
  made->frame.sequence = viewpoint;
  made->frame.color_time_ns = 1000 + viewpoint;
  made->frame.depth_time_ns = 1001 + viewpoint;
  made->frame.color = {made->images.gray.data(), c.width, c.height, c.width, SPHC_FORMAT_GRAY8};
  made->frame.depth = {made->images.depth_mm.data(), d.width, d.height, 2 * d.width, SPHC_FORMAT_DEPTH16};
  return made;
}

void Session::openMap(const sphc_localizer_config &config, double eta, uint32_t room) {
  sphc_message message = {};
  sphc_memory need = {};
  require(sphc_map_memory(&need), message);
  rooms_.push_back({makeSceneMap(config.rig.color_camera, config.max_keypoints, 3, eta, room),
                    GuardedMemory(need.state_bytes, need.alignment)});
  Room &made = rooms_.back();
  sphc_map *map = nullptr;
  require(sphc_map_init(made.memory.data(), made.memory.size(), made.scene.file.data(), made.scene.file.size(),
                        &map, &message),
          message);
  maps_.push_back(map);
}

Session::Session(const sphc_localizer_config &config, double eta, uint32_t rooms) {
  for (uint32_t room = 0; room < rooms; ++room) openMap(config, eta, room);
  sphc_message message = {};
  sphc_memory need;
  require(sphc_localizer_memory(&config, &need, &message), message);
  state_ = GuardedMemory(need.state_bytes, need.alignment);
  scratch_ = GuardedMemory(need.scratch_bytes, need.alignment);
  require(sphc_localizer_init(state_.data(), state_.size(), scratch_.data(), scratch_.size(), &config, &localizer_,
                              &message),
          message);
  for (uint32_t room = 0; room < rooms; ++room) requireOf(sphc_localizer_set_map(localizer_, room, maps_[room]));
  setParameter(SPHC_PARAMETER_MAX_ITERATIONS, 5000);
}

void Session::requireOf(sphc_status status) {
  sphc_message message = {};
  std::snprintf(message.text, sizeof message.text, "%s", sphc_localizer_message(localizer_));
  require(status, message);
}

void Session::setParameter(sphc_localizer_parameter parameter, double value) {
  requireOf(sphc_localizer_set_parameter(localizer_, parameter, value));
}

Session::~Session() {
  sphc_localizer_fini(&localizer_);
  for (sphc_map *&map : maps_) sphc_map_fini(&map);
}

sphc_status Session::process(const sphc_localizer_frame &frame, sphc_localizer_result *result) {
  result->struct_size = sizeof *result;
  return sphc_localizer_process(localizer_, &frame, result);
}

double Session::errorM(const sphc_localizer_result &result, uint32_t viewpoint) const {
  const Rigid map_from_camera = rigidFromC(result.camera_from_map).inverse();
  const Vector3 centre = map_from_camera.translation_m + rooms_[result.map_id].scene.centre_in_world_m;
  return (centre - sceneViewpoint(viewpoint).inverse().translation_m).norm();
}

}  // namespace sphc::test
