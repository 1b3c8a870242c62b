#include "lab/rig/headset.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sphc::host {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr uint32_t kWidth = 640, kHeight = 480, kDepthWidth = 320, kDepthHeight = 288;
constexpr double kMostOffPlane = 0.01;                            // of inverse depth
constexpr double kLeastWall = 0.9;                                // of the view
constexpr double kLeftIsOffM = 0.01;                              // of the ToF camera to the left
constexpr double kSideways = 50 * kDegree, kDown = 40 * kDegree;  // of the further cameras

sphc_camera grayCamera() {
  return {SPHC_CAMERA_BROWN5, kWidth, kHeight, 9, {401.2, 400.7, 321.4, 239.1, -0.03, 0.01, 0.0003, -0.0002, 0}};
}

// The same view of few pixels, for distances.
sphc_camera coarseCamera() { return {SPHC_CAMERA_BROWN5, 64, 48, 9, {40, 40, 32, 24}}; }

sphc_camera wideCamera() {
  return {SPHC_CAMERA_KANNALA_BRANDT4, kDepthWidth, kDepthHeight, 8, {152.2, 152.4, 159.1, 144.6, 0.01, -0.004}};
}

// 56 x 51 degrees.
sphc_camera narrowCamera() { return {SPHC_CAMERA_BROWN5, kDepthWidth, kDepthHeight, 9, {300, 300, 160, 144}}; }

Matrix3 aboutX(double angle_rad) { return rotationFromVector(angle_rad * Vector3::UnitX()); }
Matrix3 aboutY(double angle_rad) { return rotationFromVector(angle_rad * Vector3::UnitY()); }

Rigid colorFromCamera(uint32_t camera) {
  switch (camera) {
    case 1:
      return {aboutY(-kSideways), Vector3(-0.061, 0.002, -0.03)};
    case 2:
      return {aboutY(kSideways), Vector3(0.059, -0.001, -0.031)};
    case 3:
      return {aboutX(-kDown), Vector3(0.012, 0.034, -0.004)};
    default:
      return {};
  }
}

Rigid colorFromDepth() { return {aboutX(0.004), Vector3(0.021, 0.018, 0.003)}; }
Rigid colorFromLeftDepth() { return {aboutY(-kSideways), Vector3(-0.04, 0.015, -0.01)}; }

void render(const sphc_simulated *room, int64_t time_ns, const sphc_camera &camera, const Rigid &world_from_camera,
            uint8_t *rgb, uint16_t *depth, float *depth_m) {
  const sphc_rigid pose = rigidToC(world_from_camera);
  if (sphc_simulated_render_view(room, time_ns, &camera, &pose, rgb, depth, depth_m) != SPHC_OK)
    throw std::runtime_error("the simulated room cannot be rendered");
}

std::vector<uint16_t> depthFrom(const sphc_simulated *room, int64_t time_ns, const sphc_camera &camera,
                                const Rigid &world_from_depth) {
  std::vector<uint16_t> depth(size_t{kDepthWidth} * kDepthHeight);
  render(room, time_ns, camera, world_from_depth, nullptr, depth.data(), nullptr);
  return depth;
}

sphc_image depthImage(const std::vector<uint16_t> &depth) {
  return {depth.data(), kDepthWidth, kDepthHeight, 2 * kDepthWidth, SPHC_FORMAT_DEPTH16};
}

std::vector<uint8_t> grayFrom(const std::vector<uint8_t> &rgb) {
  std::vector<uint8_t> gray(rgb.size() / 3);
  for (size_t i = 0; i < gray.size(); ++i)
    gray[i] = static_cast<uint8_t>((77 * rgb[3 * i] + 150 * rgb[3 * i + 1] + 29 * rgb[3 * i + 2] + 128) / 256);
  return gray;
}

// Level; the world's z is up.
Rigid levelPose(const Vector3 &centre_m, double heading_rad) {
  const Vector3 ahead(std::cos(heading_rad), std::sin(heading_rad), 0), down(0, 0, -1);
  Matrix3 rotation;
  rotation << down.cross(ahead), down, ahead;
  return {rotation, centre_m};
}

// Share of the image that lies on the plane seen in its middle: inverse depths of a plane are linear in the image.
double shareOfMiddlePlane(const std::vector<float> &depth_m, const sphc_camera &camera) {
  const auto rayOf = [&](uint32_t column, uint32_t row) {
    return Vector3((column + 0.5 - camera.params[2]) / camera.params[0],
                   (row + 0.5 - camera.params[3]) / camera.params[1], 1);
  };
  const auto inverseOf = [&](uint32_t column, uint32_t row) {
    return 1 / static_cast<double>(depth_m[row * camera.width + column]);
  };
  Matrix3 squares = Matrix3::Zero();
  Vector3 sum = Vector3::Zero();
  for (uint32_t row = 3 * camera.height / 8; row < 5 * camera.height / 8; ++row)
    for (uint32_t column = 3 * camera.width / 8; column < 5 * camera.width / 8; ++column) {
      squares += rayOf(column, row) * rayOf(column, row).transpose();
      sum += inverseOf(column, row) * rayOf(column, row);
    }
  const Vector3 plane = squares.inverse() * sum;
  uint32_t on = 0;
  for (uint32_t row = 0; row < camera.height; ++row)
    for (uint32_t column = 0; column < camera.width; ++column) {
      const double expected = plane.dot(rayOf(column, row));
      on += std::abs(inverseOf(column, row) - expected) < kMostOffPlane * expected;
    }
  return static_cast<double>(on) / (camera.width * camera.height);
}

}  // namespace

