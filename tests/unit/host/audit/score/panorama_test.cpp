#include "host/audit/score/panorama.h"

#include <gtest/gtest.h>

#include "host/audit/attack/virtual_camera.h"

namespace sphc::host {
namespace {

// A wall across the view `turn` looks in, at `depth_m`: dark left of the axis, bright right of it.
void addWall(const Matrix3 &camera_from_map, double depth_m, float left, float right, Panorama *panorama) {
  for (double y = -0.8; y < 0.8; y += 0.004) {
    for (double x = -0.8; x < 0.8; x += 0.004) {
      const Vector3 seen = depth_m * Vector3(x, y, 1);
      panorama->add(camera_from_map.transpose() * seen, 0.004 * depth_m, x < 0 ? left : right);
    }
  }
}

double greyAt(const TruthView &view, int y, int x) { return static_cast<double>(view.grey.at<float>(y, x)); }

Matrix3 turned(const Vector3 &axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

TEST(Panorama, ShowsAWallFromAnyRotation) {
  for (const Matrix3 &camera_from_map :
       {Matrix3(Matrix3::Identity()), turned({1, 2, 3}, 2.0), turned({-1, 1, 0}, 0.8)}) {
    Panorama panorama;
    addWall(camera_from_map, 2, 50, 200, &panorama);
    const TruthView view = panorama.view(camera_from_map);
    EXPECT_GT(view.seenShare(), 0.999);
    EXPECT_NEAR(greyAt(view, 64, 20), 50, 0.01);
    EXPECT_NEAR(greyAt(view, 100, 110), 200, 0.01);
    for (int y = 10; y < 118; ++y) {  // the edge is in the middle
      EXPECT_LT(greyAt(view, y, 60), 125);
      EXPECT_GT(greyAt(view, y, 67), 125);
    }
  }
}

TEST(Panorama, TheNearestHidesInWhateverOrderItComes) {
  Panorama panorama;
  addWall(Matrix3::Identity(), 3, 10, 10, &panorama);
  addWall(Matrix3::Identity(), 2, 80, 80, &panorama);
  addWall(Matrix3::Identity(), 4, 30, 30, &panorama);
  EXPECT_NEAR(greyAt(panorama.view(Matrix3::Identity()), 64, 64), 80, 0.01);
}

TEST(Panorama, OneSurfaceSeenTwiceIsTheMean) {
  Panorama panorama;
  addWall(Matrix3::Identity(), 2, 80, 80, &panorama);
  addWall(Matrix3::Identity(), 2.02, 100, 100, &panorama);
  EXPECT_NEAR(greyAt(panorama.view(Matrix3::Identity()), 64, 64), 90, 1);
}

TEST(Panorama, WhatWasNotMeasuredIsUnknown) {
  Panorama panorama;
  addWall(Matrix3::Identity(), 2, 80, 80, &panorama);
  EXPECT_EQ(panorama.view(turned({0, 1, 0}, 3.1)).seenShare(), 0);
}

TEST(Panorama, FurnitureAroundTheCentreHidesNothing) {
  Panorama panorama;
  addWall(Matrix3::Identity(), 0.3, 5, 5, &panorama);
  EXPECT_EQ(panorama.view(Matrix3::Identity()).seenShare(), 0);
}

}  // namespace
}  // namespace sphc::host
