// A depth image as it came, as z in uint16 units, without what is not to be believed.
//
//     DepthReader::layout(config, state, scratch, &reader);   as every module's
//     reader.init(config);                                    once
//     reader.read(depth, amplitude);                          once a frame
#pragma once
#include "runtime/base/arena.h"
#include "runtime/geometry/camera.h"
#include "runtime/types/image_view.h"

namespace sphc {

struct DepthReaderConfig {
  Camera camera;
  double unit_m = 0.001;
  DepthLayout layout;
  // Measurements of a lower amplitude are dropped, and so are flying pixels: those between two surfaces.  0: none.
  uint32_t least_amplitude = 0;
};

class DepthReader {
 public:
  static void layout(const DepthReaderConfig &config, Arena &state, Arena &scratch, DepthReader *reader);
  // After layout with memory.  Computes a ray for every pixel where depth is a range.
  void init(const DepthReaderConfig &config);
  // In place where there is nothing to change, else valid until the next call.
  ImageView<uint16_t> read(const ByteView &depth, const AmplitudeView &amplitude);

 private:
  void makeCosines();
  void decodeRow(const uint8_t *from, int32_t y, uint16_t *z) const;
  void dropFaint(const AmplitudeView &amplitude, int32_t y, uint16_t *z) const;
  void dropFlying();

  DepthReaderConfig config_;
  int32_t width_ = 0, height_ = 0;
  Span<uint16_t> cosines_;  // of a ray to the axis, times 65536, at most 65535; 0: no ray; in state
  Span<uint16_t> z_;        // in scratch
  Span<uint16_t> rows_;     // two rows of it as they were; in scratch
};

}  // namespace sphc
