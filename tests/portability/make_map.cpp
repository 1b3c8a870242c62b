// Writes room.sphc, the map that replay.c localizes in: make_map FILE.  docs/platforms.md says when.
#include <cstdio>
#include <fstream>

#include "tests/support/scene_map.h"

extern "C" {
#include "tests/portability/replay.h"
}

namespace {

constexpr uint32_t kKeypoints = 300, kCells = 8;
constexpr double kEta = 0.5;

sphc::Vector3 metres(const int32_t um[3]) { return sphc::Vector3(um[0], um[1], um[2]) * 1e-6; }

sphc::Rigid cameraFromWorld(const room_view &view) {
  const int32_t *q = view.q_wxyz;
  const double quaternion[4] = {double(q[0]), double(q[1]), double(q[2]), double(q[3])};
  return sphc::Rigid{sphc::rotationFromQuaternion(quaternion), metres(view.position_um)}.inverse();
}

}  // namespace

int main(int argc, char **argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: make_map FILE\n"), 2;
  const room_camera &room = replay_color_camera;
  const auto width = static_cast<uint32_t>(room.width), height = static_cast<uint32_t>(room.height);
  sphc::test::ViewDescriber describer(sphc::test::pinhole(width, height, room.focal_px), kKeypoints);
  std::vector<sphc::test::WorldPoint> points;
  for (const room_view &view : replay_map_views) {
    sphc::test::SceneImages images;
    images.gray.resize(size_t{width} * height);
    images.depth_mm.resize(images.gray.size());
    room_render_gray(&room, &view, 0, images.gray.data());
    room_render_depth(&room, &view, images.depth_mm.data());
    describer.describe(images, cameraFromWorld(view), &points);
  }
  const std::vector<uint8_t> file = sphc::test::encodeIndexedMap(
      sphc::test::sphereCloud(points, metres(replay_centre_um), kEta), kCells, sphc::kExtractorId);
  std::ofstream out(argv[1], std::ios::binary);
  out.write(reinterpret_cast<const char *>(file.data()), static_cast<std::streamsize>(file.size()));
  out.close();
  return out ? 0 : 1;
}
