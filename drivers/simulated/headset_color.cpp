// headset_color.cpp - the colour camera: exposure, blur, lens, sensor noise.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "drivers/simulated/headset.h"
#include "drivers/simulated/menu.h"
#include "drivers/simulated/parallel.h"
#include "drivers/simulated/raster.h"

namespace sphc::simulated {
namespace {

// Four rays a pixel, on a turned square, each at its own quarter of the exposure, or of a part of it: where the
// view turns by more pixels than this, the exposure is mixed from several, lest it leave four pictures side by
// side.
constexpr double kLongestPartPx = 8;
constexpr double kMostParts = 16;
constexpr float kColorOffsets[kLanes][2] = {
    {-0.125f, -0.375f}, {0.375f, -0.125f}, {-0.375f, 0.125f}, {0.125f, 0.375f}};

// Full scale is 1.  A tone of 0.3 gets a noise of 0.0079, about 2 of 255 after the gamma.
constexpr float kReadNoise = 0.0016f, kShotNoise = 2e-4f;

struct Squares {
  float of[256];
  Squares() : of() {
    for (int i = 0; i < 256; ++i) of[i] = static_cast<float>(i * i) / (255.0f * 255.0f);
  }
};

inline float log2Approximate(float x) {
  // The exponent of a float, plus a parabola for its mantissa: within 0.01.
  uint32_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  const float exponent = static_cast<float>(static_cast<int32_t>(bits >> 23) - 127);
  bits = (bits & 0x7FFFFFu) | 0x3F800000u;
  float m = 0;
  std::memcpy(&m, &bits, sizeof m);
  return exponent + (-0.33582878f * m + 2.0f) * m - 1.65871022f;
}

// Rounding: the cast cuts, and the value is never negative.
struct Sensor {
  float read_sq, shot;
};
// `level`: the light that there is; the gain that makes up for the rest raises the noise.
Sensor sensorAt(float level) {
  const float read = kReadNoise / level;
  return {read * read, kShotNoise / level};
}
inline uint8_t develop(const Sensor &sensor, float light, float noise) {
  const float noisy = light + noise * std::sqrt(sensor.read_sq + sensor.shot * light);
  return static_cast<uint8_t>(255.0f * std::sqrt(std::clamp(noisy, 0.0f, 1.0f)) + 0.5f);
}

// Brightness over time: the room is bright and dark by turns and the exposure control is slow.
float exposureAt(double time_s) {
  return static_cast<float>(1 + 0.14 * std::sin(0.83 * time_s) + 0.07 * std::sin(2.1 * time_s + 1.3));
}

// A pixel of a fisheye keeps its angle, so what it covers grows with the distance and not with z.
float distanceOverZ(const View &view, uint32_t column, uint32_t row) {
  if (view.camera.model != SPHC_CAMERA_KANNALA_BRANDT4) return 1;
  const Ray2 &ray = view.rays.center(column, row);
  return std::sqrt(1 + ray.x * ray.x + ray.y * ray.y);
}

}  // namespace

void Headset::gatherRows(const View &view, const Raster &raster, uint32_t top, uint32_t bottom,
                         std::vector<Light> *lights) const {
  static const Squares kSquares;
  // A ray stands for half a pixel on a side; a little sharper than that keeps fine texture.
  const float footprint_on_axis = 0.6f / static_cast<float>(view.camera.params[0]);
  raster.forRows(top, bottom, [&](uint32_t column, uint32_t row, const Raster::List &list) {
    Light sum;
    Rays rays;
    for (uint32_t i = 0; i < kLanes; ++i) {
      rays.lane[i] = view.rays.at(column, row, kColorOffsets[i][0], kColorOffsets[i][1]);
    }
    const Hits hits = raster.cast(list, rays);
    const float footprint = footprint_on_axis * distanceOverZ(view, column, row);
    for (uint32_t i = 0; i < kLanes; ++i) {
      const Hit &hit = hits.lane[i];
      const Seen seen = raster.look(hit, i, rays.lane[i]);
      // Between the short and the long side of a slanted footprint.
      const float size = hit.z * footprint / (seen.texture->texel_m * std::sqrt(seen.cosine));
      // Each ray takes one level; together they mix the two that are nearest.
      const float level = log2Approximate(size) + (static_cast<float>(i) + 0.5f) / kLanes;
      const Texel texel =
          scene_.pool.sample(*seen.texture, seen.u, seen.v, static_cast<int>(std::max(level, 0.0f)));
      sum.r += kSquares.of[texel & 255];
      sum.g += kSquares.of[(texel >> 8) & 255];
      sum.b += kSquares.of[(texel >> 16) & 255];
    }
    Light &light = (*lights)[static_cast<size_t>(row) * view.camera.width + column];
    light.r += sum.r;
    light.g += sum.g;
    light.b += sum.b;
  });
}

void Headset::gatherLight(const View &view, const Raster &raster, std::vector<Light> *lights) const {
  parallelFor(raster.tileRows(), config_.threads, [&](uint32_t tile_row) {
    gatherRows(view, raster, tile_row * kTile, std::min((tile_row + 1) * kTile, view.camera.height), lights);
  });
}

void Headset::gatherRowByRow(const View &view, const Part &part, std::vector<Light> *lights) const {
  parallelFor(view.camera.height, config_.threads, [&](uint32_t row) {
    const double rows_below_middle = row + 0.5 - 0.5 * view.camera.height;
    const int64_t time_ns =
        view.time_ns + std::llround(rows_below_middle * static_cast<double>(config_.color_row_time_ns));
    const std::vector<Shape> shapes = shapesAt(time_ns);
    const Raster raster(scene_, shapes, view.camera, view.rays, posesDuring(part, time_ns));
    gatherRows(view, raster, row, row + 1, lights);
  });
}

Poses Headset::posesDuring(const Part &part, int64_t time_ns) const {
  Poses poses;
  for (uint32_t i = 0; i < kLanes; ++i) {
    const double share = (part.index * kLanes + i + 0.5) / (part.count * kLanes) - 0.5;
    poses.lane[i] = colorPoseAfter(time_ns, config_.motion_blur != 0 ? share * exposure_s() : 0);
  }
  return poses;
}

void Headset::renderColor(uint32_t index, uint8_t *rgb) const {
  const int64_t time_ns = colorTime(index);
  const std::vector<Shape> shapes = shapesAt(time_ns);
  const Vec3d ahead = {0, 0, 1}, turned = colorPoseAfter(time_ns, exposure_s() / 2).rotation * ahead -
                                          colorPoseAfter(time_ns, -exposure_s() / 2).rotation * ahead;
  const double turned_px = std::sqrt(dot(turned, turned)) * colorCamera().params[0];
  const auto parts = static_cast<uint32_t>(std::clamp(std::ceil(turned_px / kLongestPartPx), 1.0, kMostParts));
  const View view = {colorCamera(), color_rays_, cameras_.vignetting, time_ns, noiseSeed(index, 0)};
  std::vector<Light> lights(static_cast<size_t>(colorCamera().width) * colorCamera().height);
  for (uint32_t i = 0; i < parts; ++i) {
    const Part part = {i, parts};
    if (config_.color_row_time_ns != 0) {
      gatherRowByRow(view, part, &lights);
    } else {
      gatherLight(view, Raster(scene_, shapes, colorCamera(), color_rays_, posesDuring(part, time_ns)), &lights);
    }
  }
  developAll(view, lights, parts, rgb);
  if ((config_.with & SPHC_SIMULATED_MENU) != 0)
    drawMenu(walkTime(time_ns), colorCamera().width, colorCamera().height, rgb);
}

void Headset::renderView(const sphc_camera &camera, const Pose &pose, int64_t time_ns, uint8_t *rgb) const {
  const RayTable rays(camera);
  const View view = {camera, rays, cameras_.vignetting, time_ns, noiseSeed(pose, time_ns, 0)};
  const std::vector<Shape> shapes = shapesAt(time_ns);
  std::vector<Light> lights(static_cast<size_t>(camera.width) * camera.height);
  gatherLight(view, Raster(scene_, shapes, camera, rays, posesOf(pose)), &lights);
  developAll(view, lights, 1, rgb);
}

void Headset::developAll(const View &view, const std::vector<Light> &lights, uint32_t parts, uint8_t *rgb) const {
  const float gain =
      (config_.exposure_drift != 0 ? exposureAt(walkTime(view.time_ns)) : 1.0f) * scene_.lighting.brightness;
  const Sensor sensor = sensorAt(scene_.lighting.level);
  const uint64_t seed = view.seed;
  const float noise = config_.color_noise != 0 ? 1.0f : 0.0f;
  const uint32_t width = view.camera.width;
  parallelFor(view.camera.height, config_.threads, [&](uint32_t row) {
    for (uint32_t column = 0; column < width; ++column) {
      const Ray2 &center = view.rays.center(column, row);
      const float off_axis = center.x * center.x + center.y * center.y;
      const float fall = 1 + view.vignetting * off_axis;
      const float vignette = 1.0f / (fall * fall);
      const float scale = gain * vignette / static_cast<float>(parts * kLanes);
      const uint64_t pixel = static_cast<uint64_t>(row) * width + column;
      const Light &light = lights[pixel];
      uint8_t *out = rgb + 3 * pixel;
      out[0] = develop(sensor, light.r * scale, noise * gaussian(hash64(seed + 3 * pixel)));
      out[1] = develop(sensor, light.g * scale, noise * gaussian(hash64(seed + 3 * pixel + 1)));
      out[2] = develop(sensor, light.b * scale, noise * gaussian(hash64(seed + 3 * pixel + 2)));
    }
  });
}

}  // namespace sphc::simulated
