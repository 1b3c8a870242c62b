#include "host/images/png_encode.h"

#include <spng.h>
#include <zlib.h>

#include <cstdlib>
#include <memory>

#include "host/images/channels.h"
#include "host/images/png_context.h"

namespace sphc::host {
namespace {

struct FreeBytes {
  void operator()(void *bytes) const { std::free(bytes); }
};

spng_ihdr headerOf(const sphc_image &image) {
  const bool is_color = image.format == SPHC_FORMAT_RGB8 || image.format == SPHC_FORMAT_BGR8;
  spng_ihdr header = {};
  header.width = image.width;
  header.height = image.height;
  header.bit_depth = image.format == SPHC_FORMAT_DEPTH16 ? 16 : 8;
  header.color_type = is_color ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_GRAYSCALE;
  return header;
}

struct Compression {
  int strategy, filter;
};

// Of the fastest level.  Colours go by differences to the pixel before, whose zeros run; depth repeats what it had.
Compression compressionFor(sphc_format format) {
  if (format == SPHC_FORMAT_DEPTH16) return {Z_DEFAULT_STRATEGY, SPNG_DISABLE_FILTERING};
  return {Z_RLE, SPNG_FILTER_CHOICE_SUB};
}

bool begin(spng_ctx *context, const sphc_image &image) {
  spng_ihdr header = headerOf(image);
  const Compression compression = compressionFor(image.format);
  return spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1) == SPNG_OK &&
         spng_set_option(context, SPNG_IMG_COMPRESSION_LEVEL, Z_BEST_SPEED) == SPNG_OK &&
         spng_set_option(context, SPNG_IMG_COMPRESSION_STRATEGY, compression.strategy) == SPNG_OK &&
         spng_set_option(context, SPNG_FILTER_CHOICE, compression.filter) == SPNG_OK &&
         spng_set_ihdr(context, &header) == SPNG_OK &&
         spng_encode_image(context, nullptr, 0, SPNG_FMT_PNG, SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE) ==
             SPNG_OK;
}

bool encodeRows(spng_ctx *context, const sphc_image &image) {
  const size_t row_bytes = size_t{image.width} * sphc_format_bytes(image.format);
  const auto *row = static_cast<const uint8_t *>(image.data);
  std::vector<uint8_t> rgb;
  int result = SPNG_OK;
  for (uint32_t y = 0; y < image.height && result == SPNG_OK; ++y, row += image.stride_bytes) {
    if (image.format == SPHC_FORMAT_BGR8) {
      rgb.assign(row, row + row_bytes);
      swapRedAndBlue(rgb.data(), image.width, 3);
    }
    result = spng_encode_row(context, rgb.empty() ? row : rgb.data(), row_bytes);
  }
  return result == SPNG_EOI;
}

}  // namespace

bool encodePng(const sphc_image &image, std::vector<uint8_t> *png) {
  if (image.format != SPHC_FORMAT_GRAY8 && image.format != SPHC_FORMAT_RGB8 && image.format != SPHC_FORMAT_BGR8 &&
      image.format != SPHC_FORMAT_DEPTH16)
    return false;
  const PngContext context(spng_ctx_new(SPNG_CTX_ENCODER));
  if (!context || !begin(context.get(), image) || !encodeRows(context.get(), image)) return false;
  size_t bytes = 0;
  int error = SPNG_OK;
  const std::unique_ptr<void, FreeBytes> made(spng_get_png_buffer(context.get(), &bytes, &error));
  if (!made) return false;
  const auto *first = static_cast<const uint8_t *>(made.get());
  png->assign(first, first + bytes);
  return true;
}

}  // namespace sphc::host
