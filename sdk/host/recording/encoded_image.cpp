#include "encoded_image.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "failure.h"

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

int decodeFlags(sphc_format format) {
  if (format == SPHC_FORMAT_DEPTH16) return cv::IMREAD_UNCHANGED;
  return cv::IMREAD_IGNORE_ORIENTATION | (format == SPHC_FORMAT_GRAY8 ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR);
}

int typeOf(sphc_format format) {
  if (format == SPHC_FORMAT_DEPTH16) return CV_16UC1;
  return format == SPHC_FORMAT_GRAY8 ? CV_8UC1 : CV_8UC3;
}

// Into what `decoded` is of, or elsewhere where size or type are others.
void decodeWhole(ByteView encoded, ImageType type, int flags, cv::Mat *decoded) {
  if (isCut(encoded, type)) throw Failure(SPHC_E_DEVICE, "is cut short; remove the frame or copy the file again");
  try {
    cv::imdecode(cv::Mat(1, static_cast<int>(encoded.size), CV_8UC1, const_cast<uint8_t *>(encoded.data)), flags,
                 decoded);
  } catch (const cv::Exception &) {
    decoded->release();
  }
  if (decoded->empty()) throw Failure(SPHC_E_DEVICE, "cannot be decoded; remove the frame or copy the file again");
}

void swapRedAndBlue(uint8_t *pixels, size_t count) {
  for (size_t i = 0; i < count; ++i) std::swap(pixels[3 * i], pixels[3 * i + 2]);
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
  // A header over our memory: the decoder writes there when size and type are the expected ones.
  cv::Mat decoded(static_cast<int>(camera.height), static_cast<int>(camera.width), typeOf(format), pixels);
  decodeWhole(encoded, type, decodeFlags(format), &decoded);
  requireSize(static_cast<uint32_t>(decoded.cols), static_cast<uint32_t>(decoded.rows), camera, is_color);
  if (decoded.type() != typeOf(format))
    throw Failure(SPHC_E_IMAGE, "is not a single-channel 16-bit PNG, as depth must be; convert it");
  if (decoded.data != pixels) throw Failure(SPHC_E_INTERNAL, "was decoded elsewhere; please report it");
  if (format == SPHC_FORMAT_RGB8) swapRedAndBlue(pixels, size_t{camera.width} * camera.height);
}

void decodeFourChannels(ByteView png, const ImageSize &size, uint8_t *pixels) {
  const ImageSize told = imageSizeOf(png, ImageType::kPng);
  cv::Mat decoded(static_cast<int>(size.height), static_cast<int>(size.width), CV_8UC4, pixels);
  if (told.width == size.width && told.height == size.height)
    decodeWhole(png, ImageType::kPng, cv::IMREAD_UNCHANGED, &decoded);
  else
    decoded.release();
  if (decoded.data != pixels)
    throw Failure(SPHC_E_DEVICE, "is no PNG image of " + sizeText(size.width, size.height) +
                                     " and four channels of 8 bits; remove the frame or copy the file again");
}

ByteView ImageEncoder::encode(const sphc_image &image, const char *extension, const std::vector<int> &options) {
  sphc_image given = image;
  if (image.format == SPHC_FORMAT_RGB8) {
    bgr_.resize(packedBytes(image));
    packPixels(image, SPHC_FORMAT_BGR8, bgr_.data());
    given = {bgr_.data(), image.width, image.height, image.width * 3, SPHC_FORMAT_BGR8};
  }
  const cv::Mat mat(static_cast<int>(given.height), static_cast<int>(given.width), typeOf(given.format),
                    const_cast<void *>(given.data), given.stride_bytes);
  if (!cv::imencode(extension, mat, encoded_, options))
    throw Failure(SPHC_E_INTERNAL, std::string("an image cannot be encoded as ") + extension);
  return viewOf(encoded_);
}

ByteView ImageEncoder::png(const sphc_image &image) {
  return encode(image, ".png", {cv::IMWRITE_PNG_COMPRESSION, 1});
}

ByteView ImageEncoder::jpeg(const sphc_image &image, uint32_t quality) {
  return encode(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, static_cast<int>(quality)});
}

}  // namespace sphc::recording
