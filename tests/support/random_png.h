// PNG files of every kind with random pixels, and chunks to put into them.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace sphc::test {

using PngBytes = std::vector<uint8_t>;

struct PngKind {
  uint32_t color_type, bit_depth;
  bool is_interlaced;
};

inline void putBigEndian(uint32_t value, PngBytes *out) {
  for (int shift = 24; shift >= 0; shift -= 8) out->push_back(static_cast<uint8_t>(value >> shift));
}

inline PngBytes pngChunk(const std::string &type, const PngBytes &data) {
  PngBytes named(type.begin(), type.end());
  named.insert(named.end(), data.begin(), data.end());
  PngBytes chunk;
  putBigEndian(static_cast<uint32_t>(data.size()), &chunk);
  chunk.insert(chunk.end(), named.begin(), named.end());
  putBigEndian(static_cast<uint32_t>(crc32(0, named.data(), static_cast<uInt>(named.size()))), &chunk);
  return chunk;
}

inline PngBytes deflated(const PngBytes &raw) {
  PngBytes out(compressBound(static_cast<uLong>(raw.size())));
  uLongf bytes = static_cast<uLongf>(out.size());
  if (compress2(out.data(), &bytes, raw.data(), static_cast<uLong>(raw.size()), 1) != Z_OK)
    throw std::runtime_error("zlib");
  out.resize(bytes);
  return out;
}

// Behind the header, which is 33 bytes long with the signature.
inline PngBytes withPngChunk(PngBytes png, const std::string &type, const PngBytes &data) {
  const PngBytes chunk = pngChunk(type, data);
  png.insert(png.begin() + 33, chunk.begin(), chunk.end());
  return png;
}

class RandomPng {
 public:
  RandomPng(uint32_t width, uint32_t height, uint32_t seed) : width_(width), height_(height), random_(seed) {}

  PngBytes of(const PngKind &kind) {
    PngBytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    PngBytes header;
    putBigEndian(width_, &header);
    putBigEndian(height_, &header);
    const PngBytes rest = {static_cast<uint8_t>(kind.bit_depth), static_cast<uint8_t>(kind.color_type), 0, 0,
                           static_cast<uint8_t>(kind.is_interlaced)};
    header.insert(header.end(), rest.begin(), rest.end());
    add("IHDR", header, &png);
    if (kind.color_type == 3) add("PLTE", bytes(3u << kind.bit_depth), &png);
    add("IDAT", deflated(kind.is_interlaced ? passes(kind) : rows(kind, width_, height_)), &png);
    add("IEND", {}, &png);
    return png;
  }

 private:
  static void add(const char *type, const PngBytes &data, PngBytes *png) {
    const PngBytes chunk = pngChunk(type, data);
    png->insert(png->end(), chunk.begin(), chunk.end());
  }

  PngBytes bytes(size_t count) {
    PngBytes out(count);
    for (uint8_t &byte : out) byte = static_cast<uint8_t>(random_());
    return out;
  }

  // Each behind the number of a filter.
  PngBytes rows(const PngKind &kind, uint32_t width, uint32_t height) {
    constexpr uint32_t kChannels[] = {1, 0, 3, 1, 2, 0, 4};
    PngBytes out;
    for (uint32_t y = 0; y < height && width > 0; ++y) {
      out.push_back(static_cast<uint8_t>(random_() % 5));
      const PngBytes row = bytes((size_t{width} * kChannels[kind.color_type] * kind.bit_depth + 7) / 8);
      out.insert(out.end(), row.begin(), row.end());
    }
    return out;
  }

  PngBytes passes(const PngKind &kind) {
    constexpr uint32_t kFirstX[] = {0, 4, 0, 2, 0, 1, 0}, kStepX[] = {8, 8, 4, 4, 2, 2, 1};
    constexpr uint32_t kFirstY[] = {0, 0, 4, 0, 2, 0, 1}, kStepY[] = {8, 8, 8, 4, 4, 2, 2};
    PngBytes out;
    for (int i = 0; i < 7; ++i) {
      const PngBytes pass = rows(kind, (width_ - kFirstX[i] + kStepX[i] - 1) / kStepX[i],
                                 (height_ - kFirstY[i] + kStepY[i] - 1) / kStepY[i]);
      out.insert(out.end(), pass.begin(), pass.end());
    }
    return out;
  }

  uint32_t width_, height_;
  std::mt19937 random_;
};

}  // namespace sphc::test
