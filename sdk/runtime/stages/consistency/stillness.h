// Does a stream stand still while the other one moves?
#pragma once
#include "runtime/base/arena.h"
#include "runtime/types/fault.h"
#include "runtime/types/image_view.h"

namespace sphc {

// Compares samples of a frame with those of the frame before.
class Stillness {
 public:
  static void layout(size_t depth_samples, Arena &state, Stillness *stillness);

  // `depth`: measurements, as many as in layout.  The times are those of the images.
  Faults look(Span<const uint16_t> depth, int64_t depth_time_ns, GrayView gray, int64_t color_time_ns);
  void reset() { has_before_ = false; }

 private:
  struct Change {
    uint32_t compared = 0, changed = 0, moved = 0;  // moved: by more than noise
    bool isStill() const { return compared > 0 && changed == 0; }
    bool isMotion() const { return compared > 0 && 10 * moved > compared; }
  };
  Change compareDepth(Span<const uint16_t> depth);
  Change compareGray(GrayView gray);

  Span<uint16_t> depth_;
  Span<uint8_t> gray_;
  int64_t depth_time_ns_ = 0, color_time_ns_ = 0;  // when each image last changed
  bool has_before_ = false;
  bool gray_shows_ = false;  // the last image showed something
};

}  // namespace sphc
