// Does a frame contradict itself, or the frames before it?  A sensor that is broken, late, or not the one of the
// calibration makes poses that are sure and wrong.
#pragma once
#include "runtime/stages/consistency/depth_edges.h"
#include "runtime/stages/consistency/depth_values.h"
#include "runtime/stages/consistency/edge_agreement.h"
#include "runtime/stages/consistency/stillness.h"
#include "runtime/stages/consistency/travel.h"

namespace sphc {

struct ConsistencyConfig {
  Camera color_camera, depth_camera;
  DepthSensor depth_sensor = {};
  bool follows = false;         // do frames follow each other?  Else each is looked at alone
  bool depth_is_range = false;  // is it measured so?  Images hold z all the same
};

struct ConsistencyView {
  GrayView gray;
  ImageView<uint16_t> depth;
  Rigid color_from_depth;  // at the times of the images
  int64_t color_time_ns = 0, depth_time_ns = 0;
  // Is it unknown how the camera moved between them?  What edges say of such frames they say of no others.
  bool are_apart = false;
  // Is an image too dark or too bright to show edges where they are?  Asked where they speak against the frame;
  // null: never.
  bool (*hides_edges)(GrayView) = nullptr;
};

class Consistency {
 public:
  static void layout(Arena &state, Arena &scratch, Consistency *consistency);
  // Once, after layout with memory.
  void init(const ConsistencyConfig &config);
  // Replaces those of init for the frames that follow.
  void setCameras(const Camera &color, const Camera &depth) {
    config_.color_camera = color;
    config_.depth_camera = depth;
  }
  // Every frame; what is wrong with it.
  Faults look(const ConsistencyView &view);
  // After look: too little for a fault, but enough not to be sure of a pose.
  bool isDoubtful() const { return doubtful_; }
  // Forgets earlier frames.
  void reset();

  // Of the last frame.
  const DepthValues &values() const { return values_; }
  const EdgeAgreement &agreement() const { return agreement_; }

 private:
  Faults judgeValues() const;
  bool edgesDisagree(const ConsistencyView &view);
  bool isBent();

  ConsistencyConfig config_;
  DepthSamples samples_;
  DepthEdges edges_;
  Stillness stillness_;
  DepthValues values_;
  EdgeAgreement agreement_;
  // What edges said, summed over frames, at the last frame whose edges told something.
  struct EdgeDoubt {
    double told_sum = 0;
    int64_t told_time_ns = INT64_MIN / 2;
    bool disagreed = false;  // at the frame before
  };
  EdgeDoubt together_, apart_;
  bool doubtful_ = false, bent_ = false;
};

}  // namespace sphc