void RigHeadset::setCameras(const RigSetup &setup, RigArrays *arrays, sphc_localizer_config *config) {
  config->rig.color_camera = grayCamera();
  config->rig.depth_camera = setup.tof == RigTof::kWide ? wideCamera() : narrowCamera();
  config->rig.color_from_depth = rigidToC(colorFromDepth());
  config->rig.depth_unit_m = SPHC_SIMULATED_DEPTH_UNIT_M;
  arrays->cameras.clear();
  for (uint32_t i = 1; i < setup.cameras; ++i)
    arrays->cameras.push_back({sizeof(sphc_localizer_camera), 0, grayCamera(), rigidToC(colorFromCamera(i)), 0});
  config->cameras = arrays->cameras.empty() ? nullptr : arrays->cameras.data();
  config->camera_count = static_cast<uint32_t>(arrays->cameras.size());
  if (setup.tof != RigTof::kAheadAndLeft) return;
  sphc_localizer_depth_camera *left = &arrays->depth_camera;
  sphc_localizer_depth_camera_init(left, sizeof *left);
  left->camera = narrowCamera();
  left->color_from_depth = rigidToC(colorFromLeftDepth());
  left->unit_m = SPHC_SIMULATED_DEPTH_UNIT_M;
  left->offset_sigma_m = kLeftIsOffM;
  config->depth_cameras = left;
  config->depth_camera_count = 1;
}

RigShot RigHeadset::look(const Rigid &world_from_camera, int64_t time_ns) const {
  RigShot shot;
  std::vector<uint8_t> rgb(size_t{3} * kWidth * kHeight);
  for (uint32_t i = 0; i < kCameras; ++i) {
    render(room_, time_ns, grayCamera(), world_from_camera * colorFromCamera(i), rgb.data(), nullptr, nullptr);
    shot.gray.push_back(grayFrom(rgb));
  }
  shot.wide = depthFrom(room_, time_ns, wideCamera(), world_from_camera * colorFromDepth());
  shot.ahead = depthFrom(room_, time_ns, narrowCamera(), world_from_camera * colorFromDepth());
  shot.left = depthFrom(room_, time_ns, narrowCamera(), world_from_camera * colorFromLeftDepth());
  for (uint16_t &units : shot.left)
    if (units) units = static_cast<uint16_t>(units + std::lround(kLeftIsOffM / SPHC_SIMULATED_DEPTH_UNIT_M));
  return shot;
}

sphc_localizer_frame RigHeadset::frameOf(const RigShot &shot, int64_t time_ns, const RigSetup &setup,
                                         RigArrays *arrays) {
  const auto imageOf = [&](uint32_t i) {
    return sphc_image{shot.gray[i].data(), kWidth, kHeight, kWidth, SPHC_FORMAT_GRAY8};
  };
  std::vector<sphc_localizer_view> &views = arrays->views;
  views.clear();
  for (uint32_t i = 1; i < setup.cameras; ++i)
    views.push_back({sizeof(sphc_localizer_view), 0, time_ns, imageOf(i), nullptr, nullptr});
  sphc_localizer_frame frame = {};
  frame.struct_size = sizeof frame;
  frame.color_time_ns = frame.depth_time_ns = time_ns;
  frame.color = imageOf(0);
  frame.depth = depthImage(setup.tof == RigTof::kWide ? shot.wide : shot.ahead);
  frame.views = views.empty() ? nullptr : views.data();
  frame.view_count = static_cast<uint32_t>(views.size());
  if (setup.tof != RigTof::kAheadAndLeft) return frame;
  sphc_localizer_depth_view_init(&arrays->depth_view, sizeof arrays->depth_view);
  arrays->depth_view.time_ns = time_ns;
  arrays->depth_view.depth = depthImage(shot.left);
  frame.depth_views = &arrays->depth_view;
  frame.depth_view_count = 1;
  return frame;
}

bool RigHeadset::faceWall(const Vector3 &centre_m, double heading_rad, int64_t time_ns, Rigid *facing) const {
  const sphc_camera coarse = coarseCamera();
  std::vector<float> depth_m(size_t{coarse.width} * coarse.height);
  *facing = levelPose(centre_m, heading_rad);
  render(room_, time_ns, coarse, *facing, nullptr, nullptr, depth_m.data());
  return shareOfMiddlePlane(depth_m, coarse) > kLeastWall;
}

}  // namespace sphc::host
