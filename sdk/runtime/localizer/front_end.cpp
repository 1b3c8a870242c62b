#include "runtime/localizer/front_end.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "runtime/localizer/tuning.h"
#include "runtime/stages/features/gray.h"
#include "runtime/stages/features/mirrored_descriptor.h"

namespace sphc {
namespace {

constexpr uint32_t kLiftGrain = 16;    // keypoints between two looks at the clock
constexpr double kUselessSigma = 1e3;  // of a keypoint where the camera model has no bearing

FeatureConfig featureConfig(const LocalizerConfig &config) {
  FeatureConfig features;
  features.width = config.color_camera.width();
  features.height = config.color_camera.height();
  features.max_keypoints = config.max_keypoints;
  features.pieces = config.parallel.pieces;
  return features;
}

}  // namespace

void FrontEnd::layout(const LocalizerConfig &config, Arena &state, Arena &scratch, FrontEnd *front) {
  const uint32_t n = config.max_keypoints;
  const size_t pixels = size_t(config.color_camera.width()) * size_t(config.color_camera.height());
  FrontEnd discarded;  // receives empty spans while measuring
  FrontEnd &f = front ? *front : discarded;
  f.observations_ = state.take<Observation>("localizer.observations", n);
  f.gray_ = scratch.take<uint8_t>("localizer.gray", pixels);
  f.keypoints_ = scratch.take<Keypoint>("localizer.keypoints", n);
  f.descriptors_ = scratch.take<Descriptor>("localizer.descriptors", n);
  f.lifted_ = scratch.take<LiftedPoint>("localizer.lifted", n);
  f.keypoint_of_ = scratch.take<uint32_t>("localizer.lifted", n);
  SparseAligner::layout(config.depth_camera.width(), config.depth_camera.height(), scratch,
                        front ? &f.aligner_ : nullptr);
  FeatureExtractor::layout(featureConfig(config), state, scratch, front ? &f.extractor_ : nullptr);
}

void FrontEnd::init(const LocalizerConfig &config) {
  focal_px_ = config.color_camera.focal();
  pixel_sigma_px_ = config.pixel_sigma_px;
  map_sigma_m_ = config.map_sigma_m;
  aligner_.init(config.color_camera, config.depth_camera, config.color_from_depth, config.depth_sensor);
  extractor_.init(simdFeatureKernels(), config.parallel);
}

void FrontEnd::extract(const ColorView &color, const Deadline &deadline) {
  gray_view_ = grayOf(color, gray_);
  keypoint_count_ = extractor_.extract(gray_view_, keypoints_, descriptors_, deadline);
  cut_ = extractor_.wasCut();
  lifted_count_ = 0;
}

void FrontEnd::extractInto(const ColorView &color, const Deadline &deadline, FrameFeatures *features) {
  features->keepGray(color);
  features->count = extractor_.extract(features->gray, features->keypoints, features->descriptors, deadline);
  features->cut = extractor_.wasCut();
}

void FrontEnd::show(const FrameFeatures &features) {
  gray_view_ = features.gray;
  keypoint_count_ = features.count;
  std::copy_n(features.keypoints.begin(), features.count, keypoints_.begin());
  std::copy_n(features.descriptors.begin(), features.count, descriptors_.begin());
  cut_ = features.cut;
  lifted_count_ = 0;
}

void FrontEnd::lift(ImageView<uint16_t> depth, const Rigid &color_from_depth, const Deadline &deadline) {
  aligner_.setPose(color_from_depth);
  aligner_.prepare(depth);
  lifted_count_ = 0;
  Watch watch(deadline, kLiftGrain);
  for (uint32_t k = 0; k < keypoint_count_; ++k) {
    if (watch.passed(1)) {
      keypoint_count_ = k;
      cut_ = true;
      break;
    }
    observations_[k] = {keypoints_[k].x_px, keypoints_[k].y_px, keypoints_[k].scale_px, 0, 0, false, false, false};
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
    descriptors_[k] = mirrored(descriptors_[k]);
    lifted_[k].point_m.x() = -lifted_[k].point_m.x();
  }
}

// Fills lifted_[k]: with depth, else as a ray.
bool FrontEnd::liftOne(ImageView<uint16_t> depth, uint32_t k, double *z_m) {
  const Keypoint &keypoint = keypoints_[k];
  const Vector2 pixel_px = {keypoint.x_px, keypoint.y_px};
  const double coarseness = static_cast<double>(keypoint.scale_px) / tuning::kFineScalePx;
  const double sigma_px = pixel_sigma_px_ * (coarseness > 1 ? coarseness : 1.0);
  lifted_[k] = {Vector3::UnitZ(), kUselessSigma, std::numeric_limits<double>::infinity()};
  if (aligner_.bearing(pixel_px, &lifted_[k].point_m))
    lifted_[k].sideways_m = hypotOf(sigma_px / focal_px_, map_sigma_m_ / tuning::kRayM);
  double sigma_z = 0;
  Vector3 point_m;
  if (!aligner_.lift(depth, pixel_px, &point_m, &sigma_z)) return false;
  const double z = *z_m = point_m.z();
  lifted_[k] = {point_m, hypotOf(sigma_px * z / focal_px_, map_sigma_m_),
                hypotOf(sigma_z * point_m.norm() / z, map_sigma_m_)};
  return true;
}

// Makes keypoint k, the last so far, one of those with depth, which come first.
void FrontEnd::toFront(uint32_t k) {
  std::swap(lifted_[lifted_count_], lifted_[k]);
  std::swap(keypoint_of_[lifted_count_], keypoint_of_[k]);
  std::swap(descriptors_[lifted_count_], descriptors_[k]);
  ++lifted_count_;
}

}  // namespace sphc
