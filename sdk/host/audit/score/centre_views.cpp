#include "host/audit/score/centre_views.h"

#include <cmath>
#include <stdexcept>

#include "host/frames/recording.h"
#include "runtime/base/elementary.h"
#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {
namespace {

constexpr double kApartDeg = 20, kSeenShare = 0.5;  // of views
constexpr double kDepthMinM = 0.2, kDepthMaxM = 6.0;
// Beside where the recording looked, the attacker looks a little up, down and aside.
constexpr double kAsideDeg[][2] = {{0, 0},   {20, 0},    {-20, 0},  {0, 20},  {0, -20},
                                   {20, 20}, {-20, -20}, {20, -20}, {-20, 20}};

// Rays (x, y, 1) of all depth pixels; (0, 0, 0) where the camera has none.
std::vector<Vector3> raysOf(const Camera &camera) {
  std::vector<Vector3> rays;
  for (int32_t y = 0; y < camera.height(); ++y) {
    for (int32_t x = 0; x < camera.width(); ++x) {
      Vector2 ray;
      const bool is_ray = camera.unproject(Vector2(x + 0.5, y + 0.5), &ray);
      rays.push_back(is_ray ? Vector3(ray.x(), ray.y(), 1) : Vector3::Zero());
    }
  }
  return rays;
}

class FramePainter {
 public:
  FramePainter(const sphc_rig &calibration, const Vector3 &centre_m)
      : color_(calibration.color_camera),
        depth_(calibration.depth_camera),
        color_from_depth_(rigidFromC(calibration.color_from_depth)),
        depth_unit_m_(calibration.depth_unit_m),
        rays_(raysOf(depth_)),
        centre_m_(centre_m) {}

  void paint(const sphc_localizer_frame &frame, const Rigid &world_from_color, Panorama *panorama) const {
    const Rigid world_from_depth = world_from_color * color_from_depth_;
    for (int32_t y = 0; y < depth_.height(); ++y) {
      const auto *row = reinterpret_cast<const uint16_t *>(static_cast<const uint8_t *>(frame.depth.data) +
                                                           static_cast<size_t>(y) * frame.depth.stride_bytes);
      for (int32_t x = 0; x < depth_.width(); ++x) {
        const double depth_m = row[x] * depth_unit_m_;
        const Vector3 &ray = rays_[static_cast<size_t>(y) * static_cast<size_t>(depth_.width()) + x];
        Vector2 pixel;
        if (depth_m < kDepthMinM || depth_m > kDepthMaxM || ray.z() == 0) continue;
        const Vector3 point = depth_m * ray;
        if (!color_.project(color_from_depth_ * point, &pixel)) continue;
        const int32_t u = static_cast<int32_t>(std::floor(pixel.x())),
                      v = static_cast<int32_t>(std::floor(pixel.y()));
        if (u < 0 || v < 0 || u >= color_.width() || v >= color_.height()) continue;
        panorama->add(world_from_depth * point - centre_m_, 0.5 * depth_m / depth_.focal(),
                      grey(frame.color, u, v));
      }
    }
  }

 private:
  static float grey(const sphc_image &image, int32_t x, int32_t y) {
    const uint8_t *bgr = static_cast<const uint8_t *>(image.data) + static_cast<size_t>(y) * image.stride_bytes +
                         3 * static_cast<size_t>(x);
    return 0.114f * bgr[0] + 0.587f * bgr[1] + 0.299f * bgr[2];
  }

  Camera color_, depth_;
  Rigid color_from_depth_;
  double depth_unit_m_;
  std::vector<Vector3> rays_;
  Vector3 centre_m_;
};

Matrix3 turned(double yaw_deg, double pitch_deg) {
  const double yaw = yaw_deg * kPi / 180, pitch = pitch_deg * kPi / 180;
  return (Eigen::AngleAxisd(pitch, Vector3::UnitX()) * Eigen::AngleAxisd(yaw, Vector3::UnitY())).toRotationMatrix();
}

}  // namespace

Panorama panoramaFrom(recording::RecordingReader *reader, const Vector3 &centre_m, const FramesRead &progress) {
  const FramePainter painter(reader->calibration(), centre_m);
  Panorama panorama;
  uint32_t painted = 0;
  for (uint32_t i = 0; i < reader->frameCount(); ++i) {
    progress(i, reader->frameCount());
    const std::optional<sphc_rigid> pose = reader->worldFromCamera(i);
    if (!pose) continue;
    const std::optional<sphc_localizer_frame> frame = reader->tryRead(i);
    if (!frame) continue;
    painter.paint(*frame, rigidFromC(*pose), &panorama);
    ++painted;
  }
  if (!painted) throw std::runtime_error("no frame of the recording has images and a pose; the truth needs both");
  return panorama;
}

std::vector<Matrix3> choosePoses(recording::RecordingReader *reader, const Panorama &panorama, double apart_deg,
                                 double seen_share) {
  const double apart = std::cos(apart_deg * kPi / 180);
  std::vector<Matrix3> chosen;
  for (const auto &aside : kAsideDeg) {
    for (uint32_t i = 0; i < reader->frameCount(); ++i) {
      const std::optional<sphc_rigid> pose = reader->worldFromCamera(i);
      if (!pose) continue;
      const Matrix3 camera_from_map = turned(aside[0], aside[1]) * rigidFromC(*pose).rotation.transpose();
      const Vector3 axis = camera_from_map.row(2);
      bool is_near = false;
      for (const Matrix3 &other : chosen) is_near = is_near || axis.dot(Vector3(other.row(2))) > apart;
      if (!is_near && panorama.view(camera_from_map).seenShare() >= seen_share) chosen.push_back(camera_from_map);
    }
  }
  return chosen;
}

std::vector<InversionView> viewsFromCentre(recording::RecordingReader *reader, const Vector3 &centre_m,
                                           const FramesRead &progress) {
  const Panorama panorama = panoramaFrom(reader, centre_m, progress);
  std::vector<InversionView> views;
  for (const Matrix3 &rotation : choosePoses(reader, panorama, kApartDeg, kSeenShare))
    views.push_back({rotation, panorama.view(rotation)});
  return views;
}

}  // namespace sphc::host
