#include "pixels.h"

#include <cstring>

#include "failure.h"
#include "host/images/channels.h"

namespace sphc::recording {

namespace {

void convertRow(const uint8_t *in, sphc_format from, uint8_t *out, sphc_format to, uint32_t width) {
  if (from == SPHC_FORMAT_GRAY8) {
    for (uint32_t x = 0; x < width; ++x) std::memset(out + 3 * x, in[x], 3);
  } else if (to == SPHC_FORMAT_GRAY8) {
    const uint32_t red = from == SPHC_FORMAT_RGB8 ? 0 : 2;
    for (uint32_t x = 0; x < width; ++x, in += 3) out[x] = host::grayOf(in[red], in[1], in[2 - red]);
  } else {
    for (uint32_t x = 0; x < width; ++x, in += 3, out += 3) {
      out[0] = in[2];
      out[1] = in[1];
      out[2] = in[0];
    }
  }
}

}  // namespace

bool isRecorded(sphc_format format) {
  return format == SPHC_FORMAT_GRAY8 || format == SPHC_FORMAT_RGB8 || format == SPHC_FORMAT_BGR8 ||
         format == SPHC_FORMAT_DEPTH16;
}

size_t packedBytes(const sphc_image &image) {
  return size_t{image.width} * image.height * sphc_format_bytes(image.format);
}

std::string sizeText(uint32_t width, uint32_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

void checkImage(const sphc_image &image, const sphc_camera &camera, bool is_color) {
  const std::string name = is_color ? "colour image" : "depth image";
  const bool is_depth_format = image.format == SPHC_FORMAT_DEPTH16;
  if (!image.data) throw Failure(SPHC_E_IMAGE, name + ": data is null; give the pixels");
  if (!isRecorded(image.format) || is_depth_format == is_color)
    throw Failure(SPHC_E_IMAGE, name + ": format " + std::to_string(image.format) + " does not fit; " +
                                    (is_color ? "give GRAY8, RGB8 or BGR8" : "give DEPTH16"));
  if (image.width != camera.width || image.height != camera.height)
    throw Failure(SPHC_E_IMAGE, name + ": is " + sizeText(image.width, image.height) +
                                    ", its camera in the calibration " + sizeText(camera.width, camera.height) +
                                    "; they must be equal");
  const uint64_t row_bytes = uint64_t{image.width} * sphc_format_bytes(image.format);
  if (image.stride_bytes < row_bytes || (is_depth_format && image.stride_bytes % 2 != 0))
    throw Failure(SPHC_E_IMAGE, name + ": stride_bytes " + std::to_string(image.stride_bytes) +
                                    " is less than a row or odd; give the bytes from row to row");
}

void checkAmplitude(const sphc_image &image, const sphc_camera &depth_camera) {
  const sphc_format f = image.format;
  if (f != SPHC_FORMAT_GRAY8 && f != SPHC_FORMAT_GRAY10 && f != SPHC_FORMAT_GRAY12 && f != SPHC_FORMAT_GRAY16)
    throw Failure(SPHC_E_IMAGE, "amplitude image: format " + std::to_string(f) +
                                    " does not fit; give GRAY8, GRAY10, GRAY12 or GRAY16");
  if (image.width != depth_camera.width || image.height != depth_camera.height)
    throw Failure(SPHC_E_IMAGE, "amplitude image: is " + sizeText(image.width, image.height) +
                                    ", the depth camera in the calibration " +
                                    sizeText(depth_camera.width, depth_camera.height) + "; they must be equal");
  if (image.stride_bytes < uint64_t{image.width} * sphc_format_bytes(f))
    throw Failure(SPHC_E_IMAGE, "amplitude image: stride_bytes " + std::to_string(image.stride_bytes) +
                                    " is less than a row; give the bytes from row to row");
}

void packAmplitude(const sphc_image &image, uint16_t *out) {
  const uint32_t pixel_bytes = sphc_format_bytes(image.format);
  for (uint32_t y = 0; y < image.height; ++y) {
    const uint8_t *in = static_cast<const uint8_t *>(image.data) + size_t{y} * image.stride_bytes;
    for (uint32_t x = 0; x < image.width; ++x, in += pixel_bytes)
      *out++ = static_cast<uint16_t>(pixel_bytes == 1 ? in[0] : in[0] | in[1] << 8);
  }
}

void packPixels(const sphc_image &image, sphc_format to, uint8_t *out) {
  const size_t row_bytes = size_t{image.width} * sphc_format_bytes(to);
  const auto *row = static_cast<const uint8_t *>(image.data);
  for (uint32_t y = 0; y < image.height; ++y, row += image.stride_bytes, out += row_bytes) {
    if (image.format == to)
      std::memcpy(out, row, row_bytes);
    else
      convertRow(row, image.format, out, to, image.width);
  }
}

}  // namespace sphc::recording
