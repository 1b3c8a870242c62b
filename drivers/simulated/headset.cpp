#include "drivers/simulated/headset.h"

#include <cmath>

#include "drivers/simulated/parallel.h"
#include "drivers/simulated/raster.h"

namespace sphc::simulated {
namespace {

// z at the centre of every pixel.
void oracle(const Scene &scene, const std::vector<Shape> &shapes, const sphc_camera &camera, const RayTable &rays,
            const Pose &pose, uint32_t threads, float *depth_m) {
  const Raster raster(scene, shapes, camera, rays, posesOf(pose));
  parallelFor(raster.tileRows(), threads, [&](uint32_t tile_row) {
    raster.forTileRow(tile_row, [&](uint32_t column, uint32_t row, const Raster::List &list) {
      if (column % kLanes != 0) return;
      Rays four;
      for (uint32_t i = 0; i < kLanes; ++i) four.lane[i] = rays.center(column + i, row);
      const Hits hits = raster.cast(list, four);
      for (uint32_t i = 0; i < kLanes; ++i) {
        depth_m[static_cast<size_t>(row) * camera.width + column + i] = hits.lane[i].z;
      }
    });
  });
}

}  // namespace

Headset::Headset(const sphc_simulated_config &config)
    : config_(config),
      cameras_(camerasOf(config.cameras)),
      color_rays_(colorCamera()),
      depth_rays_(depthCamera()),
      scene_(makeScene(config)),
      walk_(scene_, config.walk_seed, config.lap_s, (config.with & SPHC_SIMULATED_FEET) != 0) {}

int64_t Headset::colorTime(uint32_t index) const {
  return config_.start_time_ns + std::llround(static_cast<double>(index) * 1e9 / config_.frame_rate_hz);
}

Pose Headset::colorPoseAfter(int64_t time_ns, double offset_s) const {
  return walk_.at(walkTime(time_ns) + offset_s);
}

Pose Headset::depthPose(int64_t time_ns) const {
  return compose(colorPose(time_ns), poseOf(cameras_.rig.color_from_depth));
}

uint64_t Headset::noiseSeed(uint32_t index, uint64_t stream) const {
  // Counted from the begin of the walk, so that lap two has the noise of lap two wherever frame 0 is.
  const auto skipped = static_cast<uint64_t>(std::llround(config_.walk_start_s * config_.frame_rate_hz));
  return hash64(hash64(config_.seed, config_.walk_seed), 2 * (skipped + index) + stream);
}

// Of a camera of its own: by where it is.
uint64_t Headset::noiseSeed(const Pose &pose, int64_t time_ns, uint64_t stream) const {
  uint64_t seed = hash64(hash64(config_.seed, config_.walk_seed), static_cast<uint64_t>(time_ns) + stream);
  for (const double t : {pose.center.x, pose.center.y, pose.center.z})
    seed = hash64(seed, static_cast<uint64_t>(std::llround(t * 1e6)));
  for (const Vec3d &row : pose.rotation.row) seed = hash64(seed, static_cast<uint64_t>(std::llround(row.z * 1e6)));
  return seed;
}

std::vector<Shape> Headset::shapesAt(int64_t time_ns) const {
  std::vector<Shape> shapes = scene_.shapes;
  scene_.actors.move(walk_, walkTime(time_ns), shapes);
  return shapes;
}

void Headset::oracleColor(int64_t time_ns, float *depth_m) const {
  oracle(scene_, shapesAt(time_ns), colorCamera(), color_rays_, colorPose(time_ns), config_.threads, depth_m);
}

void Headset::oracleView(const sphc_camera &camera, const Pose &pose, int64_t time_ns, float *depth_m) const {
  oracle(scene_, shapesAt(time_ns), camera, RayTable(camera), pose, config_.threads, depth_m);
}

void Headset::oracleDepth(int64_t time_ns, float *depth_m) const {
  oracle(scene_, shapesAt(time_ns), depthCamera(), depth_rays_, depthPose(time_ns), config_.threads, depth_m);
}

}  // namespace sphc::simulated
