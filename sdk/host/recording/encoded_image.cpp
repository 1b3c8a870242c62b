#include "encoded_image.h"

#include <algorithm>
#include <string>

#include "failure.h"
#include "host/images/jpeg.h"
#include "host/images/png_decode.h"
#include "host/images/png_encode.h"

namespace sphc::recording {

namespace {

// libjpeg fills what a cut file lacks with grey and is content, libpng does without the end chunk: look for the end
// mark.  Some cameras write a little behind it.
bool isCut(ByteView file, ImageType type) {
  constexpr size_t kTail = 1024;
  const std::string end = type == ImageType::kPng ? "IEND" : "\xff\xd9";
  const uint8_t *const last = file.data + file.size;
  const auto same = [](uint8_t byte, char c) { return byte == static_cast<uint8_t>(c); };
  return std::search(last - std::min(kTail, file.size), last, end.begin(), end.end(), same) == last;
}

// Whether the image is of the kind that the room's format wants; throws when it is cut or damaged.
bool decodeWhole(ByteView encoded, ImageType type, const host::ImageRoom &room) {
  if (isCut(encoded, type)) throw Failure(SPHC_E_DEVICE, "is cut short; remove the frame or copy the file again");
  const auto decode = type == ImageType::kPng ? host::decodePng : host::decodeJpeg;
  const host::Decoded decoded = decode(encoded.data, encoded.size, room);
  if (decoded == host::Decoded::kDamaged)
    throw Failure(SPHC_E_DEVICE, "cannot be decoded; remove the frame or copy the file again");
  return decoded == host::Decoded::kWhole;
}

}  // namespace

void requireSize(uint32_t width, uint32_t height, const sphc_camera &camera, bool is_color) {
  if (width == camera.width && height == camera.height) return;
  throw Failure(SPHC_E_IMAGE, "is " + sizeText(width, height) + ", the calibration's " +
                                  (is_color ? "color_camera " : "depth_camera ") +
                                  sizeText(camera.width, camera.height) + "; use this recording's calibration");
}

void decodeImage(ByteView encoded, ImageType type, const sphc_camera &camera, sphc_format format, uint8_t *pixels) {
  const bool is_color = format != SPHC_FORMAT_DEPTH16;
  const ImageSize size = imageSizeOf(encoded, type);
  requireSize(size.width, size.height, camera, is_color);
  if (decodeWhole(encoded, type, {pixels, size.width, size.height, format})) return;
  throw Failure(SPHC_E_IMAGE, is_color ? "has the colours of print, CMYK; convert it to RGB"
                                       : "is not a single-channel 16-bit PNG, as depth must be; convert it");
}

void decodeFourChannels(ByteView png, const ImageSize &size, uint8_t *pixels) {
  const ImageSize told = imageSizeOf(png, ImageType::kPng);
  if (told.width != size.width || told.height != size.height ||
      !decodeWhole(png, ImageType::kPng, {pixels, size.width, size.height, SPHC_FORMAT_BGRA8}))
    throw Failure(SPHC_E_DEVICE, "is no PNG image of " + sizeText(size.width, size.height) +
                                     " and four channels of 8 bits; remove the frame or copy the file again");
}

ByteView ImageEncoder::png(const sphc_image &image) {
  if (!host::encodePng(image, &encoded_)) throw Failure(SPHC_E_INTERNAL, "an image cannot be encoded as .png");
  return viewOf(encoded_);
}

ByteView ImageEncoder::jpeg(const sphc_image &image, uint32_t quality) {
  if (!host::encodeJpeg(image, quality, &encoded_))
    throw Failure(SPHC_E_INTERNAL, "an image cannot be encoded as .jpg");
  return viewOf(encoded_);
}

}  // namespace sphc::recording
