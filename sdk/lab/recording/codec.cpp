#include "lab/recording/codec.h"

#include <zstd.h>

#include <cstring>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "host/recording/mcap/depth_rvl.h"
#include "host/recording/mcap/depth_zstd.h"

namespace sphc::host {
namespace {

using recording::DepthZstdDecoder;
using recording::DepthZstdEncoder;

DepthCodec ours(size_t pixels) {
  const auto encoder = std::make_shared<DepthZstdEncoder>(pixels);
  const auto decoder = std::make_shared<DepthZstdDecoder>();
  return {"ours + zstd",
          [encoder](const std::vector<uint16_t> &depth, EncodedDepth *encoded) {
            encoded->resize(DepthZstdEncoder::mostBytes(depth.size()));
            encoded->resize(encoder->encode(depth.data(), depth.size(), encoded->data(), encoded->size()));
          },
          [decoder](const EncodedDepth &encoded, std::vector<uint16_t> *depth) {
            return decoder->decode(recording::viewOf(encoded), depth->data(), depth->size());
          }};
}

DepthCodec rvl() {
  return {"rvl",
          [](const std::vector<uint16_t> &depth, EncodedDepth *encoded) {
            encoded->resize(recording::rvlMostBytes(depth.size()));
            encoded->resize(recording::encodeRvl(depth.data(), depth.size(), encoded->data()));
          },
          [](const EncodedDepth &encoded, std::vector<uint16_t> *depth) {
            return recording::decodeRvl(recording::viewOf(encoded), depth->data(), depth->size());
          }};
}

DepthCodec plainZstd(int level) {
  const std::shared_ptr<ZSTD_CCtx> encoder(ZSTD_createCCtx(), ZSTD_freeCCtx);
  const std::shared_ptr<ZSTD_DCtx> decoder(ZSTD_createDCtx(), ZSTD_freeDCtx);
  return {"zstd " + std::to_string(level),
          [encoder, level](const std::vector<uint16_t> &depth, EncodedDepth *encoded) {
            encoded->resize(ZSTD_compressBound(2 * depth.size()));
            encoded->resize(ZSTD_compressCCtx(encoder.get(), encoded->data(), encoded->size(), depth.data(),
                                              2 * depth.size(), level));
          },
          [decoder](const EncodedDepth &encoded, std::vector<uint16_t> *depth) {
            return ZSTD_decompressDCtx(decoder.get(), depth->data(), 2 * depth->size(), encoded.data(),
                                       encoded.size()) == 2 * depth->size();
          }};
}

DepthCodec png(int level, int width, int height) {
  return {"png " + std::to_string(level),
          [=](const std::vector<uint16_t> &depth, EncodedDepth *encoded) {
            const cv::Mat image(height, width, CV_16UC1, const_cast<uint16_t *>(depth.data()));
            cv::imencode(".png", image, *encoded, {cv::IMWRITE_PNG_COMPRESSION, level});
          },
          [=](const EncodedDepth &encoded, std::vector<uint16_t> *depth) {
            cv::Mat image(height, width, CV_16UC1, depth->data());
            cv::imdecode(encoded, cv::IMREAD_UNCHANGED, &image);
            return image.data == reinterpret_cast<uint8_t *>(depth->data());
          }};
}

}  // namespace

std::vector<DepthCodec> depthCodecs(uint32_t width, uint32_t height) {
  const int columns = static_cast<int>(width), rows = static_cast<int>(height);
  return {ours(size_t{width} * height), rvl(), plainZstd(1), plainZstd(3), png(1, columns, rows),
          png(6, columns, rows)};
}

}  // namespace sphc::host
