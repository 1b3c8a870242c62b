// Lossless codecs for depth images, ours and others'.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sphc::host {

using EncodedDepth = std::vector<uint8_t>;

struct DepthCodec {
  std::string name;
  std::function<void(const std::vector<uint16_t> &depth, EncodedDepth *encoded)> encode;
  // False when the bytes are refused.
  std::function<bool(const EncodedDepth &encoded, std::vector<uint16_t> *depth)> decode;
};

// For images of this size, the recorder's default first.
std::vector<DepthCodec> depthCodecs(uint32_t width, uint32_t height);

}  // namespace sphc::host
