#include "runtime/localizer/front_end.h"

#include <limits>
#include <utility>

#include "runtime/stages/features/gray.h"

namespace sphc {
namespace {

constexpr double kRayM = 1;  // where a keypoint without depth is taken to lie, as far as the map's error goes
constexpr double kUselessSigma = 1e3;  // of a keypoint where the camera model has no bearing

FeatureConfig featureConfig(const sphc_config &config) {
  FeatureConfig features;
  features.width = static_cast<int32_t>(config.color_camera.width);
  features.height = static_cast<int32_t>(config.color_camera.height);
  features.max_keypoints = config.max_keypoints;
  return features;
}

double hypotOf(double a, double b) { return sqrtOf(a * a + b * b); }

}  // namespace

void FrontEnd::layout(const sphc_config &config, Arena &state, Arena &scratch, FrontEnd *front) {
  const uint32_t n = config.max_keypoints;
  const size_t pixels = size_t{config.color_camera.width} * config.color_camera.height;
  FrontEnd discarded;  // receives empty spans while measuring
  FrontEnd &f = front ? *front : discarded;
  f.observations_ = state.take<sphc_observation>("localizer.observations", n);
  f.gray_ = scratch.take<uint8_t>("localizer.gray", pixels);
  f.keypoints_ = scratch.take<Keypoint>("localizer.keypoints", n);
  f.descriptors_ = scratch.take<Descriptor>("localizer.descriptors", n);
  f.lifted_ = scratch.take<LiftedPoint>("localizer.lifted", n);
  f.keypoint_of_ = scratch.take<uint32_t>("localizer.lifted", n);
  SparseAligner::layout(static_cast<int32_t>(config.depth_camera.width),
                        static_cast<int32_t>(config.depth_camera.height), scratch, front ? &f.aligner_ : nullptr);
  FeatureExtractor::layout(featureConfig(config), state, scratch, front ? &f.extractor_ : nullptr);
}

void FrontEnd::init(const sphc_config &config) {
  focal_px_ = 0.5 * (config.color_camera.params[0] + config.color_camera.params[1]);
  pixel_sigma_px_ = config.pixel_sigma_px;
  map_sigma_m_ = config.map_sigma_m;
  const DepthSensor sensor = {config.depth_unit_m, config.depth_min_m, config.depth_max_m, config.depth_sigma_m,
                              config.depth_sigma_per_m2};
  aligner_.init(Camera(config.color_camera), Camera(config.depth_camera), rigidFromDoor(config.color_from_depth),
                sensor);
  extractor_.init();
}

void FrontEnd::extract(const sphc_image &color) {
  const auto *pixels = static_cast<const uint8_t *>(color.data);
  GrayView gray = {pixels, static_cast<int32_t>(color.width), static_cast<int32_t>(color.height),
                   static_cast<int32_t>(color.stride_bytes)};
  if (color.format != SPHC_FORMAT_GRAY8) {
    const auto convert = color.format == SPHC_FORMAT_RGB8 ? rgbToGray : bgrToGray;
    convert(pixels, gray.stride, gray.width, gray.height, gray_.data(), gray.width);
    gray.data = gray_.data();
    gray.stride = gray.width;
  }
  keypoint_count_ = extractor_.extract(gray, keypoints_, descriptors_);
  lifted_count_ = 0;
}

void FrontEnd::lift(const sphc_image &depth, const Rigid &color_from_depth) {
  const ImageView<uint16_t> view = {static_cast<const uint16_t *>(depth.data), static_cast<int32_t>(depth.width),
                                    static_cast<int32_t>(depth.height),
                                    static_cast<int32_t>(depth.stride_bytes / 2)};
  aligner_.setPose(color_from_depth);
  aligner_.prepare(view);
  lifted_count_ = 0;
  for (uint32_t k = 0; k < keypoint_count_; ++k) {
    observations_[k] = {keypoints_[k].x_px, keypoints_[k].y_px, keypoints_[k].scale_px, 0, 0, 0};
    keypoint_of_[k] = k;
    double z_m = 0;
    if (!liftOne(view, k, &z_m)) continue;
    observations_[k].depth_m = static_cast<float>(z_m);
    observations_[k].flags = SPHC_OBSERVATION_LIFTED;
    toFront(k);
  }
}

// Fills lifted_[k]: with depth, else as a ray.
bool FrontEnd::liftOne(ImageView<uint16_t> depth, uint32_t k, double *z_m) {
  const Keypoint &keypoint = keypoints_[k];
  const Vector2 pixel_px = {keypoint.x_px, keypoint.y_px};
  // coarser keypoints are placed less exactly
  const double sigma_px =
      pixel_sigma_px_ * (keypoint.scale_px > 2 ? 0.5 * static_cast<double>(keypoint.scale_px) : 1.0);
  lifted_[k] = {Vector3::UnitZ(), kUselessSigma, std::numeric_limits<double>::infinity()};
  if (aligner_.bearing(pixel_px, &lifted_[k].point_m))
    lifted_[k].sideways_m = hypotOf(sigma_px / focal_px_, map_sigma_m_ / kRayM);
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
