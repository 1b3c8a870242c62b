#include "image_file.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "failure.h"

namespace sphc::replay {

namespace {

std::string nameOf(sphc_stream stream, const RecordedImage &image) {
  return shortPath(image.file) + " (" + (stream == SPHC_STREAM_COLOR ? "colour " : "depth ") +
         std::to_string(image.sequence) + ")";
}

std::string sizeText(uint32_t width, uint32_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

// libjpeg fills what a cut file lacks with grey and is content, libpng does without the end chunk: look for the end
// mark.  Some cameras write a little behind it.
bool isCut(const std::vector<uint8_t> &file, const std::string &start, const std::string &end) {
  constexpr ptrdiff_t kTail = 1024;
  if (file.size() < start.size() || std::memcmp(file.data(), start.data(), start.size()) != 0) return false;
  const auto tail = file.end() - std::min<ptrdiff_t>(kTail, static_cast<ptrdiff_t>(file.size()));
  const auto same = [](uint8_t byte, char c) { return byte == static_cast<uint8_t>(c); };
  return std::search(tail, file.end(), end.begin(), end.end(), same) == file.end();
}

bool isCutImage(const std::vector<uint8_t> &file) {
  return isCut(file, "\xff\xd8", "\xff\xd9") || isCut(file, "\x89PNG", "IEND");
}

int decodeFlags(sphc_stream stream, sphc_format color_format) {
  if (stream == SPHC_STREAM_DEPTH) return cv::IMREAD_UNCHANGED;
  return cv::IMREAD_IGNORE_ORIENTATION |
         (color_format == SPHC_FORMAT_GRAY8 ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR);
}

void swapRedAndBlue(uint8_t *pixels, size_t count) {
  for (size_t i = 0; i < count; ++i) std::swap(pixels[3 * i], pixels[3 * i + 2]);
}

}  // namespace

uint32_t bytesPerPixel(sphc_format format) {
  switch (format) {
    case SPHC_FORMAT_GRAY8:
      return 1;
    case SPHC_FORMAT_RGB8:
    case SPHC_FORMAT_BGR8:
      return 3;
    case SPHC_FORMAT_DEPTH16:
      return 2;
    default:
      return 0;
  }
}

ImageReader::ImageReader(const Recording &recording, const sphc_calibration &calibration, sphc_format color_format)
    : folder_(recording.folder),
      color_camera_(calibration.color_camera),
      depth_camera_(calibration.depth_camera),
      color_format_(color_format),
      invalid_is_65535_(recording.layout == SPHC_REPLAY_7SCENES) {}

size_t ImageReader::bytesOf(sphc_stream stream) const {
  const sphc_camera &camera = stream == SPHC_STREAM_COLOR ? color_camera_ : depth_camera_;
  const sphc_format format = stream == SPHC_STREAM_COLOR ? color_format_ : SPHC_FORMAT_DEPTH16;
  return size_t{camera.width} * camera.height * bytesPerPixel(format);
}

void ImageReader::load(const RecordedImage &image) {
  std::ifstream file(folder_ / image.file, std::ios::binary | std::ios::ate);
  const std::streamoff bytes = file ? static_cast<std::streamoff>(file.tellg()) : -1;
  if (bytes < 0) throw Failure(SPHC_E_DEVICE, "cannot be read; is it there?");
  constexpr std::streamoff kMostBytes = std::streamoff{1} << 30;
  if (bytes == 0) throw Failure(SPHC_E_DEVICE, "is empty; remove the frame or copy the file again");
  if (bytes > kMostBytes) throw Failure(SPHC_E_DEVICE, "is over 1 GiB: no image");
  encoded_.resize(static_cast<size_t>(bytes));
  file.seekg(0);
  if (!file.read(reinterpret_cast<char *>(encoded_.data()), bytes)) throw Failure(SPHC_E_DEVICE, "cannot be read");
}

void ImageReader::decode(sphc_stream stream, const RecordedImage &image, uint8_t *pixels) {
  load(image);
  if (isCutImage(encoded_)) throw Failure(SPHC_E_DEVICE, "is cut short; remove the frame or copy the file again");

  const bool is_color = stream == SPHC_STREAM_COLOR;
  const sphc_camera &camera = is_color ? color_camera_ : depth_camera_;
  const int type = !is_color ? CV_16UC1 : color_format_ == SPHC_FORMAT_GRAY8 ? CV_8UC1 : CV_8UC3;
  // A header over our memory: the decoder writes there when size and type are the expected ones.
  cv::Mat decoded(static_cast<int>(camera.height), static_cast<int>(camera.width), type, pixels);
  const cv::Mat encoded(1, static_cast<int>(encoded_.size()), CV_8UC1, encoded_.data());
  cv::imdecode(encoded, decodeFlags(stream, color_format_), &decoded);

  if (decoded.empty()) throw Failure(SPHC_E_DEVICE, "cannot be decoded; remove the frame or copy the file again");
  const uint32_t width = static_cast<uint32_t>(decoded.cols);
  const uint32_t height = static_cast<uint32_t>(decoded.rows);
  if (width != camera.width || height != camera.height)
    throw Failure(SPHC_E_IMAGE, "is " + sizeText(width, height) + ", the calibration's " +
                                    (is_color ? "color_camera " : "depth_camera ") +
                                    sizeText(camera.width, camera.height) + "; use this recording's calibration");
  if (decoded.type() != type) throw Failure(SPHC_E_IMAGE, "is not a single-channel 16-bit PNG, as depth must be");
  if (decoded.data != pixels) throw Failure(SPHC_E_INTERNAL, "was decoded elsewhere");
}

sphc_image ImageReader::read(sphc_stream stream, const RecordedImage &image, uint8_t *pixels) {
  try {
    decode(stream, image, pixels);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), nameOf(stream, image) + ": " + failure.what());
  } catch (const cv::Exception &) {
    throw Failure(SPHC_E_DEVICE, nameOf(stream, image) + ": cannot be decoded");
  }
  const bool is_color = stream == SPHC_STREAM_COLOR;
  const sphc_camera &camera = is_color ? color_camera_ : depth_camera_;
  const sphc_format format = is_color ? color_format_ : SPHC_FORMAT_DEPTH16;
  const size_t count = size_t{camera.width} * camera.height;
  if (format == SPHC_FORMAT_RGB8) swapRedAndBlue(pixels, count);
  if (!is_color && invalid_is_65535_) {
    uint16_t *depth = reinterpret_cast<uint16_t *>(pixels);
    std::replace(depth, depth + count, uint16_t{65535}, uint16_t{0});
  }
  return {pixels, camera.width, camera.height, camera.width * bytesPerPixel(format), format};
}

}  // namespace sphc::replay
