#include "runtime/geometry/camera.h"

#include "runtime/base/message.h"

namespace sphc {
namespace {

constexpr double kWidestRay2 = 57.0 * 57.0;  // tan(89 deg)^2
constexpr int kDomainSteps = 512;
// Newton's method for a ray: it converges quadratically, so more steps are never taken; where it ends, and how near
// the distorted ray must then be, squared.
constexpr int kMostSteps = 20;
constexpr double kConverged2 = 1e-26, kAgrees2 = 1e-16;
constexpr double kLeastDeterminant = 1e-12;  // below it the distortion folds over there
constexpr double kInsideDomain = 0.99;       // where to begin, of the widest radius
// The same for an angle from the axis, between bounds that are halved where Newton goes to and fro between them.
constexpr int kNewtonSteps = 20, kHalvings = 52;
constexpr double kOnAxis = 1e-12, kConvergedRad = 1e-15;

uint32_t paramCount(sphc_camera_model model) {
  switch (model) {
    case SPHC_CAMERA_PINHOLE:
      return 4;
    case SPHC_CAMERA_BROWN5:
      return 9;
    case SPHC_CAMERA_BROWN8:
      return 12;
    case SPHC_CAMERA_KANNALA_BRANDT4:
      return 8;
    default:
      return 0;
  }
}

// Ratio of distorted to true radius of the Brown-Conrady models; k7.. are absent.  params from k1 on.
double brownDenominator(const double *k, double r2) { return 1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])); }
double brownRadial(const double *k, double r2) {
  const double up = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  return up / brownDenominator(k, r2);
}
double brownRadialDerivative(const double *k, double r2) {  // by r2
  const double up = 1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double down = brownDenominator(k, r2);
  const double up_d = k[0] + r2 * (2 * k[1] + 3 * r2 * k[4]);
  const double down_d = k[5] + r2 * (2 * k[6] + 3 * r2 * k[7]);
  return (up_d * down - up * down_d) / (down * down);
}

// Distorted angle of the Kannala-Brandt model (2006, with OpenCV's normalisation), and its derivative.
double kannalaBrandt(const double *k, double theta) {
  const double t2 = theta * theta;
  return theta * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
}
double kannalaBrandtDerivative(const double *k, double theta) {
  const double t2 = theta * theta;
  return 1 + t2 * (3 * k[0] + t2 * (5 * k[1] + t2 * (7 * k[2] + t2 * 9 * k[3])));
}

bool checkSide(uint32_t side, const char *name, const char *field, sphc_message *message) {
  if (side >= SPHC_CAMERA_MIN_PX && side <= SPHC_CAMERA_MAX_PX) return true;
  MessageWriter(message) << name << field << " is " << side << "; it must be " << SPHC_CAMERA_MIN_PX << " to "
                         << SPHC_CAMERA_MAX_PX << " pixels";
  return false;
}

// A model that takes fewer parameters than were given would project otherwise than the calibration says.
bool checkUnused(const sphc_camera &camera, const char *name, uint32_t count, sphc_message *message) {
  for (uint32_t i = count; i < 12; ++i) {
    if (camera.params[i] == 0) continue;
    MessageWriter(message) << name << ".params[" << i << "] is " << camera.params[i] << ", and model "
                           << camera.model << " takes " << count
                           << " parameters; set the others to 0, or give the model that has them";
    return false;
  }
  return true;
}

}  // namespace

bool checkCamera(const sphc_camera &camera, const char *name, sphc_message *message) {
  const uint32_t count = paramCount(camera.model);
  if (!count) {
    MessageWriter(message) << name << ".model is " << camera.model
                           << ", which is not known; use an SPHC_CAMERA_ value";
    return false;
  }
  if (camera.param_count != count) {
    MessageWriter(message) << name << ".param_count is " << camera.param_count << "; model " << camera.model
                           << " takes " << count;
    return false;
  }
  if (!checkSide(camera.width, name, ".width", message) || !checkSide(camera.height, name, ".height", message))
    return false;
  for (uint32_t i = 0; i < 12; ++i) {
    const double param = camera.params[i];
    const bool is_focal = i < 2;
    if (absOf(param) <= SPHC_CAMERA_MAX_PARAM && (param > 0 || !is_focal)) continue;
    MessageWriter(message) << name << ".params[" << i << "] is " << param << "; "
                           << (is_focal ? "a focal length must be positive and at most "
                                        : "a parameter must be finite and not beyond ")
                           << SPHC_CAMERA_MAX_PARAM << ": check the calibration";
    return false;
  }
  return checkUnused(camera, name, count, message);
}

Camera::Camera(const sphc_camera &parameters) : parameters_(parameters) {
  for (uint32_t i = parameters_.param_count; i < 12; ++i) parameters_.params[i] = 0;
  max_radius2_ = findMaxRadius2();
}

// Radial distortion folds back on itself beyond some radius, or has a pole; rays past either have no pixel of their
// own.
double Camera::findMaxRadius2() const {
  const double *k = parameters_.params + 4;
  if (parameters_.model == SPHC_CAMERA_PINHOLE) return kWidestRay2;
  const bool fisheye = parameters_.model == SPHC_CAMERA_KANNALA_BRANDT4;
  const double last = fisheye ? 89 * kPi / 180 : 8;  // radians, or tan of 83 degrees
  double valid = 0;
  for (int step = 1; step <= kDomainSteps; ++step) {
    const double at = last * step / kDomainSteps;
    const double slope = fisheye ? kannalaBrandtDerivative(k, at)
                                 : brownRadial(k, at * at) + 2 * at * at * brownRadialDerivative(k, at * at);
    if (!(slope > 0) || (!fisheye && !(brownDenominator(k, at * at) > 0))) break;
    valid = at;
  }
  if (!fisheye) return valid * valid;
  double s, c;
  sinCos(valid, &s, &c);
  return (s / c) * (s / c);
}

