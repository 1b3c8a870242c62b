// What a frame shows: its keypoints, their descriptors, and where in front of the camera they lie.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/localizer/config.h"
#include "runtime/localizer/frame_features.h"
#include "runtime/localizer/result.h"
#include "runtime/stages/align/sparse.h"
#include "runtime/stages/features/extractor.h"
#include "runtime/types/correspondence.h"

namespace sphc {

class FrontEnd {
 public:
  static void layout(const LocalizerConfig &config, Arena &state, Arena &scratch, FrontEnd *front);
  void init(const LocalizerConfig &config);

  // What a deadline leaves out is the finest of the image, and the weakest keypoints.
  void extract(const ColorView &color, const Deadline &deadline = {});
  // The same in two halves.  The first touches nothing but the extractor, so the rest may serve another frame
  // meanwhile.
  void extractInto(const ColorView &color, const Deadline &deadline, FrameFeatures *features);
  void show(const FrameFeatures &features);
  // After extract or show.  Those with depth come first from then on, then those without.  `color_from_depth`: the
  // cameras at the time of each one's image.
  void lift(ImageView<uint16_t> depth, const Rigid &color_from_depth, const Deadline &deadline = {});
  // After lift.  Makes the frame its mirror image, left and right changed; a second time it is itself again.
  void mirror();
  // Did a deadline leave something out?
  bool wasCut() const { return cut_; }

  // The image of the last extract or show, as it was processed.
  GrayView gray() const { return gray_view_; }
  uint32_t keypointCount() const { return keypoint_count_; }
  uint32_t liftedCount() const { return lifted_count_; }
  Span<const Keypoint> keypoints() const { return keypoints_.first(keypoint_count_); }  // strongest first
  Span<const Descriptor> descriptors() const { return descriptors_.first(keypoint_count_); }
  Span<const LiftedPoint> lifted() const { return lifted_.first(keypoint_count_); }
  // What is told of the keypoint behind a descriptor.
  Observation &observationOf(uint32_t query) { return observations_[keypoint_of_[query]]; }
  Span<const Observation> observations() const { return observations_.first(keypoint_count_); }

 private:
  bool liftOne(ImageView<uint16_t> depth, uint32_t keypoint, double *z_m);
  void toFront(uint32_t keypoint);

  double focal_px_ = 0, pixel_sigma_px_ = 0, map_sigma_m_ = 0;
  FeatureExtractor extractor_;
  SparseAligner aligner_;

  Span<Observation> observations_;  // in state: readable until the next frame; in the order of keypoints
  // In scratch.
  Span<uint8_t> gray_;
  Span<Keypoint> keypoints_;
  Span<Descriptor> descriptors_;
  Span<LiftedPoint> lifted_;
  Span<uint32_t> keypoint_of_;
  uint32_t keypoint_count_ = 0, lifted_count_ = 0;
  bool cut_ = false;
  GrayView gray_view_;  // gray_, or the caller's image where that is grey, or that of features
};

}  // namespace sphc
