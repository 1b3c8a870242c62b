// Frames of Motion JPEG as cameras send them, by the encoder of libjpeg-turbo.
#pragma once

#include <turbojpeg.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace sphc::test {

// `pixels` are tightly packed.
inline std::vector<uint8_t> jpegOfPixels(const std::vector<uint8_t> &pixels, int pixel_format, uint32_t width,
                                         uint32_t height, int subsampling, int quality, int flags) {
  const tjhandle encoder = tjInitCompress();
  unsigned char *jpeg = nullptr;
  unsigned long bytes = 0;
  const int failed = tjCompress2(encoder, pixels.data(), static_cast<int>(width), 0, static_cast<int>(height),
                                 pixel_format, &jpeg, &bytes, subsampling, quality, flags);
  const std::vector<uint8_t> frame(jpeg, jpeg + bytes);
  tjFree(jpeg);
  tjDestroy(encoder);
  if (failed) throw std::runtime_error("cannot encode a JPEG");
  return frame;
}

// `flags` as TJFLAG_PROGRESSIVE.
inline std::vector<uint8_t> jpegFrame(const std::vector<uint8_t> &rgb, uint32_t width, uint32_t height,
                                      int subsampling = TJSAMP_422, int quality = 95, int flags = 0) {
  return jpegOfPixels(rgb, TJPF_RGB, width, height, subsampling, quality, flags);
}

// In the colours of print.
inline std::vector<uint8_t> cmykJpeg(uint32_t width, uint32_t height) {
  return jpegOfPixels(std::vector<uint8_t>(size_t{4} * width * height, 90), TJPF_CMYK, width, height, TJSAMP_444,
                      95, 0);
}

// A soft gradient, so that what the encoder loses is little.
inline std::vector<uint8_t> gradientRgb(uint32_t width, uint32_t height) {
  std::vector<uint8_t> rgb;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x)
      for (const uint32_t value : {40 + 2 * x, 60 + 2 * y, 200 - x - y}) rgb.push_back(static_cast<uint8_t>(value));
  return rgb;
}

// Cameras leave the Huffman tables out, since they are always the same.
inline std::vector<uint8_t> withoutHuffmanTables(std::vector<uint8_t> frame) {
  size_t at = 2;
  while (at + 4 <= frame.size() && frame[at] == 0xff && frame[at + 1] != 0xda) {
    const size_t segment = 2 + 256u * frame[at + 2] + frame[at + 3];
    if (frame[at + 1] == 0xc4)
      frame.erase(frame.begin() + static_cast<long>(at), frame.begin() + static_cast<long>(at + segment));
    else
      at += segment;
  }
  return frame;
}

}  // namespace sphc::test