Vector2 Camera::distort(const Vector2 &ray, Eigen::Matrix2d *derivative) const {
  const double x = ray.x(), y = ray.y(), r2 = x * x + y * y;
  const double *k = parameters_.params + 4;
  const double p1 = k[2], p2 = k[3];
  const double radial = brownRadial(k, r2);
  if (derivative) {
    const double d = 2 * brownRadialDerivative(k, r2);
    *derivative << radial + d * x * x + 2 * p1 * y + 6 * p2 * x, d * x * y + 2 * p1 * x + 2 * p2 * y,
        d * x * y + 2 * p1 * x + 2 * p2 * y, radial + d * y * y + 6 * p1 * y + 2 * p2 * x;
  }
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

bool Camera::project(const Vector3 &point_m, Vector2 *pixel_px) const {
  if (!(point_m.z() > 0)) return false;
  Vector2 ray(point_m.x() / point_m.z(), point_m.y() / point_m.z());
  const double r2 = ray.squaredNorm();
  if (!(r2 <= max_radius2_)) return false;
  if (parameters_.model == SPHC_CAMERA_KANNALA_BRANDT4) {
    const double r = sqrtOf(r2);
    if (r > 1e-12) ray *= kannalaBrandt(parameters_.params + 4, atan2Of(r, 1)) / r;
  } else if (parameters_.model != SPHC_CAMERA_PINHOLE) {
    ray = distort(ray, nullptr);
  }
  *pixel_px = {parameters_.params[0] * ray.x() + parameters_.params[2],
               parameters_.params[1] * ray.y() + parameters_.params[3]};
  return isFinite(pixel_px->x()) && isFinite(pixel_px->y());
}

bool Camera::undistortBrown(const Vector2 &distorted, Vector2 *ray) const {
  Vector2 guess = distorted;
  const double start2 = guess.squaredNorm();
  if (start2 > max_radius2_) guess *= sqrtOf(max_radius2_ / start2) * kInsideDomain;
  for (int i = 0; i < kMostSteps; ++i) {
    Eigen::Matrix2d j;
    const Vector2 error = distort(guess, &j) - distorted;
    const double det = j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0);
    if (!(absOf(det) > kLeastDeterminant)) return false;
    guess -= Vector2(j(1, 1) * error.x() - j(0, 1) * error.y(), j(0, 0) * error.y() - j(1, 0) * error.x()) / det;
    if (error.squaredNorm() < kConverged2) break;
  }
  if (!(guess.squaredNorm() <= max_radius2_) || !((distort(guess, nullptr) - distorted).squaredNorm() < kAgrees2))
    return false;
  *ray = guess;
  return true;
}

bool Camera::undistortKannalaBrandt(const Vector2 &distorted, Vector2 *ray) const {
  const double target = sqrtOf(distorted.squaredNorm());
  if (target < kOnAxis) {  // where the model is the identity
    *ray = distorted;
    return true;
  }
  double low = 0, high = atan2Of(sqrtOf(max_radius2_), 1), theta = target < high ? target : high;
  if (kannalaBrandt(parameters_.params + 4, high) < target) return false;
  // Newton, kept inside the shrinking bracket.
  for (int i = 0; i < kNewtonSteps + kHalvings; ++i) {
    const double error = kannalaBrandt(parameters_.params + 4, theta) - target;
    (error > 0 ? high : low) = theta;
    double next = theta - error / kannalaBrandtDerivative(parameters_.params + 4, theta);
    if (i >= kNewtonSteps || !(next >= low && next <= high)) next = 0.5 * (low + high);
    if (absOf(next - theta) < kConvergedRad) break;
    theta = next;
  }
  double s, c;
  sinCos(theta, &s, &c);
  *ray = distorted * (s / c / target);
  return true;
}

bool Camera::unproject(const Vector2 &pixel_px, Vector2 *ray) const {
  if (!isFinite(pixel_px.x()) || !isFinite(pixel_px.y())) return false;
  const Vector2 distorted((pixel_px.x() - parameters_.params[2]) / parameters_.params[0],
                          (pixel_px.y() - parameters_.params[3]) / parameters_.params[1]);
  if (parameters_.model == SPHC_CAMERA_KANNALA_BRANDT4) return undistortKannalaBrandt(distorted, ray);
  if (parameters_.model != SPHC_CAMERA_PINHOLE) return undistortBrown(distorted, ray);
  if (!(distorted.squaredNorm() <= kWidestRay2)) return false;
  *ray = distorted;
  return true;
}

bool Camera::operator==(const Camera &other) const {
  const sphc_camera &a = parameters_, &b = other.parameters_;
  bool same = a.model == b.model && a.width == b.width && a.height == b.height && a.param_count == b.param_count;
  for (uint32_t i = 0; same && i < a.param_count; ++i) same = a.params[i] == b.params[i];
  return same;
}

}  // namespace sphc
