// Depth through zstd: differences to the last measured pixel, their low bytes before their high bytes.  Twice as
// small as RVL at a similar cost (docs/recording.md).
#pragma once

#include <zstd.h>

#include <memory>

#include "bytes.h"

namespace sphc::recording {

class DepthZstdEncoder {
 public:
  explicit DepthZstdEncoder(size_t most_pixels);
  // Room that always suffices.
  static size_t mostBytes(size_t pixels) { return ZSTD_compressBound(2 * pixels); }
  // Gives the bytes written to `out`; 0 when zstd fails, which it does not with enough room and memory.
  size_t encode(const uint16_t *depth, size_t count, uint8_t *out, size_t room);

 private:
  struct Free {
    void operator()(ZSTD_CCtx *context) const { ZSTD_freeCCtx(context); }
  };
  std::unique_ptr<ZSTD_CCtx, Free> context_;
  Bytes planes_;
};

class DepthZstdDecoder {
 public:
  DepthZstdDecoder();
  // Fills exactly `count` pixels; false when the bytes say something else.
  bool decode(ByteView encoded, uint16_t *depth, size_t count);

 private:
  struct Free {
    void operator()(ZSTD_DCtx *context) const { ZSTD_freeDCtx(context); }
  };
  std::unique_ptr<ZSTD_DCtx, Free> context_;
  Bytes planes_;  // grows to the largest image
};

}  // namespace sphc::recording
