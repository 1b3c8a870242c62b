// Images of a recording through the device's own stages.
#pragma once
#include "host/frames/frame_features.h"
#include "host/mapping/walk_frame.h"
#include "runtime/localizer/hints.h"
#include "runtime/stages/align/sparse.h"

namespace sphc::host {

struct FrameReaderOptions {
  uint32_t max_keypoints = 1000;  // of a frame
  double depth_min_m = 0.3, depth_max_m = 6.0;
  bool surfaces = false;  // find depth_by_move of each point, which costs four depths a keypoint
};

class FrameReader {
 public:
  FrameReader(const sphc_rig &rig, const FrameReaderOptions &options);
  // Without index and times.
  WalkFrame describe(const sphc_localizer_frame &images);

 private:
  bool see(ImageView<uint16_t> depth, uint32_t k, SeenPoint *point) const;
  Vector3 depthByMove(ImageView<uint16_t> depth, const Vector2 &pixel_px, const SeenPoint &point) const;
  Hints hintsOf(const ImageQuality &image, uint32_t lifted) const;
  void measureRange(ImageView<uint16_t> depth, ImageEvidence *evidence) const;

  Camera camera_;
  FrameFeatures features_;
  bool surfaces_;
  double least_, most_;  // of the range, in the depth image's unit
  SparseAligner aligner_;
  std::vector<uint8_t> gray_;
};

}  // namespace sphc::host
