#include "host/images/png_decode.h"

#include <spng.h>

#include <new>
#include <vector>

#include "host/images/channels.h"
#include "host/images/png_context.h"

namespace sphc::host {
namespace {

constexpr size_t kMostBesidePixels = 8 << 20;  // bytes of texts, profiles and the like, as libpng has it

// To the file's last chunk, for the checksums.
bool readAll(spng_ctx *context, spng_format format, void *pixels, size_t bytes) {
  return spng_decode_image(context, pixels, bytes, format, 0) == SPNG_OK && spng_decode_chunks(context) == SPNG_OK;
}

bool hasColors(const spng_ihdr &header) {
  return header.color_type == SPNG_COLOR_TYPE_TRUECOLOR || header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
}

// Whether the file has what the format wants.
bool isOfKind(const spng_ihdr &header, sphc_format format) {
  switch (format) {
    case SPHC_FORMAT_GRAY8:
    case SPHC_FORMAT_RGB8:
    case SPHC_FORMAT_BGR8:
      return true;
    case SPHC_FORMAT_BGRA8:
      return header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA && header.bit_depth == 8;
    case SPHC_FORMAT_DEPTH16:
      return header.color_type == SPNG_COLOR_TYPE_GRAYSCALE && header.bit_depth == 16;
    default:
      return false;
  }
}

// Weighted before the lower bits go.
bool readGrayOfDeepColors(spng_ctx *context, uint8_t *gray, size_t count) {
  std::vector<uint16_t> rgba(4 * count);
  if (!readAll(context, SPNG_FMT_RGBA16, rgba.data(), 8 * count)) return false;
  const uint16_t *pixel = rgba.data();
  for (size_t i = 0; i < count; ++i, pixel += 4)
    gray[i] = static_cast<uint8_t>((weightedGray(pixel[0], pixel[1], pixel[2]) + (1 << 14)) >> 23);
  return true;
}

bool readGray(spng_ctx *context, const spng_ihdr &header, uint8_t *gray, size_t count) {
  if (header.color_type == SPNG_COLOR_TYPE_GRAYSCALE && header.bit_depth <= 8)
    return readAll(context, SPNG_FMT_G8, gray, count);
  if (hasColors(header) && header.bit_depth == 16) return readGrayOfDeepColors(context, gray, count);
  std::vector<uint8_t> rgb(3 * count);
  if (!readAll(context, SPNG_FMT_RGB8, rgb.data(), rgb.size())) return false;
  const uint8_t *pixel = rgb.data();
  for (size_t i = 0; i < count; ++i, pixel += 3) gray[i] = grayOf(pixel[0], pixel[1], pixel[2]);
  return true;
}

bool readPixels(spng_ctx *context, const spng_ihdr &header, const ImageRoom &room) {
  const size_t count = size_t{room.width} * room.height;
  if (room.format == SPHC_FORMAT_GRAY8) return readGray(context, header, room.pixels, count);
  if (room.format == SPHC_FORMAT_DEPTH16) return readAll(context, SPNG_FMT_PNG, room.pixels, 2 * count);
  const size_t channels = room.format == SPHC_FORMAT_BGRA8 ? 4 : 3;
  if (!readAll(context, channels == 4 ? SPNG_FMT_RGBA8 : SPNG_FMT_RGB8, room.pixels, channels * count))
    return false;
  if (room.format != SPHC_FORMAT_RGB8) swapRedAndBlue(room.pixels, count, channels);
  return true;
}

}  // namespace

Decoded decodePng(const uint8_t *png, size_t bytes, const ImageRoom &room) {
  const PngContext context(spng_ctx_new(0));
  if (!context) throw std::bad_alloc();
  spng_ihdr header = {};
  if (spng_set_image_limits(context.get(), room.width, room.height) != SPNG_OK ||
      spng_set_chunk_limits(context.get(), bytes, kMostBesidePixels) != SPNG_OK ||
      spng_set_png_buffer(context.get(), png, bytes) != SPNG_OK ||
      spng_get_ihdr(context.get(), &header) != SPNG_OK || header.width != room.width ||
      header.height != room.height)
    return Decoded::kDamaged;
  if (!isOfKind(header, room.format)) return Decoded::kOfAnotherKind;
  return readPixels(context.get(), header, room) ? Decoded::kWhole : Decoded::kDamaged;
}

}  // namespace sphc::host
