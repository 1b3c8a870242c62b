// Points of the test room, and maps of them.
#pragma once
#include <utility>
#include <vector>

#include "tests/support/random_numbers.h"
#include "tests/support/scene_map.h"
#include "tests/support/session.h"

namespace sphc::test {

// The points that the first viewpoints show, where they are in the room.
inline std::vector<WorldPoint> pointsOfTheRoom() {
  const sphc_localizer_config config = sceneConfig();
  ViewDescriber describer(config.rig.color_camera, config.max_keypoints);
  std::vector<WorldPoint> points;
  for (uint32_t view = 0; view < 3; ++view) {
    const Rigid camera_from_world = sceneViewpoint(view);
    const auto images = renderScene(config.rig.color_camera, config.rig.color_camera, camera_from_world, Rigid());
    describer.describe(images, camera_from_world, &points);
  }
  return points;
}

// So few that half of a frame is not beyond the challenges.
inline std::vector<WorldPoint> mostPointsOfTheRoom() {
  const std::vector<WorldPoint> all = pointsOfTheRoom();
  std::vector<WorldPoint> kept;
  for (size_t i = 0; i < all.size(); ++i)
    if (i % 20 < 15) kept.push_back(all[i]);
  return kept;
}

// All of them real.
inline std::vector<SceneMap> mapOf(const std::vector<WorldPoint> &points, const Vector3 &centre_m) {
  return {{encodeMap(sphereCloud(points, centre_m, 1), kExtractorId), centre_m}};
}

// Every byte by `amount` up or down, so that descriptors are known to lie so far apart.
inline Descriptor shifted(Descriptor descriptor, int amount, Random *random) {
  for (uint8_t &byte : descriptor.bytes) {
    const bool up = byte < amount || (byte <= 255 - amount && random->below(2));
    byte = static_cast<uint8_t>(up ? byte + amount : byte - amount);
  }
  return descriptor;
}

// Its descriptor in the map is so far off, and that of another point, which lies anywhere, a little farther.
inline void addWithNearDuplicate(const WorldPoint &point, int amount, Random *random,
                                 std::vector<WorldPoint> *points) {
  points->push_back({point.position_m, shifted(point.descriptor, amount, random)});
  points->push_back(
      {Vector3(0, 0, 1) + 3 * randomDirection(random), shifted(point.descriptor, amount + 1, random)});
}

// All of the room; they pass the ratio test at 0.89 and not before.
inline std::vector<WorldPoint> pointsWithNearDuplicates() {
  Random random(5);
  std::vector<WorldPoint> points;
  for (const WorldPoint &point : pointsOfTheRoom()) addWithNearDuplicate(point, 8, &random, &points);
  return points;
}

}  // namespace sphc::test
