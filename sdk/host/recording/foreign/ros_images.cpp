#include "host/recording/foreign/ros_images.h"

#include <cmath>

#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"
#include "host/recording/foreign/opaque_pixels.h"
#include "host/recording/mcap/depth_rvl.h"
#include "host/recording/mcap/messages.h"

namespace sphc::recording {

namespace {

constexpr size_t kCompressedDepthHeadBytes = 12;  // its format and two numbers of the quantization

struct RawColor {
  std::string_view encoding;
  sphc_format format;
  uint32_t pixel_bytes;  // 4: a fourth byte follows, which is left out
};
constexpr RawColor kRawColors[] = {{"rgb8", SPHC_FORMAT_RGB8, 3},   {"bgr8", SPHC_FORMAT_BGR8, 3},
                                   {"8UC3", SPHC_FORMAT_BGR8, 3},   {"rgba8", SPHC_FORMAT_RGB8, 4},
                                   {"bgra8", SPHC_FORMAT_BGR8, 4},  {"8UC4", SPHC_FORMAT_BGR8, 4},
                                   {"mono8", SPHC_FORMAT_GRAY8, 1}, {"8UC1", SPHC_FORMAT_GRAY8, 1}};

[[noreturn]] void failRos(const std::string &what) {
  throw Failure(SPHC_E_DEVICE, "is malformed (" + what + "); record it again");
}
[[noreturn]] void failEncoding(std::string_view encoding, const char *cure) {
  throw Failure(SPHC_E_UNSUPPORTED, "is of the encoding \"" + std::string(encoding.substr(0, 40)) + "\"; " + cure);
}

RosImage rawImage(const RosMessage &message, const sphc_camera &camera, bool is_color) {
  RosImage image;
  if (!readRosImage(message, image)) failRos("Image");
  requireSize(image.width, image.height, camera, is_color);
  return image;
}

void requireRows(const RosImage &image, uint32_t pixel_bytes) {
  if (image.step < uint64_t{image.width} * pixel_bytes || uint64_t{image.step} * image.height > image.data.size)
    failRos("its rows");
}

const RawColor *rawColorOf(std::string_view encoding) {
  for (const RawColor &known : kRawColors)
    if (known.encoding == encoding) return &known;
  return nullptr;
}

void decodeRawColor(const RosImage &image, sphc_format format, uint8_t *pixels) {
  const RawColor *raw = rawColorOf(image.encoding);
  if (!raw) failEncoding(image.encoding, kReadRosColor);
  requireRows(image, raw->pixel_bytes);
  if (raw->pixel_bytes == 4)
    return packOpaque(image.data.data, image.width, image.height, image.step, raw->format, format, pixels);
  packPixels({image.data.data, image.width, image.height, image.step, raw->format}, format, pixels);
}

void decodeRawDepth(const RosImage &image, uint16_t *depth_mm) {
  const bool is_float = image.encoding == "32FC1";
  if (!is_float && image.encoding != "16UC1" && image.encoding != "mono16")
    failEncoding(image.encoding, kReadRosDepth);
  requireRows(image, is_float ? 4 : 2);
  for (uint32_t y = 0; y < image.height; ++y) {
    const uint8_t *row = image.data.data + size_t{y} * image.step;
    for (uint32_t x = 0; x < image.width; ++x, ++depth_mm) {
      float depth_m;
      if (is_float) std::memcpy(&depth_m, row + 4 * x, sizeof depth_m);
      *depth_mm = is_float ? millimetresOf(depth_m) : loadLittle<uint16_t>(row + 2 * x);
    }
  }
}

RosCompressedImage compressedImage(const RosMessage &message) {
  RosCompressedImage image;
  if (!readRosCompressedImage(message, image)) failRos("CompressedImage");
  return image;
}

ImageType compressedTypeOf(ByteView data) { return imageTypeOf(data).value_or(ImageType::kJpeg); }

void decodeRvlDepth(ByteView data, const sphc_camera &camera, uint16_t *depth_mm) {
  ByteReader reader(data);
  const uint32_t width = reader.little<uint32_t>();
  const uint32_t height = reader.little<uint32_t>();
  if (!reader.ok()) failRos("its head");
  requireSize(width, height, camera, false);
  if (!decodeRvl(reader.take(reader.left()), depth_mm, size_t{width} * height)) failRos("RVL");
}

}  // namespace

ImageSize rosImageSize(const RosCompressedImage &image) {
  ByteReader reader(image.data);
  if (isCompressedDepth(image.format)) reader.take(kCompressedDepthHeadBytes);
  if (image.format.find("rvl") != std::string_view::npos) {
    const uint32_t width = reader.little<uint32_t>(), height = reader.little<uint32_t>();
    return reader.ok() ? ImageSize{width, height} : ImageSize{0, 0};
  }
  const ByteView data = reader.take(reader.left());
  try {
    return imageSizeOf(data, compressedTypeOf(data));
  } catch (const Failure &) {
    return {0, 0};
  }
}

bool isRos16Bit(std::string_view format) {
  return format.substr(0, 5) == "16UC1" || format.substr(0, 6) == "mono16";
}

bool isCompressedDepth(std::string_view format) { return format.find("compressedDepth") != std::string_view::npos; }

bool isReadRosColor(std::string_view encoding) { return rawColorOf(encoding) != nullptr; }

uint16_t millimetresOf(float depth_m) {
  const float depth_mm = std::round(depth_m * 1000.0f);
  return depth_mm >= 1.0f && depth_mm <= 65535.0f ? static_cast<uint16_t>(depth_mm) : uint16_t{0};
}

void decodeRosColor(const RosMessage &message, bool is_compressed, const sphc_camera &camera, sphc_format format,
                    uint8_t *pixels) {
  if (!is_compressed) return decodeRawColor(rawImage(message, camera, true), format, pixels);
  const RosCompressedImage image = compressedImage(message);
  decodeImage(image.data, compressedTypeOf(image.data), camera, format, pixels);
}

void decodeRosDepth(const RosMessage &message, bool is_compressed, const sphc_camera &camera, uint16_t *depth_mm) {
  if (!is_compressed) return decodeRawDepth(rawImage(message, camera, false), depth_mm);
  const RosCompressedImage image = compressedImage(message);
  if (!isRos16Bit(image.format))
    failEncoding(image.format, "compressed depth is read where it was 16UC1 or mono16: record the raw topic");
  ByteReader reader(image.data);
  if (isCompressedDepth(image.format)) reader.take(kCompressedDepthHeadBytes);
  if (!reader.ok()) failRos("its head");
  const ByteView data = reader.take(reader.left());
  if (image.format.find("rvl") != std::string_view::npos) return decodeRvlDepth(data, camera, depth_mm);
  decodeImage(data, ImageType::kPng, camera, SPHC_FORMAT_DEPTH16, reinterpret_cast<uint8_t *>(depth_mm));
}

}  // namespace sphc::recording
