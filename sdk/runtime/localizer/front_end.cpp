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

SeenCameras seenOf(const FurtherViews &further) {
  SeenCameras seen = 0;
  for (size_t i = 0; i < further.size(); ++i)
    if (further[i].image.bytes.data) seen |= seenBit(i);
  return seen;
}

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
  for (size_t i = 0; i < config.depth.size(); ++i) {
    const Camera &camera = config.depth[i].camera;
    SparseAligner::layout(camera.width(), camera.height(), scratch, front ? &f.color_.aligners[i] : nullptr);
  }
  RigExtractor::layout(config, state, scratch, front ? &f.extractor_ : nullptr);
}

void FrontEnd::init(const LocalizerConfig &config) {
  pixel_sigma_px_ = config.pixel_sigma_px;
  map_sigma_m_ = config.map_sigma_m;
  for (Eye &eye : further_) new (&eye) Eye();
  for (size_t i = 0; i < config.depth.size(); ++i) {
    const DepthSensor &sensor = config.depth[i].sensor;
    color_.aligners[i].init(sensor);
    for (Eye &eye : further_) eye.aligners[i].init(sensor);
  }
  relation_.init(config.depth_prior.mid_m, config.depth[config.depth.size() - 1].relation_sigma);
  extractor_.init(config.parallel);
}

void FrontEnd::extract(const ColorView &color, const FurtherViews &further, const Deadline &deadline) {
  gray_view_ = grayOf(color, gray_);
  keypoint_count_ = extractor_.extract(gray_view_, further, room_, deadline);
  seen_cameras_ = seenOf(further);
  cut_ = extractor_.wasCut();
  lifted_count_ = 0;
}

void FrontEnd::extractInto(const ColorView &color, const FurtherViews &further, const Deadline &deadline,
                           FrameFeatures *features) {
  features->keepGray(color);
  features->count = extractor_.extract(features->gray, further, features->room, deadline);
  features->seen_cameras = seenOf(further);
  features->cut = extractor_.wasCut();
}

void FrontEnd::show(const FrameFeatures &features) {
  gray_view_ = features.gray;
  keypoint_count_ = features.count;
  std::copy_n(features.room.keypoints.begin(), features.count, room_.keypoints.begin());
  std::copy_n(features.room.descriptors.begin(), features.count, room_.descriptors.begin());
  if (!room_.camera_of.empty())
    std::copy_n(features.room.camera_of.begin(), features.count, room_.camera_of.begin());
  seen_cameras_ = features.seen_cameras;
  cut_ = features.cut;
  lifted_count_ = 0;
}

void FrontEnd::setRig(const FrameRig &rig) {
  motion_ = rig.motion;
  teaches_ = rig.teaches;
  color_.focal_px = rig.color_camera.focal();
  color_.row_time_s = rig.color_row_time_s;
  color_.middle_row_px = 0.5 * rig.color_camera.height();
  for (size_t d = 0; d < rig.depth.size(); ++d)
    color_.aligners[d].setCameras(rig.color_camera, rig.depth[d].camera, rig.depth[d].color_from_depth);
  for (size_t i = 0; i < rig.further.size(); ++i) {
    const RigCamera &now = rig.further[i];
    Eye &eye = further_[i];
    eye.focal_px = now.camera.focal();
    eye.row_time_s = now.row_time_s;
    eye.middle_row_px = 0.5 * now.camera.height();
    eye.color_from_camera = now.color_from_camera;
    const Rigid camera_from_color = now.color_from_camera.inverse();
    for (size_t d = 0; d < rig.depth.size(); ++d)
      eye.aligners[d].setCameras(now.camera, rig.depth[d].camera,
                                 camera_from_color * rig.depth[d].color_from_depth);
  }
}

