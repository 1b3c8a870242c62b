#include "host/import/upright.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sphc::host {
namespace {

// Cameras that look around and nod, in a world whose down is its z axis turned about x.
std::vector<Matrix3> looking(double tilt_rad, double pitch_rad) {
  std::vector<Matrix3> camera_from_world;
  for (int i = 0; i < 12; ++i) {
    const Matrix3 world_from_level = rotationFromVector(Vector3(tilt_rad, 0, 0)) *
                                     rotationFromVector(Vector3(0, 0, 0.4 * i)) *
                                     rotationFromVector(Vector3(-0.5 * std::acos(-1.0), 0, 0));
    const Matrix3 world_from_camera =
        world_from_level * rotationFromVector(Vector3(pitch_rad + 0.02 * (i % 3), 0, 0));
    camera_from_world.push_back(world_from_camera.transpose());
  }
  return camera_from_world;
}

TEST(Upright, DownIsAcrossTheCamerasXAxesHoweverTheyNod) {
  for (double tilt : {0.0, 0.7})
    for (double pitch : {0.0, -0.6, 0.6}) {
      const Vector3 down = rotationFromVector(Vector3(tilt, 0, 0)) * Vector3(0, 0, -1);
      EXPECT_GT(downByCameras(looking(tilt, pitch)).dot(down), std::cos(0.03)) << tilt << " " << pitch;
    }
}

TEST(Upright, OfOneCameraItIsTheImagesDown) {
  const Matrix3 camera_from_world = rotationFromVector(Vector3(0.3, -0.8, 1.2));
  const Vector3 y = camera_from_world.row(1);
  EXPECT_GT(downByCameras({camera_from_world}).dot(y), 1 - 1e-9);
}

}  // namespace
}  // namespace sphc::host
