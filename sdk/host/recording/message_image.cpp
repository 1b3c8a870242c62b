#include "message_image.h"

#include "encoded_image.h"
#include "failure.h"
#include "host/recording/mcap/depth_rvl.h"
#include "pixels.h"

namespace sphc::recording {

namespace {

[[noreturn]] void failMalformed(const char *what) {
  throw Failure(SPHC_E_DEVICE, std::string("is malformed (") + what + "); record it again");
}

[[noreturn]] void failOtherEncoding(std::string_view encoding, std::string_view wanted) {
  throw Failure(SPHC_E_DEVICE, "is of the encoding \"" + std::string(encoding.substr(0, 40)) + "\" in place of " +
                                   std::string(wanted) + "; record it again in that");
}

}  // namespace

void MessageDecoder::decode(Kind kind, ByteView message, const sphc_camera &camera, sphc_format format,
                            uint8_t *pixels) {
  if (kind == Kind::kColorImage || kind == Kind::kDepthImage || kind == Kind::kAmplitudeImage)
    return decodeRaw(message, camera, format, pixels);
  CompressedMessage compressed;
  if (!readCompressedMessage(message, compressed)) failMalformed("CompressedImage");
  if (kind == Kind::kColorJpeg)
    decodeImage(compressed.data, ImageType::kJpeg, camera, format, pixels);
  else
    decodeDepth(kind, compressed.data, camera, pixels);
}

void MessageDecoder::decodeRaw(ByteView message, const sphc_camera &camera, sphc_format format, uint8_t *pixels) {
  ImageMessage image;
  if (!readImageMessage(message, image)) failMalformed("Image");
  const sphc_format recorded = formatOf(image.encoding);
  const bool is_color = format != SPHC_FORMAT_DEPTH16 && format != SPHC_FORMAT_GRAY16;
  const bool is_recorded_color = isRecorded(recorded) && recorded != SPHC_FORMAT_DEPTH16;
  if (is_color ? !is_recorded_color : recorded != format)
    failOtherEncoding(image.encoding, is_color ? "bgr8, rgb8 or mono8" : encodingOf(format));
  requireSize(image.width, image.height, camera, is_color);
  const uint64_t row_bytes = uint64_t{image.width} * sphc_format_bytes(recorded);
  if (image.step < row_bytes || uint64_t{image.step} * image.height > image.data.size) failMalformed("its rows");
  packPixels({image.data.data, image.width, image.height, image.step, recorded}, format, pixels);
}

void MessageDecoder::decodeDepth(Kind kind, ByteView data, const sphc_camera &camera, uint8_t *pixels) {
  ByteReader reader(data);
  if (kind == Kind::kDepthRvl) reader.take(kRvlHeadBytes - 8);
  const uint32_t width = reader.little<uint32_t>();
  const uint32_t height = reader.little<uint32_t>();
  const ByteView encoded = reader.take(reader.left());
  if (!reader.ok()) failMalformed("its head");
  requireSize(width, height, camera, false);
  auto *const depth = reinterpret_cast<uint16_t *>(pixels);
  const size_t count = size_t{width} * height;
  const bool is_whole =
      kind == Kind::kDepthRvl ? decodeRvl(encoded, depth, count) : zstd_.decode(encoded, depth, count);
  if (!is_whole) failMalformed(kind == Kind::kDepthRvl ? "RVL" : "zstd");
}

}  // namespace sphc::recording
