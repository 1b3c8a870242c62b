#include "runtime/geometry/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

struct Named {
  const char *name;
  sphc_camera camera;
};

// Mild and strong, of every model.
const std::vector<Named> &cameras() {
  static const std::vector<Named> all = {
      {"pinhole", {SPHC_CAMERA_PINHOLE, 640, 480, 4, {525, 520, 320.5, 238}}},
      {"brown5", {SPHC_CAMERA_BROWN5, 640, 480, 9, {517, 516, 318, 255, 0.26, -0.95, -0.005, 0.003, 1.16}}},
      {"brown5 barrel",
       {SPHC_CAMERA_BROWN5, 640, 480, 9, {400, 402, 321, 239, -0.33, 0.13, 0.001, -0.0008, -0.025}}},
      {"brown5 tangential", {SPHC_CAMERA_BROWN5, 640, 480, 9, {600, 600, 320, 240, 0, 0, 0.02, -0.015, 0}}},
      {"brown8",
       {SPHC_CAMERA_BROWN8,
        1280,
        720,
        12,
        {614, 613, 639, 366, 0.5, -2.6, 0.0008, -0.0003, 1.49, 0.38, -2.44, 1.42}}},
      {"kb4", {SPHC_CAMERA_KANNALA_BRANDT4, 320, 288, 8, {180, 181, 161, 144, -0.01, 0.02, -0.01, 0.002}}},
      {"kb4 strong", {SPHC_CAMERA_KANNALA_BRANDT4, 640, 480, 8, {190, 190, 320, 240, 0.1, -0.05, 0.01, -0.001}}},
  };
  return all;
}

TEST(Camera, AllTestCamerasAreUsable) {
  for (const Named &c : cameras()) {
    sphc_message message = {};
    EXPECT_TRUE(checkCamera(c.camera, "camera", &message)) << c.name << message.text;
  }
}

TEST(Camera, PixelToRayToPixel) {
  for (const Named &c : cameras()) {
    const Camera camera(c.camera);
    int inside = 0, total = 0;
    for (uint32_t y = 0; y <= c.camera.height; y += 8) {
      for (uint32_t x = 0; x <= c.camera.width; x += 8) {
        ++total;
        Vector2 ray, pixel;
        if (!camera.unproject({x, y}, &ray)) continue;
        ++inside;
        ASSERT_TRUE(camera.project({ray.x(), ray.y(), 1}, &pixel)) << c.name;
        EXPECT_LT((pixel - Vector2(x, y)).norm(), 1e-6) << c.name << " at " << x << ", " << y;
      }
    }
    EXPECT_GT(inside, 0.85 * total) << c.name;  // a fisheye's corners look beyond 89 degrees
  }
}

// Newton's steps of some radii go to and fro between two angles, here at 81 degrees.
TEST(Camera, EveryRadiusOfAFisheyeHasItsRay) {
  const Camera camera(
      sphc_camera{SPHC_CAMERA_KANNALA_BRANDT4, 640, 480, 8, {180, 180, 320, 240, 0.2, -0.1, 0.05, -0.02}});
  for (int i = 0; i <= 20000; ++i) {
    const Vector2 at(320 + 255.45 + 4e-6 * i, 240);
    Vector2 ray, pixel;
    ASSERT_TRUE(camera.unproject(at, &ray));
    ASSERT_TRUE(camera.project({ray.x(), ray.y(), 1}, &pixel));
    ASSERT_LT((pixel - at).norm(), 1e-6) << at.x();
  }
}

// Beside a point far from the axis, across the plane through both.
TEST(Camera, APixelIsSoMuchOfAPointsSurroundings) {
  const double focal = 300;
  const Vector3 point(2, 0, 1), beside(2, 1e-4, 1);
  const Camera pinhole(sphc_camera{SPHC_CAMERA_PINHOLE, 640, 480, 4, {focal, focal, 320, 240}});
  const Camera fisheye(sphc_camera{SPHC_CAMERA_KANNALA_BRANDT4, 640, 480, 8, {focal, focal, 320, 240, 0, 0, 0, 0}});
  const auto metresOfAPixel = [&](const Camera &camera) {
    Vector2 at, by;
    EXPECT_TRUE(camera.project(point, &at) && camera.project(beside, &by));
    return (beside - point).norm() / (by - at).norm();
  };
  EXPECT_NEAR(pinhole.awayM(point) / focal, metresOfAPixel(pinhole), 1e-9);
  // Along the way from the axis it is the distance, across it less.
  EXPECT_GT(fisheye.awayM(point) / focal, metresOfAPixel(fisheye));
  EXPECT_LT(fisheye.awayM(point) / focal, 1.3 * metresOfAPixel(fisheye));
  EXPECT_GT(metresOfAPixel(fisheye), 1.5 * pinhole.awayM(point) / focal);
}

TEST(Camera, PointToPixelToRay) {
  Random random(7);
  for (const Named &c : cameras()) {
    const Camera camera(c.camera);
    int projected = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vector3 direction = test::randomDirection(&random);
      const Vector3 point = test::uniformIn(&random, 0.01, 50) * direction;
      Vector2 pixel, ray;
      if (!camera.project(point, &pixel)) continue;
      if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() > c.camera.width || pixel.y() > c.camera.height) continue;
      ++projected;
      ASSERT_TRUE(camera.unproject(pixel, &ray)) << c.name << " " << pixel.transpose();
      const Vector3 back = Vector3(ray.x(), ray.y(), 1).normalized();
      EXPECT_LT((back - direction).norm(), 1e-8) << c.name << " " << pixel.transpose();
    }
    EXPECT_GT(projected, 100) << c.name;
  }
}

