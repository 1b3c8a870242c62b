#include "depth_zstd.h"

#include <new>

namespace sphc::recording {

namespace {

constexpr int kLevel = 1;  // 3 takes a quarter longer for nothing

// Small differences of either sign become small numbers; modulo 2^16.
uint16_t zigzag(uint16_t difference) { return static_cast<uint16_t>(difference << 1 ^ -(difference >> 15)); }
uint16_t unzigzag(uint16_t code) { return static_cast<uint16_t>(code >> 1 ^ -(code & 1)); }

// A hole is 0 and leaves `last` alone.  A measured pixel is never 0, so the code that 0 would have is free, and
// those below it move up by one to make room.
uint16_t codeOf(uint16_t depth, uint16_t *last) {
  if (depth == 0) return 0;
  const uint16_t code = zigzag(static_cast<uint16_t>(depth - *last));
  const uint16_t free_code = zigzag(static_cast<uint16_t>(-*last));
  *last = depth;
  return static_cast<uint16_t>(code + (code < free_code));
}

uint16_t depthOf(uint16_t code, uint16_t *last) {
  if (code == 0) return 0;
  const uint16_t free_code = zigzag(static_cast<uint16_t>(-*last));
  *last = static_cast<uint16_t>(*last + unzigzag(static_cast<uint16_t>(code - (code <= free_code))));
  return *last;
}

}  // namespace

DepthZstdEncoder::DepthZstdEncoder(size_t most_pixels) : context_(ZSTD_createCCtx()), planes_(2 * most_pixels) {
  if (!context_) throw std::bad_alloc();
}

size_t DepthZstdEncoder::encode(const uint16_t *depth, size_t count, uint8_t *out, size_t room) {
  uint8_t *const low = planes_.data();
  uint8_t *const high = low + count;
  uint16_t last = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint16_t code = codeOf(depth[i], &last);
    low[i] = static_cast<uint8_t>(code);
    high[i] = static_cast<uint8_t>(code >> 8);
  }
  const size_t bytes = ZSTD_compressCCtx(context_.get(), out, room, planes_.data(), 2 * count, kLevel);
  return ZSTD_isError(bytes) ? 0 : bytes;
}

DepthZstdDecoder::DepthZstdDecoder() : context_(ZSTD_createDCtx()) {
  if (!context_) throw std::bad_alloc();
}

bool DepthZstdDecoder::decode(ByteView encoded, uint16_t *depth, size_t count) {
  planes_.resize(2 * count);
  const size_t bytes =
      ZSTD_decompressDCtx(context_.get(), planes_.data(), planes_.size(), encoded.data, encoded.size);
  if (ZSTD_isError(bytes) || bytes != planes_.size()) return false;
  const uint8_t *const low = planes_.data();
  const uint8_t *const high = low + count;
  uint16_t last = 0;
  for (size_t i = 0; i < count; ++i) depth[i] = depthOf(static_cast<uint16_t>(low[i] | high[i] << 8), &last);
  return true;
}

}  // namespace sphc::recording
