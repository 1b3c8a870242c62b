// What a frame shows: its keypoints, their descriptors, and where in front of the camera they lie.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/localizer/config.h"
#include "runtime/localizer/frame_features.h"
#include "runtime/localizer/result.h"
#include "runtime/localizer/tracker.h"
#include "runtime/stages/align/depth_relation.h"
#include "runtime/stages/align/sparse.h"
#include "runtime/types/correspondence.h"

namespace sphc {

// Where a depth camera is in a frame.
struct DepthPlace {
  Camera camera;
  Rigid color_from_depth;
};

// The cameras of a frame; transforms are between the times of their images.
struct FrameRig {
  Camera color_camera;
  FixedVector<DepthPlace, kMostDepthCameras> depth;
  FurtherCameras further;
  double color_row_time_s = 0;
  CameraRate motion;    // of the colour camera, while rows are exposed
  bool teaches = true;  // may be learnt of the depth cameras from this frame
};

// Of each depth camera; without data it has none in this frame.
using DepthImages = FixedVector<ImageView<uint16_t>, kMostDepthCameras>;

class FrontEnd {
 public:
  static void layout(const LocalizerConfig &config, Arena &state, Arena &scratch, FrontEnd *front);
  void init(const LocalizerConfig &config);

  // What a deadline leaves out is the finest of the image, and the weakest keypoints.
  void extract(const ColorView &color, const FurtherViews &further, const Deadline &deadline = {});
  // The same in two halves.  The first touches nothing but the extractor, so the rest may serve another frame
  // meanwhile.
  void extractInto(const ColorView &color, const FurtherViews &further, const Deadline &deadline,
                   FrameFeatures *features);
  void show(const FrameFeatures &features);
  // After extract or show.  Those with depth come first from then on, then those without.
  void lift(const DepthImages &depth, const FrameRig &rig, const Deadline &deadline = {});
  // After lift.  Makes the frame its mirror image, left and right changed; a second time it is itself again.
  void mirror();
  // Did a deadline leave something out?
  bool wasCut() const { return cut_; }

  // The image of the last extract or show, as it was processed.
  GrayView gray() const { return gray_view_; }
  SeenCameras seenCameras() const { return seen_cameras_; }
  uint32_t keypointCount() const { return keypoint_count_; }
  uint32_t liftedCount() const { return lifted_count_; }
  Span<const Keypoint> keypoints() const { return room_.keypoints.first(keypoint_count_); }  // strongest first
  Span<const Descriptor> descriptors() const { return room_.descriptors.first(keypoint_count_); }
  Span<const LiftedPoint> lifted() const { return lifted_.first(keypoint_count_); }
  // What is told of the keypoint behind a descriptor.
  Observation &observationOf(uint32_t query) { return observations_[keypoint_of_[query]]; }
  Span<const Observation> observations() const { return observations_.first(keypoint_count_); }

 private:
  struct Eye {
    double focal_px = 0, row_time_s = 0, middle_row_px = 0;
    Rigid color_from_camera;
    SparseAligner aligners[kMostDepthCameras];  // one for each depth camera

    // Of the camera's own pixels, whatever the depth camera.
    const SparseAligner &view() const { return aligners[0]; }
  };
  const Eye &eyeOf(uint32_t keypoint) const {
    const uint32_t camera = room_.cameraOf(keypoint);
    return camera == 0 ? color_ : further_[camera - 1];
  }
  void setRig(const FrameRig &rig);
  bool measure(const Eye &eye, const DepthImages &depth, const Vector2 &pixel_px, bool teaches, Vector3 *point_m,
               double *sigma_m);
  Vector2 atMidTime(const Eye &eye, const DepthImages &depth, const Vector2 &pixel_px);
  bool liftOne(const DepthImages &depth, uint32_t keypoint, double *z_m);
  void toFront(uint32_t keypoint);

  double pixel_sigma_px_ = 0, map_sigma_m_ = 0;
  CameraRate motion_;
  bool teaches_ = true;
  DepthRelation relation_;  // of the second depth camera to the first
  RigExtractor extractor_;
  Eye color_;
  Span<Eye> further_;  // in state

  Span<Observation> observations_;  // in state: readable until the next frame; in the order of keypoints
  // In scratch.
  Span<uint8_t> gray_;
  FeatureRoom room_;
  Span<LiftedPoint> lifted_;
  Span<uint32_t> keypoint_of_;
  uint32_t keypoint_count_ = 0, lifted_count_ = 0;
  SeenCameras seen_cameras_ = 0;
  bool cut_ = false;
  GrayView gray_view_;  // gray_, or the caller's image where that is grey, or that of features
};

}  // namespace sphc
