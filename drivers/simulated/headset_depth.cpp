// headset_depth.cpp - the ToF camera: mixed pixels, range bias, noise by returned light, missing measurements.
#include <algorithm>
#include <cmath>

#include "drivers/simulated/headset.h"
#include "drivers/simulated/parallel.h"
#include "drivers/simulated/raster.h"
#include "drivers/simulated/smooth_depth.h"

namespace sphc::simulated {
namespace {

// Rays a pixel: its light is the sum of theirs, and at an edge so is its range.
constexpr float kDepthOffsets[kLanes][2] = {{-0.32f, -0.14f}, {0.14f, -0.32f}, {-0.14f, 0.32f}, {0.32f, 0.14f}};

// Returned light: reflectance times cosine over squared distance.  Below kBlind nothing is measured; up to kDim
// ever more is.
constexpr float kBlind = 0.0035f, kDim = 0.0075f;
constexpr float kCountsOfLight = 10000;  // so that kDim is SPHC_SIMULATED_FAINT
static_assert(kCountsOfLight * kDim == SPHC_SIMULATED_FAINT);
// Depths that differ by more than this within a pixel are an edge; the sensor notices some of them.
constexpr float kEdgeMetres = 0.08f;
constexpr float kEdgeNoticed = 0.55f;

struct Echo {
  float z = 0;        // mean depth, weighted by light
  float spread = 0;   // largest minus least depth
  float light = 0;    // reflectance times cosine / distance^2, mean
  float surface = 0;  // reflectance times cosine, mean
};

// What comes back to one pixel.
Echo listen(const Scene &scene, const Raster &raster, const RayTable &rays, float focal, uint32_t column,
            uint32_t row, const Raster::List &list) {
  Echo echo;
  float nearest = kFar, farthest = 0, weighted = 0;
  Rays four;
  for (uint32_t i = 0; i < kLanes; ++i)
    four.lane[i] = rays.at(column, row, kDepthOffsets[i][0], kDepthOffsets[i][1]);
  const Hits hits = raster.cast(list, four);
  for (uint32_t i = 0; i < kLanes; ++i) {
    const Hit &hit = hits.lane[i];
    const Ray2 &ray = four.lane[i];
    const Seen seen = raster.look(hit, i, ray);
    // The level whose texels are about as large as a quarter of a pixel.
    const int level = std::ilogb(std::max(1.0f, 0.7f * hit.z / (focal * seen.texture->texel_m)));
    const Texel texel = scene.pool.sample(*seen.texture, seen.u, seen.v, level);
    const float surface = static_cast<float>(texel >> 24) * (1.0f / 255.0f) * seen.cosine;
    const float light = surface / (hit.z * hit.z * (1 + ray.x * ray.x + ray.y * ray.y));
    weighted += light * hit.z;
    echo.light += light;
    echo.surface += surface;
    nearest = std::min(nearest, hit.z);
    farthest = std::max(farthest, hit.z);
  }
  echo.z = weighted / std::max(echo.light, 1e-9f);
  echo.spread = farthest - nearest;
  echo.light /= kLanes;
  echo.surface /= kLanes;
  return echo;
}

uint16_t units(double z_m) {
  return static_cast<uint16_t>(std::clamp(std::round(z_m / SPHC_SIMULATED_DEPTH_UNIT_M), 0.0, 65535.0));
}

void toUnits(const std::vector<float> &z_m, uint16_t *depth) {
  std::transform(z_m.begin(), z_m.end(), depth, [](float z) { return units(static_cast<double>(z)); });
}

bool isMissing(const Echo &echo, float z_max, uint64_t chance) {
  if (echo.z > z_max || echo.light < kBlind * 0.25f) return true;
  const float seen = std::clamp((echo.light - kBlind * 0.5f) / (kDim - kBlind * 0.5f), 0.0f, 1.0f);
  const auto low = static_cast<uint32_t>(chance), high = static_cast<uint32_t>(chance >> 32);
  if (unitFloat(low) > seen) return true;
  return echo.spread > kEdgeMetres && unitFloat(high) < kEdgeNoticed;
}

double measure(const sphc_simulated_config &config, const Echo &echo, uint64_t noise) {
  const auto z = static_cast<double>(echo.z);
  const double bias = config.depth_offset_m + config.depth_wiggle_m * std::sin(z * (2 * 3.14159265358979 / 1.5));
  // A wall of reflectance 0.55 seen straight on is the measure of good light.
  const double light = std::clamp(std::sqrt(0.55 / std::max(1e-3, static_cast<double>(echo.surface))), 0.6, 3.0);
  const double sigma = (config.depth_sigma_m + config.depth_sigma_per_m2 * z * z) * light;
  return config.depth_scale * z + bias + sigma * static_cast<double>(gaussian(noise));
}

// Noise rises as light falls; of nearly none any phase is read, and a distance beyond the range is read as one
// within.
double measureRaw(const sphc_simulated_config &config, const Echo &echo, float z_max, uint64_t chance,
                  uint64_t noise) {
  if (echo.light < kBlind) return static_cast<double>(z_max * unitFloat(static_cast<uint32_t>(chance)));
  Echo heard = echo;
  heard.z = std::fmod(echo.z, z_max);
  const double z = measure(config, heard, noise), faint = static_cast<double>(std::max(1.0f, kDim / echo.light));
  return static_cast<double>(heard.z) + (z - static_cast<double>(heard.z)) * faint * faint;
}

}  // namespace

void Headset::renderIdealDepth(uint32_t index, uint16_t *depth) const {
  std::vector<float> z(size_t{depthCamera().width} * depthCamera().height);
  oracleDepth(depthTime(index), z.data());
  toUnits(z, depth);
}

View Headset::depthView(uint32_t index) const {
  return {depthCamera(), depth_rays_, 0, depthTime(index), noiseSeed(index, 1)};
}

template <typename Visit>
void Headset::forEchoes(const View &view, const Pose &pose, const Visit &visit) const {
  const std::vector<Shape> shapes = shapesAt(view.time_ns);
  const Raster raster(scene_, shapes, view.camera, view.rays, posesOf(pose));
  const auto focal = static_cast<float>(view.camera.params[0]);
  parallelFor(raster.tileRows(), config_.threads, [&](uint32_t tile_row) {
    raster.forTileRow(tile_row, [&](uint32_t column, uint32_t row, const Raster::List &list) {
      const uint64_t pixel = static_cast<uint64_t>(row) * view.camera.width + column;
      visit(pixel, listen(scene_, raster, view.rays, focal, column, row, list), view.rays.center(column, row));
    });
  });
}

void Headset::renderDepth(uint32_t index, uint16_t *depth) const {
  if (config_.ideal_depth != 0) return renderIdealDepth(index, depth);
  measureDepth(depthView(index), depthPose(depthTime(index)), depth);
  if (cameras_.smooths_depth) smoothDepth(depthCamera().width, depthCamera().height, depth);
}

void Headset::renderViewDepth(const sphc_camera &camera, const Pose &pose, int64_t time_ns, uint16_t *depth) const {
  if (config_.ideal_depth != 0) {
    std::vector<float> z(size_t{camera.width} * camera.height);
    oracleView(camera, pose, time_ns, z.data());
    return toUnits(z, depth);
  }
  const RayTable rays(camera);
  measureDepth({camera, rays, 0, time_ns, noiseSeed(pose, time_ns, 1)}, pose, depth);
}

void Headset::measureDepth(const View &view, const Pose &pose, uint16_t *depth) const {
  const uint64_t seed = view.seed;
  const auto far_m = static_cast<float>(config_.depth_max_m);
  forEchoes(view, pose, [&](uint64_t pixel, const Echo &echo, const Ray2 &center) {
    const float z_max = far_m / std::sqrt(1 + center.x * center.x + center.y * center.y);
    const uint64_t chance = hash64(seed + 2 * pixel), noise = hash64(seed + 2 * pixel + 1);
    if (config_.raw_depth != 0) {
      depth[pixel] = units(measureRaw(config_, echo, z_max, chance, noise));
      return;
    }
    depth[pixel] = isMissing(echo, z_max, chance) ? uint16_t{0} : units(measure(config_, echo, noise));
  });
}

void Headset::renderAmplitude(uint32_t index, uint16_t *amplitude) const {
  forEchoes(depthView(index), depthPose(depthTime(index)), [&](uint64_t pixel, const Echo &echo, const Ray2 &) {
    amplitude[pixel] = static_cast<uint16_t>(std::min(kCountsOfLight * echo.light + 0.5f, 65535.0f));
  });
}

}  // namespace sphc::simulated
