#include "runtime/localizer/front_end.h"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "runtime/localizer/tuning.h"
#include "runtime/stages/features/gray.h"
#include "runtime/stages/features/mirrored_descriptor.h"

namespace sphc {
namespace {

constexpr uint32_t kLiftGrain = 16;    // keypoints between two looks at the clock
constexpr double kUselessSigma = 1e3;  // of a keypoint where the camera model has no bearing
// A point of a further camera that is less in front of the colour camera is taken for a ray: depth is corrected by
// its share there.
constexpr double kLeastZM = 0.05;

// Takes what the camera sees to the frame of the colour camera; false for a point that is hardly in front of it.
bool toColor(const Rigid &color_from_camera, LiftedPoint *lifted) {
  const Vector3 point_m = color_from_camera * lifted->point_m;
  if (lifted->hasDepth() && point_m.z() < kLeastZM) return false;
  lifted->point_m = point_m;
  lifted->centre_m = color_from_camera.translation_m.cast<float>();
  return true;
}

}  // namespace

void FrontEnd::layout(const LocalizerConfig &config, Arena &state, Arena &scratch, FrontEnd *front) {
  static constexpr const char *kNames[3] = {"localizer.keypoints", "localizer.descriptors", "localizer.cameras"};
  const uint32_t n = config.max_keypoints;
  const size_t pixels = size_t(config.color_camera.width()) * size_t(config.color_camera.height());
  FrontEnd discarded;  // receives empty spans while measuring
  FrontEnd &f = front ? *front : discarded;
  f.observations_ = state.take<Observation>("localizer.observations", n);
  if (config.further.size() > 0) f.further_ = state.take<Eye>("localizer.rig", config.further.size());
  f.gray_ = scratch.take<uint8_t>("localizer.gray", pixels);
  FeatureRoom::layout(kNames, config, scratch, front ? &f.room_ : nullptr);
  f.lifted_ = scratch.take<LiftedPoint>("localizer.lifted", n);
  f.keypoint_of_ = scratch.take<uint32_t>("localizer.lifted", n);
  SparseAligner::layout(config.depth_camera.width(), config.depth_camera.height(), scratch,
                        front ? &f.color_.aligner : nullptr);
  RigExtractor::layout(config, state, scratch, front ? &f.extractor_ : nullptr);
}

void FrontEnd::init(const LocalizerConfig &config) {
  pixel_sigma_px_ = config.pixel_sigma_px;
  map_sigma_m_ = config.map_sigma_m;
  color_.aligner.init(config.color_camera, config.depth_camera, config.color_from_depth, config.depth_sensor);
  for (size_t i = 0; i < further_.size(); ++i) {
    const RigCamera &given = config.further[i];
    Eye &eye = *new (&further_[i]) Eye();
    eye.aligner.init(given.camera, config.depth_camera, Rigid(), config.depth_sensor);
  }
  extractor_.init(config.parallel);
}

void FrontEnd::extract(const ColorView &color, const FurtherViews &further, const Deadline &deadline) {
  gray_view_ = grayOf(color, gray_);
  keypoint_count_ = extractor_.extract(gray_view_, further, room_, deadline);
  cut_ = extractor_.wasCut();
  lifted_count_ = 0;
}

void FrontEnd::extractInto(const ColorView &color, const FurtherViews &further, const Deadline &deadline,
                           FrameFeatures *features) {
  features->keepGray(color);
  features->count = extractor_.extract(features->gray, further, features->room, deadline);
  features->cut = extractor_.wasCut();
}

void FrontEnd::show(const FrameFeatures &features) {
  gray_view_ = features.gray;
  keypoint_count_ = features.count;
  std::copy_n(features.room.keypoints.begin(), features.count, room_.keypoints.begin());
  std::copy_n(features.room.descriptors.begin(), features.count, room_.descriptors.begin());
  if (!room_.camera_of.empty())
    std::copy_n(features.room.camera_of.begin(), features.count, room_.camera_of.begin());
  cut_ = features.cut;
  lifted_count_ = 0;
}

void FrontEnd::setRig(const FrameRig &rig) {
  motion_ = rig.motion;
  color_.focal_px = rig.color_camera.focal();
  color_.row_time_s = rig.color_row_time_s;
  color_.middle_row_px = 0.5 * rig.color_camera.height();
  color_.aligner.setColor(rig.color_camera, rig.color_from_depth);
  for (size_t i = 0; i < rig.further.size(); ++i) {
    const RigCamera &now = rig.further[i];
    Eye &eye = further_[i];
    eye.focal_px = now.camera.focal();
    eye.row_time_s = now.row_time_s;
    eye.middle_row_px = 0.5 * now.camera.height();
    eye.color_from_camera = now.color_from_camera;
    eye.aligner.setColor(now.camera, now.color_from_camera.inverse() * rig.color_from_depth);
  }
}

void FrontEnd::lift(ImageView<uint16_t> depth, const FrameRig &rig, const Deadline &deadline) {
  setRig(rig);
  color_.aligner.prepare(depth, further_.size() > 0);
  for (Eye &eye : further_) eye.aligner.prepareLike(color_.aligner);
  lifted_count_ = 0;
  Watch watch(deadline, kLiftGrain);
  for (uint32_t k = 0; k < keypoint_count_; ++k) {
    if (watch.passed(1)) {
      keypoint_count_ = k;
      cut_ = true;
      break;
    }
    const Keypoint &at = room_.keypoints[k];
    observations_[k] = {at.x_px, at.y_px, at.scale_px, 0, 0, static_cast<uint8_t>(room_.cameraOf(k)),
                        false,   false,   false};
    keypoint_of_[k] = k;
    double z_m = 0;
    if (!liftOne(depth, k, &z_m)) continue;
    observations_[k].depth_m = static_cast<float>(z_m);
    observations_[k].lifted = true;
    toFront(k);
  }
}

void FrontEnd::mirror() {
  for (uint32_t k = 0; k < keypoint_count_; ++k) {
    room_.descriptors[k] = mirrored(room_.descriptors[k]);
    lifted_[k].point_m.x() = -lifted_[k].point_m.x();
    lifted_[k].centre_m.x() = -lifted_[k].centre_m.x();
  }
}

// Of a rolling shutter: where a keypoint would be if its row had been exposed with the middle one.
Vector2 FrontEnd::atMidTime(const Eye &eye, ImageView<uint16_t> depth, const Vector2 &pixel_px) const {
  if (eye.row_time_s == 0) return pixel_px;
  Vector3 point_m;
  double sigma_z = 0;
  if (!eye.aligner.lift(depth, pixel_px, &point_m, &sigma_z)) {
    if (!eye.aligner.bearing(pixel_px, &point_m)) return pixel_px;
    point_m *= tuning::kRayM;
  }
  const double since_s = (eye.middle_row_px - pixel_px.y()) * eye.row_time_s;
  const Vector3 at_color_m = eye.color_from_camera * point_m;
  const Vector3 moved_m = since_s * (motion_.turn_rad_s.cross(at_color_m) + motion_.shift_m_s);
  point_m += eye.color_from_camera.rotation.transpose() * moved_m;
  Vector2 middle_px;
  return eye.aligner.project(point_m, &middle_px) ? middle_px : pixel_px;
}

// Fills lifted_[k]: with depth, else as a ray.
bool FrontEnd::liftOne(ImageView<uint16_t> depth, uint32_t k, double *z_m) {
  const Eye &eye = eyeOf(k);
  const Keypoint &keypoint = room_.keypoints[k];
  const Vector2 pixel_px = atMidTime(eye, depth, {keypoint.x_px, keypoint.y_px});
  const double coarseness = static_cast<double>(keypoint.scale_px) / tuning::kFineScalePx;
  const double sigma_px = pixel_sigma_px_ * (coarseness > 1 ? coarseness : 1.0);
  const bool is_further = &eye != &color_;
  LiftedPoint ray = {Vector3::UnitZ(), kUselessSigma, std::numeric_limits<double>::infinity()};
  if (eye.aligner.bearing(pixel_px, &ray.point_m))
    ray.sideways_m = hypotOf(sigma_px / eye.focal_px, map_sigma_m_ / tuning::kRayM);
  if (is_further) toColor(eye.color_from_camera, &ray);
  lifted_[k] = ray;
  double sigma_z = 0;
  Vector3 point_m;
  if (!eye.aligner.lift(depth, pixel_px, &point_m, &sigma_z)) return false;
  const double z = *z_m = point_m.z();
  LiftedPoint lifted = {point_m, hypotOf(sigma_px * z / eye.focal_px, map_sigma_m_),
                        hypotOf(sigma_z * point_m.norm() / z, map_sigma_m_)};
  if (is_further && !toColor(eye.color_from_camera, &lifted)) return false;
  lifted_[k] = lifted;
  return true;
}

// Makes keypoint k, the last so far, one of those with depth, which come first.
void FrontEnd::toFront(uint32_t k) {
  std::swap(lifted_[lifted_count_], lifted_[k]);
  std::swap(keypoint_of_[lifted_count_], keypoint_of_[k]);
  std::swap(room_.descriptors[lifted_count_], room_.descriptors[k]);
  ++lifted_count_;
}

}  // namespace sphc
