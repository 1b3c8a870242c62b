#include "host/mapping/frame_reader.h"

#include <algorithm>
#include <cmath>

#include "host/frames/frame_images.h"
#include "host/import/point_tracks.h"
#include "runtime/localizer/tuning.h"

namespace sphc::host {
namespace {

constexpr double kBesidePx = 8;      // of a keypoint, where its surface is looked at
constexpr double kMostBend = 0.03;   // of the depth between two neighbours, relative
constexpr double kPixelSigma = 0.8;  // of a fine keypoint, as the localizer's default has it
constexpr int32_t kRangeStep = 8;    // pixels of a depth image, where its range is looked at

}  // namespace

FrameReader::FrameReader(const sphc_rig &rig, const FrameReaderOptions &options)
    : camera_(rig.color_camera),
      features_(camera_.width(), camera_.height(), options.max_keypoints),
      surfaces_(options.surfaces),
      least_(options.depth_min_m / rig.depth_unit_m),
      most_(options.depth_max_m / rig.depth_unit_m) {
  const DepthSensor sensor = {rig.depth_unit_m, options.depth_min_m, options.depth_max_m, kMappingNoise.sigma_m,
                              kMappingNoise.sigma_per_m2};
  aligner_ = SparseAligner(camera_, Camera(rig.depth_camera), rigidFromC(rig.color_from_depth), sensor);
}

WalkFrame FrameReader::describe(const sphc_localizer_frame &images) {
  const GrayView gray = grayOf(images.color, &gray_);
  features_.extract(gray);
  WalkFrame frame;
  uint32_t lifted = 0;
  for (uint32_t k = 0; k < features_.count(); ++k) {
    SeenPoint point;
    if (!see(depthOf(images.depth), k, &point)) continue;
    lifted += point.hasDepth();
    frame.points.push_back(point);
    frame.descriptors.push_back(features_.descriptor(k));
  }
  const ImageQuality image = qualityOf(gray, camera_.focal());
  frame.hints = hintsOf(image, lifted);
  frame.evidence.level = image.level;
  frame.evidence.keypoints = features_.count();
  if (lifted > 0) frame.evidence.with_depth = static_cast<double>(lifted) / features_.count();
  measureRange(depthOf(images.depth), &frame.evidence);
  return frame;
}

bool FrameReader::see(ImageView<uint16_t> depth, uint32_t k, SeenPoint *point) const {
  const Vector2 pixel_px = features_.pixel(k);
  if (!camera_.unproject(pixel_px, &point->ray)) return false;
  const double coarseness = static_cast<double>(features_.keypoint(k).scale_px) / tuning::kFineScalePx;
  point->sigma = kPixelSigma * std::max(1.0, coarseness) / camera_.focal();
  point->bearing = Vector3(point->ray.x(), point->ray.y(), 1).normalized();
  Vector3 lifted_m;
  if (aligner_.lift(depth, pixel_px, &lifted_m, &point->depth_sigma_m)) point->depth_m = lifted_m.z();
  if (surfaces_ && point->hasDepth()) point->depth_by_move = depthByMove(depth, pixel_px, *point);
  return true;
}

// The inverse depth of a plane is linear in the ray.  Its slope is that of two neighbours on either side; without
// them, or where they are not of one surface, the surface is taken to face the camera.
Vector3 FrameReader::depthByMove(ImageView<uint16_t> depth, const Vector2 &pixel_px, const SeenPoint &point) const {
  Vector2 slope;
  for (int axis = 0; axis < 2; ++axis) {
    Vector3 side_m[2];
    for (int side = 0; side < 2; ++side) {
      const Vector2 at_px = pixel_px + (side ? kBesidePx : -kBesidePx) * Vector2::Unit(axis);
      double sigma_m;
      if (!aligner_.lift(depth, at_px, &side_m[side], &sigma_m)) return Vector3::UnitZ();
    }
    const double before = 1 / side_m[0].z(), after = 1 / side_m[1].z();
    if (std::abs(0.5 * (before + after) * point.depth_m - 1) > kMostBend) return Vector3::UnitZ();
    slope[axis] = (after - before) / (side_m[1][axis] / side_m[1].z() - side_m[0][axis] / side_m[0].z());
  }
  return Vector3(slope.x() * point.depth_m, slope.y() * point.depth_m, 1 - slope.dot(point.ray) * point.depth_m);
}

// As the localizer would say it of a frame without a pose.
Hints FrameReader::hintsOf(const ImageQuality &image, uint32_t lifted) const {
  Hints hints = 0;
  if (image.isDark()) hints |= kTooDark;
  if (image.isBlurredAlongALine()) hints |= kTooFast;
  if (image.isPlain() || features_.count() < tuning::kFewestKeypoints) hints |= kTooPlain;
  if (lifted * tuning::kOneWithDepthIn < features_.count()) hints |= kNoDepthInRange;
  return hints;
}

void FrameReader::measureRange(ImageView<uint16_t> depth, ImageEvidence *evidence) const {
  uint32_t measured = 0, nearer = 0, farther = 0;
  for (int32_t y = kRangeStep / 2; y < depth.height; y += kRangeStep)
    for (int32_t x = kRangeStep / 2; x < depth.width; x += kRangeStep) {
      const uint16_t value = depth.row(y)[x];
      measured += value > 0;
      nearer += value > 0 && value < least_;
      farther += value > most_;
    }
  if (measured == 0) return;
  evidence->nearer = static_cast<double>(nearer) / measured;
  evidence->farther = static_cast<double>(farther) / measured;
}

}  // namespace sphc::host
