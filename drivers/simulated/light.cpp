#include "drivers/simulated/light.h"

#include <algorithm>
#include <vector>

#include "drivers/simulated/with.h"

namespace sphc::simulated {
namespace {

constexpr float kLift = 0.006f;  // a ray leaves its surface this far, so that it does not meet it again
constexpr int kOpenRays = 11;
constexpr float kHanging = 1.9f;  // a shade higher than this is the ceiling lamp's

// Directions around a normal, cosine-weighted: a golden-angle spiral over the disc, lifted to the hemisphere.
Vec3f openDirection(const Vec3f &normal, int i) {
  const float r2 = (static_cast<float>(i) + 0.5f) / kOpenRays, angle = 2.39996323f * static_cast<float>(i);
  const Vec3f side =
      normalized(std::fabs(normal.z) < 0.9f ? cross(normal, Vec3f{0, 0, 1}) : cross(normal, Vec3f{1, 0, 0}));
  const Vec3f other = cross(normal, side);
  const float r = std::sqrt(r2);
  return side * (r * std::cos(angle)) + other * (r * std::sin(angle)) + normal * std::sqrt(1 - r2);
}

// How much of the hemisphere is open within arm's reach.
float openness(const Bvh &bvh, const Vec3f &point, const Vec3f &normal) {
  constexpr float kReach = 0.5f;
  int open = 0;
  for (int i = 0; i < kOpenRays; ++i) {
    if (!bvh.blocked(point, openDirection(normal, i), kReach)) ++open;
  }
  return static_cast<float>(open) / kOpenRays;
}

// A lamp is four points on a small square, which softens its shadows.
float lampLight(const Bvh &bvh, const Vec3f &point, const Vec3f &normal, const Vec3f &lamp) {
  constexpr float kSpread = 0.16f;
  constexpr Vec3f kCorners[4] = {{1, 0.4f, 0}, {-0.4f, 1, 0}, {-1, -0.4f, 0}, {0.4f, -1, 0}};
  float sum = 0;
  for (const Vec3f &corner : kCorners) {
    const Vec3f way = lamp + corner * kSpread - point;
    const float r2 = dot(way, way);
    const float cosine = dot(way, normal) / std::sqrt(r2);
    if (cosine <= 0 || bvh.blocked(point, way, 0.9f)) continue;
    sum += cosine / (0.9f + 0.45f * r2);
  }
  return 0.25f * sum;
}

float windowLight(const Bvh &bvh, const RoomPlan &plan, const Vec3f &point, const Vec3f &normal) {
  const Vec3f side = cross(plan.window_normal, Vec3f{0, 0, 1});
  float sum = 0;
  for (int i = 0; i < 6; ++i) {
    const Vec3f spot =
        plan.window + side * (0.35f * static_cast<float>(i % 3 - 1)) + Vec3f{0, 0, i < 3 ? 0.25f : -0.25f};
    const Vec3f way = spot - point;
    const float r2 = dot(way, way), r = std::sqrt(r2);
    const float out = -dot(way, plan.window_normal) / r, in = dot(way, normal) / r;
    if (out <= 0 || in <= 0 || bvh.blocked(point, way, 1)) continue;
    sum += out * in / (0.4f + r2);
  }
  return sum / 6;
}

// The sun, 35 degrees high and to one side of the window.
float sunLight(const Bvh &bvh, const RoomPlan &plan, const Vec3f &point, const Vec3f &normal) {
  constexpr float kHalfHeight = 0.6f;
  const Vec3f side = cross(plan.window_normal, Vec3f{0, 0, 1});
  const Vec3f to_sun = normalized(plan.window_normal * -1.0f + side * 0.35f + Vec3f{0, 0, 0.75f});
  const float cosine = dot(to_sun, normal), inward = -dot(to_sun, plan.window_normal);
  const float way = dot(point - plan.window, plan.window_normal) / inward;
  if (cosine <= 0 || way <= 0) return 0;
  const Vec3f through = point + to_sun * way - plan.window;
  if (std::fabs(dot(through, side)) > plan.window_half_m || std::fabs(through.z) > kHalfHeight) return 0;
  return bvh.blocked(point, to_sun, way) ? 0 : cosine;
}

// Square root of the light at a point of a face: texels are square roots too.
Vec3f rootLight(const Bvh &bvh, const RoomPlan &plan, const Lighting &lighting, const Vec3f &point,
                const Vec3f &normal) {
  constexpr Vec3f kSunColor{1.1f, 1.0f, 0.85f};
  const float open = openness(bvh, point, normal);
  float lamps = 0;
  for (const Lamp &lamp : plan.lamps) {
    const float strength = lamp.strength * (lamp.hangs ? lighting.hanging : lighting.standing);
    if (strength > 0) lamps += strength * lampLight(bvh, point, normal, lamp.position);
  }
  const float sky = lighting.sky * 1.7f * windowLight(bvh, plan, point, normal);
  const float ambient = lighting.ambient * (0.14f + 0.46f * open * open);
  Vec3f light = lighting.lamp_color * (ambient + 0.72f * lamps) + lighting.sky_color * sky;
  if (lighting.sun > 0) light = light + kSunColor * (lighting.sun * sunLight(bvh, plan, point, normal));
  const auto root = [](float x) { return std::sqrt(std::min(x, 1.35f)); };
  return {root(light.x), root(light.y), root(light.z)};
}

Texel dim(Texel texel, const Vec3f &gain) {
  const auto channel = [&](int shift, float g) {
    const float value = static_cast<float>((texel >> shift) & 255u) * g + 0.5f;
    return static_cast<Texel>(std::min(value, 255.0f)) << shift;
  };
  return channel(0, gain.x) | channel(8, gain.y) | channel(16, gain.z) | (texel & 0xFF000000u);
}

Vec3f mixed(const Vec3f &a, const Vec3f &b, float t) { return a + (b - a) * t; }

}  // namespace

Lighting lightingOf(uint32_t with) {
  Lighting light;
  if ((with & SPHC_SIMULATED_DAY) != 0) {
    light.lamp_color = {0.9f, 0.96f, 1.04f};  // what is left of it is reflected sky
    light.hanging = light.standing = 0;
    light.ambient = 0.7f;
    light.sky = 2.2f;
    light.sun = 0.9f;
    light.outdoors = 1.15f;
  } else if ((with & SPHC_SIMULATED_NIGHT) != 0) {
    light.lamp_color = {1.0f, 0.74f, 0.45f};
    light.hanging = light.sky = 0;
    light.standing = 4;
    light.ambient = 0.3f;
    light.outdoors = 0.12f;
    light.level = 0.25f;
    light.brightness = 0.85f;
    light.exposure_time = 1.5f;
  } else if ((with & SPHC_SIMULATED_DARK) != 0) {
    light.lamp_color = {0.75f, 0.88f, 1.1f};
    light.hanging = light.standing = 0;
    light.ambient = 0.45f;
    light.sky = 0.5f;
    light.outdoors = 0.45f;
    light.level = 0.08f;
    light.brightness = 0.5f;
    light.exposure_time = 2;
  }
  return light;
}

void glow(const Lighting &lighting, const Shape &shape, Material material, const Texture &texture, Texel *texels) {
  // A lampshade is brightest where its own lamp is on.
  const float lamp = shape.center.z > kHanging ? lighting.hanging : lighting.standing;
  const float light = isOutdoors(material) ? lighting.outdoors : std::clamp(lamp, 0.3f * lighting.ambient, 1.0f);
  if (light == 1) return;
  const float root = std::sqrt(light);
  for (size_t i = 0; i < static_cast<size_t>(texture.width) * texture.height; ++i) {
    texels[i] = dim(texels[i], {root, root, root});
  }
}

void shade(const Bvh &bvh, const FloorPlan &plan, const Lighting &lighting, const Shape &shape, int face,
           const Texture &texture, Texel *texels) {
  constexpr float kPitch = 0.12f;
  float width_m = 0, height_m = 0;
  faceSize(shape, face, &width_m, &height_m);
  const int columns = 2 + static_cast<int>(width_m / kPitch), rows = 2 + static_cast<int>(height_m / kPitch);
  std::vector<Vec3f> grid(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  const auto cell = [columns](int i, int j) {
    return static_cast<size_t>(j) * static_cast<size_t>(columns) + static_cast<size_t>(i);
  };
  // A small face is lit evenly.
  const bool even = std::max(width_m, height_m) < kPitch;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      if (even && i + j > 0) {
        grid[cell(i, j)] = grid[0];
        continue;
      }
      // Samples keep off the edges, where a neighbouring solid may touch the face.
      const float u = even ? 0.5f : 0.02f + 0.96f * static_cast<float>(i) / static_cast<float>(columns - 1);
      const float v = even ? 0.5f : 0.02f + 0.96f * static_cast<float>(j) / static_cast<float>(rows - 1);
      Vec3f unit, normal;
      facePoint(shape, face, u, v, &unit, &normal);
      const Vec3f point = worldPoint(shape, unit) + normal * kLift;
      grid[cell(i, j)] = rootLight(bvh, plan.roomAt(point), lighting, point, normal);
    }
  }
  const float to_column = static_cast<float>(columns - 1) / static_cast<float>(texture.width);
  const float to_row = static_cast<float>(rows - 1) / static_cast<float>(texture.height);
  for (uint32_t y = 0; y < texture.height; ++y) {
    const float gy = (static_cast<float>(y) + 0.5f) * to_row;
    const int j = std::min(static_cast<int>(gy), rows - 2);
    for (uint32_t x = 0; x < texture.width; ++x) {
      const float gx = (static_cast<float>(x) + 0.5f) * to_column;
      const int i = std::min(static_cast<int>(gx), columns - 2);
      const Vec3f *g = &grid[cell(i, j)];
      const float fx = gx - static_cast<float>(i), fy = gy - static_cast<float>(j);
      Texel &texel = texels[static_cast<size_t>(y) * texture.width + x];
      texel = dim(texel, mixed(mixed(g[0], g[1], fx), mixed(g[columns], g[columns + 1], fx), fy));
    }
  }
}

}  // namespace sphc::simulated
