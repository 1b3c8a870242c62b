// What a colour image shows, kept between the two halves of a frame.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/base/span.h"
#include "runtime/localizer/config.h"
#include "runtime/types/image_view.h"
#include "runtime/types/keypoint.h"

namespace sphc {

struct FrameFeatures {
  static void layout(const LocalizerConfig &config, Arena &state, FrameFeatures *features);

  // Keeps the image as grey: what follows the features looks at it too, and the caller's may be gone by then.
  void keepGray(const ColorView &color);

  Span<Keypoint> keypoints;  // room for config.max_keypoints, as has descriptors; strongest first
  Span<Descriptor> descriptors;
  uint32_t count = 0;
  Span<uint8_t> gray_room;
  GrayView gray;         // in gray_room
  bool cut = false;      // did a deadline leave something out?
  uint64_t took_ns = 0;  // by config.clock
};

}  // namespace sphc