TEST(Camera, TheAxisGoesToThePrincipalPoint) {
  for (const Named &c : cameras()) {
    Vector2 pixel;
    ASSERT_TRUE(Camera(c.camera).project({0, 0, 2}, &pixel));
    EXPECT_EQ(pixel, Vector2(c.camera.params[2], c.camera.params[3]));
  }
}

TEST(Camera, BehindIsRefused) {
  for (const Named &c : cameras()) {
    const Camera camera(c.camera);
    Vector2 pixel(-1, -1);
    EXPECT_FALSE(camera.project({0, 0, -1}, &pixel));
    EXPECT_FALSE(camera.project({1, 1, 0}, &pixel));
    EXPECT_FALSE(camera.project({0, 0, std::numeric_limits<double>::quiet_NaN()}, &pixel));
    EXPECT_FALSE(camera.project({std::numeric_limits<double>::quiet_NaN(), 0, 1}, &pixel));
    EXPECT_EQ(pixel, Vector2(-1, -1));  // untouched
  }
}

// Beyond the fold of a barrel distortion, rays come back into the image: they must not be taken for others.
TEST(Camera, BeyondTheFoldIsRefused) {
  const sphc_camera strong = {SPHC_CAMERA_BROWN5, 640, 480, 9, {400, 400, 320, 240, -0.3, 0, 0, 0, 0}};
  const Camera camera(strong);
  Vector2 pixel;
  EXPECT_TRUE(camera.project({0.9, 0, 1}, &pixel));
  EXPECT_FALSE(camera.project({1.5, 0, 1}, &pixel));  // r (1 - 0.3 r^2) has its top at r = 1.054
  Vector2 last(0, 0);
  for (double r = 0.01; r < 1.04; r += 0.01) {
    ASSERT_TRUE(camera.project({r, 0, 1}, &pixel));
    EXPECT_GT(pixel.x(), last.x());
    last = pixel;
  }
  Vector2 ray;
  EXPECT_FALSE(camera.unproject({320 + 400 * 0.72, 240}, &ray));  // the top is at 0.7027
}

TEST(Camera, APoleEndsTheImage) {
  const Camera camera({SPHC_CAMERA_BROWN8, 640, 480, 12, {400, 400, 320, 240, 0, 0, 0, 0, 0, -1, 0, 0}});
  Vector2 pixel(5, 6);
  EXPECT_TRUE(camera.project({0.9, 0, 1}, &pixel));  // x / (1 - r^2)
  pixel = {5, 6};
  EXPECT_FALSE(camera.project({1, 0, 1}, &pixel));
  EXPECT_FALSE(camera.project({1.01, 0, 1}, &pixel));
}

TEST(Camera, UnprojectRefusesNonsense) {
  for (const Named &c : cameras()) {
    const Camera camera(c.camera);
    Vector2 ray(5, 6);
    EXPECT_FALSE(camera.unproject({std::numeric_limits<double>::quiet_NaN(), 1}, &ray)) << c.name;
    EXPECT_FALSE(camera.unproject({1, std::numeric_limits<double>::infinity()}, &ray)) << c.name;
    EXPECT_FALSE(camera.unproject({1e9, 1e9}, &ray)) << c.name;
    EXPECT_EQ(ray, Vector2(5, 6)) << c.name;
  }
}

TEST(Camera, WildParametersNeverGiveNonsense) {  // whatever comes back as true is finite and round-trips
  Random random(9);
  for (int i = 0; i < 3000; ++i) {
    sphc_camera camera = cameras()[random.below(static_cast<uint32_t>(cameras().size()))].camera;
    for (uint32_t k = 4; k < camera.param_count; ++k)
      camera.params[k] = test::normal(&random) * std::pow(10, test::uniformIn(&random, -3, 3));
    const Camera model(camera);
    for (int j = 0; j < 10; ++j) {
      const Vector2 pixel(test::uniformIn(&random, 0, 640), test::uniformIn(&random, 0, 480));
      Vector2 ray, back;
      if (!model.unproject(pixel, &ray)) continue;
      ASSERT_TRUE(isFinite(ray.x()) && isFinite(ray.y()));
      if (model.project({ray.x(), ray.y(), 1}, &back)) {
        EXPECT_LT((back - pixel).norm(), 1e-3);
      }
    }
  }
}

TEST(Camera, CheckNamesTheFault) {
  struct Case {
    void (*spoil)(sphc_camera *);
    const char *words;
  };
  const Case cases[] = {
      {[](sphc_camera *c) { c->model = 0; }, "left.model is 0"},
      {[](sphc_camera *c) { c->model = 99; }, "left.model is 99"},
      {[](sphc_camera *c) { c->param_count = 4; }, "left.param_count is 4; model 2 takes 9"},
      {[](sphc_camera *c) { c->width = 15; }, "left.width is 15; it must be 16 to 8192 pixels"},
      {[](sphc_camera *c) { c->height = 8193; }, "left.height is 8193; it must be 16 to 8192 pixels"},
      {[](sphc_camera *c) { c->params[8] = std::numeric_limits<double>::quiet_NaN(); }, "left.params[8] is nan"},
      {[](sphc_camera *c) { c->params[0] = 0; }, "left.params[0] is 0; a focal length must be positive"},
      {[](sphc_camera *c) { c->params[1] = -5; }, "left.params[1] is -5; a focal length must be positive"},
  };
  for (const Case &c : cases) {
    sphc_camera camera = cameras()[1].camera;
    c.spoil(&camera);
    sphc_message message = {};
    EXPECT_FALSE(checkCamera(camera, "left", &message));
    EXPECT_NE(std::string(message.text).find(c.words), std::string::npos) << message.text;
  }
}

}  // namespace
}  // namespace sphc
