// Camera models of the C interface: pinhole, Brown-Conrady with 5 and 8 coefficients, Kannala-Brandt with 4.
#pragma once
#include "runtime/geometry/rotation.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

// False, with a message, when the camera cannot be used; see sphc_camera_check.  The message calls the camera
// `name`.
bool checkCamera(const sphc_camera &camera, const char *name, sphc_message *message);

class Camera {
 public:
  Camera() = default;
  // `parameters` has passed checkCamera.
  explicit Camera(const sphc_camera &parameters);

  // Pixel of a point in camera coordinates; false behind the camera or beyond the invertible field of view.
  bool project(const Vector3 &point_m, Vector2 *pixel_px) const;
  // Ray (x, y, 1) through a pixel; false where none projects there, or only at 89 degrees and more off the axis.
  bool unproject(const Vector2 &pixel_px, Vector2 *ray) const;

  // The same pixels for the same points.
  bool operator==(const Camera &other) const;

  double fx() const { return parameters_.params[0]; }
  double fy() const { return parameters_.params[1]; }
  double focal() const { return 0.5 * (fx() + fy()); }
  int32_t width() const { return static_cast<int32_t>(parameters_.width); }
  int32_t height() const { return static_cast<int32_t>(parameters_.height); }
  bool isPinhole() const { return parameters_.model == SPHC_CAMERA_PINHOLE; }
  // A pixel is so much of a point's surroundings over the focal length.  Pixels of a fisheye are about even in the
  // angle from the axis, so it is the distance; those of others in the tangent of it, so it is the depth.
  double awayM(const Vector3 &point_m) const {
    return parameters_.model == SPHC_CAMERA_KANNALA_BRANDT4 ? point_m.norm() : point_m.z();
  }
  // As given, unused parameters 0.
  const sphc_camera &parameters() const { return parameters_; }
  // Largest x^2 + y^2 of a ray (x, y, 1) that has a pixel.
  double maxRadius2() const { return max_radius2_; }

 private:
  // Distorted normalised coordinates of (x, y, 1), and their derivative when asked for.
  Vector2 distort(const Vector2 &ray, Eigen::Matrix2d *derivative) const;
  bool undistortBrown(const Vector2 &distorted, Vector2 *ray) const;
  bool undistortKannalaBrandt(const Vector2 &distorted, Vector2 *ray) const;
  double findMaxRadius2() const;

  sphc_camera parameters_ = {};
  double max_radius2_ = 0;  // largest x^2 + y^2 of a ray up to which the distortion is one to one
};

}  // namespace sphc
