// The features of all cameras of a rig, from one extractor: image after image.
#pragma once
#include "runtime/localizer/frame.h"
#include "runtime/stages/features/extractor.h"

namespace sphc {

// Where features go: room for max_keypoints of each.
struct FeatureRoom {
  Span<Keypoint> keypoints;
  Span<Descriptor> descriptors;
  Span<uint8_t> camera_of;  // 0: the colour camera; i: further camera i - 1; empty where there is no other

  static void layout(const char *const names[3], const LocalizerConfig &config, Arena &arena, FeatureRoom *room);
  uint32_t cameraOf(uint32_t keypoint) const { return camera_of.empty() ? 0 : camera_of[keypoint]; }
};

class RigExtractor {
 public:
  static void layout(const LocalizerConfig &config, Arena &state, Arena &scratch, RigExtractor *extractor);
  void init(const Parallel &parallel = {}) { extractor_.init(simdFeatureKernels(), parallel); }

  // Returns how many features were found, strongest response first.  Each camera gets an even share of the
  // keypoints and of the time; what one leaves, those after it get.
  uint32_t extract(GrayView color, const FurtherViews &further, const FeatureRoom &room, const Deadline &deadline);
  // Did the deadline leave something out of the last call?
  bool wasCut() const { return cut_; }

 private:
  void sortByResponse(const uint32_t *begins, uint32_t cameras, const FeatureRoom &room);

  FeatureExtractor extractor_;
  bool cut_ = false;
  // In scratch, of rigs of several cameras.
  Span<uint8_t> gray_;    // of a further camera
  Span<uint32_t> order_;  // of keypoints
};

}  // namespace sphc
