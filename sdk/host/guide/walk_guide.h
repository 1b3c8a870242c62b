// Tells somebody who records a walk what to do, frame by frame: frames in, advice out.
//
// It sees a walk as the mapper will (docs/mapping.md), at a fraction of the cost: fewer keypoints, each frame
// compared with one place before it and one that looks alike.
#pragma once
#include "host/guide/advice.h"
#include "host/guide/loop_search.h"
#include "host/guide/walk_summary.h"
#include "host/mapping/frame_reader.h"

namespace sphc::host {

class WalkGuide {
 public:
  struct Options {
    uint32_t max_keypoints = 400;  // of a frame
    double depth_min_m = 0.3, depth_max_m = 6.0;
  };

  explicit WalkGuide(const sphc_rig &rig) : WalkGuide(rig, Options()) {}
  WalkGuide(const sphc_rig &rig, const Options &options);
  WalkGuide(const WalkGuide &) = delete;  // its parts borrow each other
  WalkGuide &operator=(const WalkGuide &) = delete;

  // Times grow.  Images are GRAY8, RGB8 or BGR8, and DEPTH16, of the rig's sizes.
  GuideStep look(const sphc_localizer_frame &images);
  WalkSummary summary() const { return summaryOf(looks_, places_.all(), places_.largestPart(), loops_); }

 private:
  // A frame beside the last place.
  struct Beside {
    WalkFrame frame;
    GuidePlace place;
  };
  std::optional<Rigid> follow(const WalkFrame &frame);
  std::optional<Rigid> followFrom(uint32_t place, const WalkFrame &frame);
  bool makePlaceOfPrevious();
  std::optional<Rigid> beginPart(const WalkFrame &frame);
  void dropLonePlace();
  bool isLone(uint32_t place) const;
  std::optional<ClosedLoop> closeLoop(const Located &here);
  bool isTooFast(const Rigid &part_from_camera, const WalkFrame &frame) const;
  void addLost(bool is_located, GuideStep *step);

  FrameReader reader_;
  Places places_;
  LoopSearch loop_search_;
  std::vector<Look> looks_;
  GuidePlace now_;                     // where the frame is that is looked at
  uint32_t last_ = UINT32_MAX;         // the place that is followed
  uint32_t before_ = UINT32_MAX;       // that was followed before a new part began
  std::optional<Beside> previous_;     // the last frame that follows it
  std::optional<GuidePlace> located_;  // the last frame that had a place
  int64_t whole_ns_ = 0;               // when the walk last was in its largest part
  std::optional<int64_t> loop_ns_;     // when a loop was last seen
  uint32_t loops_ = 0;
};

}  // namespace sphc::host
