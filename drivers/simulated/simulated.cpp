// simulated.cpp - the C interface: checks, and keeps exceptions inside.
#include "drivers/simulated/simulated.h"

#include <exception>
#include <memory>
#include <new>

#include "drivers/simulated/config.h"
#include "drivers/simulated/headset.h"
#include "drivers/simulated/raster.h"
#include "drivers/simulated/source.h"

struct sphc_simulated {
  explicit sphc_simulated(const sphc_simulated_config &config) : headset(config), source(headset) {}
  sphc::simulated::Headset headset;
  sphc::simulated::Source source;
};

namespace {

using sphc::simulated::explain;

// Runs what may throw and turns what it throws into a status.
template <class Action>
sphc_status guarded(sphc_message *message, const Action &action) {
  try {
    action();
    return SPHC_OK;
  } catch (const std::bad_alloc &) {
    explain(message, "simulated: out of memory; about 200 MB are needed");
    return SPHC_E_MEMORY_SIZE;
  } catch (const std::exception &error) {
    explain(message, "simulated: %s", error.what());
    return SPHC_E_INTERNAL;
  } catch (...) {
    explain(message, "simulated: unknown failure; please report it");
    return SPHC_E_INTERNAL;
  }
}

bool hasFrame(const sphc_simulated *simulated, uint32_t index) {
  return simulated != nullptr && index < simulated->headset.config().frame_count;
}

}  // namespace

sphc_status sphc_simulated_open(const sphc_simulated_config *config, sphc_simulated **simulated,
                                sphc_message *message) {
  if (simulated == nullptr) {
    explain(message, "simulated: the place for the handle is null; give the address of a pointer");
    return SPHC_E_ARGUMENT;
  }
  const sphc_status status = sphc::simulated::checkConfig(config, message);
  if (status != SPHC_OK) return status;
  return guarded(message, [&] { *simulated = std::make_unique<sphc_simulated>(*config).release(); });
}

void sphc_simulated_close(sphc_simulated **simulated) {
  if (simulated == nullptr) return;
  delete *simulated;
  *simulated = nullptr;
}

sphc_status sphc_simulated_source(sphc_simulated *simulated, sphc_source *source) {
  if (simulated == nullptr || source == nullptr) return SPHC_E_ARGUMENT;
  if (source->struct_size != sizeof *source) return SPHC_E_STRUCT_SIZE;
  simulated->source.fill(source);
  return SPHC_OK;
}

sphc_status sphc_simulated_rig(const sphc_simulated *simulated, sphc_rig *rig) {
  if (simulated == nullptr || rig == nullptr) return SPHC_E_ARGUMENT;
  *rig = simulated->headset.rig();
  return SPHC_OK;
}

uint32_t sphc_simulated_frame_count(const sphc_simulated *simulated) {
  return simulated == nullptr ? 0 : simulated->headset.config().frame_count;
}

sphc_status sphc_simulated_frame_times(const sphc_simulated *simulated, uint32_t index, int64_t *color_time_ns,
                                       int64_t *depth_time_ns) {
  if (!hasFrame(simulated, index)) return SPHC_E_ARGUMENT;
  if (color_time_ns != nullptr) *color_time_ns = simulated->headset.colorTime(index);
  if (depth_time_ns != nullptr) *depth_time_ns = simulated->headset.depthTime(index);
  return SPHC_OK;
}

sphc_status sphc_simulated_pose_at(const sphc_simulated *simulated, int64_t time_ns,
                                   sphc_rigid *world_from_camera) {
  if (simulated == nullptr || world_from_camera == nullptr) return SPHC_E_ARGUMENT;
  *world_from_camera = sphc::simulated::rigidOf(simulated->headset.colorPose(time_ns));
  return SPHC_OK;
}

sphc_status sphc_simulated_felt_at(const sphc_simulated *simulated, int64_t time_ns, double felt_mps2[3]) {
  if (simulated == nullptr || felt_mps2 == nullptr) return SPHC_E_ARGUMENT;
  const sphc::simulated::Vec3d felt = simulated->headset.felt(time_ns);
  felt_mps2[0] = felt.x;
  felt_mps2[1] = felt.y;
  felt_mps2[2] = felt.z;
  return SPHC_OK;
}

sphc_status sphc_simulated_oracle_depth(const sphc_simulated *simulated, int64_t time_ns, float *depth_m) {
  if (simulated == nullptr || depth_m == nullptr) return SPHC_E_ARGUMENT;
  return guarded(nullptr, [&] { simulated->headset.oracleColor(time_ns, depth_m); });
}

sphc_status sphc_simulated_oracle_tof_depth(const sphc_simulated *simulated, int64_t time_ns, float *depth_m) {
  if (simulated == nullptr || depth_m == nullptr) return SPHC_E_ARGUMENT;
  return guarded(nullptr, [&] { simulated->headset.oracleDepth(time_ns, depth_m); });
}

sphc_status sphc_simulated_render_color(const sphc_simulated *simulated, uint32_t index, uint8_t *rgb) {
  if (!hasFrame(simulated, index) || rgb == nullptr) return SPHC_E_ARGUMENT;
  return guarded(nullptr, [&] { simulated->headset.renderColor(index, rgb); });
}

sphc_status sphc_simulated_render_amplitude(const sphc_simulated *simulated, uint32_t index, uint16_t *amplitude) {
  if (!hasFrame(simulated, index) || amplitude == nullptr) return SPHC_E_ARGUMENT;
  return guarded(nullptr, [&] { simulated->headset.renderAmplitude(index, amplitude); });
}

sphc_status sphc_simulated_render_view(const sphc_simulated *simulated, int64_t time_ns, const sphc_camera *camera,
                                       const sphc_rigid *world_from_camera, uint8_t *rgb, uint16_t *depth,
                                       float *depth_m) {
  if (simulated == nullptr || camera == nullptr || world_from_camera == nullptr) return SPHC_E_ARGUMENT;
  const bool has_lens = camera->model == SPHC_CAMERA_BROWN5 || camera->model == SPHC_CAMERA_KANNALA_BRANDT4;
  if (!has_lens || camera->width == 0 || camera->height == 0 || camera->width % sphc::simulated::kTile != 0)
    return SPHC_E_ARGUMENT;
  return guarded(nullptr, [&] {
    const sphc::simulated::Pose pose = sphc::simulated::poseOf(*world_from_camera);
    if (rgb != nullptr) simulated->headset.renderView(*camera, pose, time_ns, rgb);
    if (depth != nullptr) simulated->headset.renderViewDepth(*camera, pose, time_ns, depth);
    if (depth_m != nullptr) simulated->headset.oracleView(*camera, pose, time_ns, depth_m);
  });
}

sphc_status sphc_simulated_render_depth(const sphc_simulated *simulated, uint32_t index, uint16_t *depth) {
  if (!hasFrame(simulated, index) || depth == nullptr) return SPHC_E_ARGUMENT;
  return guarded(nullptr, [&] { simulated->headset.renderDepth(index, depth); });
}
