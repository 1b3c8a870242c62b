// What the images of a frame show, kept between the two halves of a frame.
#pragma once
#include "runtime/localizer/rig_extractor.h"

namespace sphc {

struct FrameFeatures {
  static void layout(const LocalizerConfig &config, Arena &state, FrameFeatures *features);

  // Keeps the colour image as grey: what follows the features looks at it too, and the caller's may be gone by
  // then.
  void keepGray(const ColorView &color);

  FeatureRoom room;
  uint32_t count = 0;  // strongest first
  SeenCameras seen_cameras = 0;
  Span<uint8_t> gray_room;
  GrayView gray;         // in gray_room
  bool cut = false;      // did a deadline leave something out?
  uint64_t took_ns = 0;  // by config.clock
};

}  // namespace sphc