void FrontEnd::lift(const DepthImages &depth, const FrameRig &rig, const Deadline &deadline) {
  setRig(rig);
  for (size_t d = 0; d < depth.size(); ++d) {
    if (!depth[d].data) continue;
    color_.aligners[d].prepare(depth[d], further_.size() > 0);
    for (Eye &eye : further_) eye.aligners[d].prepareLike(color_.aligners[d]);
  }
  relation_.nextFrame();
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

// Point seen at a pixel, in the frame of the eye, by the depth camera that is surest of it.  `teaches`: how the two
// are off against each other.
bool FrontEnd::measure(const Eye &eye, const DepthImages &depth, const Vector2 &pixel_px, bool teaches,
                       Vector3 *point_m, double *sigma_m) {
  const bool is_first = eye.aligners[0].lift(depth[0], pixel_px, point_m, sigma_m);
  if (depth.size() < 2 || !depth[1].data) return is_first;
  Vector3 point;
  double sigma = 0;
  if (!eye.aligners[1].lift(depth[1], pixel_px, &point, &sigma)) return is_first;
  if (is_first && teaches) relation_.learn({point_m->z(), *sigma_m}, {point.z(), sigma});
  const DepthRelation::Measured related = relation_.asFirst({point.z(), sigma});
  if (is_first && *sigma_m <= related.sigma_m) return true;
  *point_m = point * (related.z_m / point.z());
  *sigma_m = related.sigma_m;
  return true;
}

// Of a rolling shutter: where a keypoint would be if its row had been exposed with the middle one.
Vector2 FrontEnd::atMidTime(const Eye &eye, const DepthImages &depth, const Vector2 &pixel_px) {
  if (eye.row_time_s == 0) return pixel_px;
  Vector3 point_m;
  double sigma_z = 0;
  if (!measure(eye, depth, pixel_px, false, &point_m, &sigma_z)) {
    if (!eye.view().bearing(pixel_px, &point_m)) return pixel_px;
    point_m *= tuning::kRayM;
  }
  const double since_s = (eye.middle_row_px - pixel_px.y()) * eye.row_time_s;
  const Vector3 at_color_m = eye.color_from_camera * point_m;
  const Vector3 moved_m = since_s * (motion_.turn_rad_s.cross(at_color_m) + motion_.shift_m_s);
  point_m += eye.color_from_camera.rotation.transpose() * moved_m;
  Vector2 middle_px;
  return eye.view().project(point_m, &middle_px) ? middle_px : pixel_px;
}

// Fills lifted_[k]: with depth, else as a ray.
bool FrontEnd::liftOne(const DepthImages &depth, uint32_t k, double *z_m) {
  const Eye &eye = eyeOf(k);
  const Keypoint &keypoint = room_.keypoints[k];
  const Vector2 pixel_px = atMidTime(eye, depth, {keypoint.x_px, keypoint.y_px});
  const double coarseness = static_cast<double>(keypoint.scale_px) / tuning::kFineScalePx;
  const double sigma_px = pixel_sigma_px_ * (coarseness > 1 ? coarseness : 1.0);
  const bool is_further = &eye != &color_;
  LiftedPoint ray = {Vector3::UnitZ(), kUselessSigma, std::numeric_limits<double>::infinity()};
  if (eye.view().bearing(pixel_px, &ray.point_m))
    ray.sideways_m = hypotOf(sigma_px / eye.focal_px, map_sigma_m_ / tuning::kRayM);
  if (is_further) toColor(eye.color_from_camera, &ray);
  lifted_[k] = ray;
  double sigma_z = 0;
  Vector3 point_m;
  if (!measure(eye, depth, pixel_px, teaches_ && !is_further, &point_m, &sigma_z)) return false;
  const double z = *z_m = point_m.z(), range = point_m.norm();
  const double away_m = eye.view().color().awayM(point_m);
  LiftedPoint lifted = {point_m, hypotOf(sigma_px * away_m / eye.focal_px, map_sigma_m_),
                        hypotOf(sigma_z * range / z, map_sigma_m_)};
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
