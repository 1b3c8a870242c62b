#include "tests/support/scene.h"

#include <cmath>

#include "runtime/base/elementary.h"

namespace sphc::test {
namespace {

const double kLow[3] = {-1.8, -1.5, -1}, kHigh[3] = {1.8, 1.2, 3};

uint32_t hash(uint32_t x, uint32_t y, uint32_t salt) {
  uint32_t h = x * 0x8DA6B343u ^ y * 0xD8163841u ^ salt * 0xCB1AB31Fu;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return h ^ (h >> 15);
}

// Smooth noise in [0, 1] with cells of unit size.
double noise(double x, double y, uint32_t salt) {
  const double cx = floorOf(x), cy = floorOf(y), fx = x - cx, fy = y - cy;
  const double sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
  const auto at = [&](int dx, int dy) {
    const auto ix = static_cast<uint32_t>(static_cast<int32_t>(cx) + dx);
    const auto iy = static_cast<uint32_t>(static_cast<int32_t>(cy) + dy);
    return static_cast<double>(hash(ix, iy, salt) & 0xFFFF) / 65535;
  };
  return (at(0, 0) * (1 - sx) + at(1, 0) * sx) * (1 - sy) + (at(0, 1) * (1 - sx) + at(1, 1) * sx) * sy;
}

double shade(double u, double v, uint32_t wall, uint32_t room) {
  double sum = 0;
  const double cells[] = {0.31, 0.13, 0.055, 0.028}, weights[] = {0.25, 0.3, 0.3, 0.15};
  for (uint32_t k = 0; k < 4; ++k) sum += weights[k] * noise(u / cells[k], v / cells[k], (room * 6 + wall) * 8 + k);
  return sum;
}

// Where a ray that starts inside leaves the room: the parameter, and which wall (0 to 5).
double leave(const Vector3 &origin, const Vector3 &direction, uint32_t *wall) {
  double nearest = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    const bool up = direction[axis] > 0;
    const double t = ((up ? kHigh : kLow)[axis] - origin[axis]) / direction[axis];
    if (t < nearest) nearest = t, *wall = static_cast<uint32_t>(2 * axis + (up ? 1 : 0));
  }
  return nearest;
}

Vector3 rayOf(const sphc_camera &camera, uint32_t x, uint32_t y) {
  return {(x + 0.5 - camera.params[2]) / camera.params[0], (y + 0.5 - camera.params[3]) / camera.params[1], 1};
}

}  // namespace

SceneImages renderScene(const sphc_camera &color, const sphc_camera &depth, const Rigid &color_from_world,
                        const Rigid &color_from_depth, uint32_t room) {
  SceneImages images;
  const Rigid world_from_color = color_from_world.inverse(), world_from_depth = world_from_color * color_from_depth;
  for (uint32_t y = 0; y < color.height; ++y) {
    for (uint32_t x = 0; x < color.width; ++x) {
      const Vector3 direction = world_from_color.rotation * rayOf(color, x, y);
      uint32_t wall = 0;
      const double t = leave(world_from_color.translation_m, direction, &wall);
      const Vector3 hit = world_from_color.translation_m + t * direction;
      const int axis = static_cast<int>(wall / 2);
      const double value = shade(hit[(axis + 1) % 3], hit[(axis + 2) % 3], wall, room);
      images.gray.push_back(static_cast<uint8_t>(20 + 215 * value));
    }
  }
  for (uint32_t y = 0; y < depth.height; ++y) {
    for (uint32_t x = 0; x < depth.width; ++x) {
      uint32_t wall = 0;
      const double t = leave(world_from_depth.translation_m, world_from_depth.rotation * rayOf(depth, x, y), &wall);
      images.depth_mm.push_back(static_cast<uint16_t>(t * 1000 + 0.5));
    }
  }
  return images;
}

sphc_camera pinhole(uint32_t width, uint32_t height, double focal_px) {
  return {SPHC_CAMERA_PINHOLE, width, height, 4, {focal_px, focal_px, width / 2.0, height / 2.0}};
}

Rigid sceneViewpoint(double step) {
  Rigid world_from_camera;
  world_from_camera.rotation = rotationFromVector(Vector3(0.02 * step, -0.04 * step + 0.05, 0.015 * step));
  world_from_camera.translation_m = Vector3(0.05 * step - 0.1, -0.02 * step, 0.04 * step);
  return world_from_camera.inverse();
}

}  // namespace sphc::test
