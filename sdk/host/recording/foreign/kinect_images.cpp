#include "host/recording/foreign/kinect_images.h"

#include <opencv2/imgproc.hpp>

#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"
#include "host/recording/foreign/opaque_pixels.h"

namespace sphc::recording {

namespace {

constexpr uint64_t kMostImageBytes = uint64_t{1} << 28;

[[noreturn]] void failImage(const char *what) {
  throw Failure(SPHC_E_DEVICE,
                std::string("is no image of the recording's size (") + what + "); copy the file again");
}

void requireBytes(const Bytes &stored, uint64_t wanted) {
  if (stored.size() != wanted) failImage("it has more or fewer bytes");
}

// Through OpenCV: of two bytes a pixel, or of one and a half.
void decodeYuv(const Bytes &stored, bool is_nv12, const sphc_camera &camera, sphc_format format, uint8_t *pixels) {
  const int width = static_cast<int>(camera.width), height = static_cast<int>(camera.height);
  if (width % 2 != 0 || (is_nv12 && height % 2 != 0)) failImage("its sides are odd");
  requireBytes(stored, uint64_t{camera.width} * camera.height * (is_nv12 ? 3 : 4) / 2);
  const cv::Mat yuv(is_nv12 ? height * 3 / 2 : height, width, is_nv12 ? CV_8UC1 : CV_8UC2,
                    const_cast<uint8_t *>(stored.data()));
  cv::Mat bgr;
  cv::cvtColor(yuv, bgr, is_nv12 ? cv::COLOR_YUV2BGR_NV12 : cv::COLOR_YUV2BGR_YUY2);
  packPixels({bgr.data, camera.width, camera.height, camera.width * 3, SPHC_FORMAT_BGR8}, format, pixels);
}

void decodeBgra(const Bytes &stored, const sphc_camera &camera, sphc_format format, uint8_t *pixels) {
  requireBytes(stored, uint64_t{camera.width} * camera.height * 4);
  packOpaque(stored.data(), camera.width, camera.height, camera.width * 4, SPHC_FORMAT_BGR8, format, pixels);
}

// b16g, which is big-endian: depth and infrared.
void decodeNumbers(const Bytes &stored, const sphc_camera &camera, uint16_t *numbers) {
  const size_t count = size_t{camera.width} * camera.height;
  requireBytes(stored, 2 * count);
  for (size_t i = 0; i < count; ++i) numbers[i] = static_cast<uint16_t>(stored[2 * i] << 8 | stored[2 * i + 1]);
}

}  // namespace

void KinectImages::read(sphc_stream stream, const RecordedImage &image, const sphc_camera &camera,
                        sphc_format format, uint8_t *pixels) {
  load(image.place);
  const bool is_color = stream == SPHC_STREAM_COLOR;
  const host::ImageSize size = is_color ? color_size_ : depth_size_;
  requireSize(size.width, size.height, camera, is_color);
  if (!is_color) return decodeNumbers(stored_, camera, reinterpret_cast<uint16_t *>(pixels));
  switch (color_) {
    case KinectColor::kMjpg:
      return decodeImage(viewOf(stored_), ImageType::kJpeg, camera, format, pixels);
    case KinectColor::kNv12:
      return decodeYuv(stored_, true, camera, format, pixels);
    case KinectColor::kYuy2:
      return decodeYuv(stored_, false, camera, format, pixels);
    case KinectColor::kBgra:
      return decodeBgra(stored_, camera, format, pixels);
  }
}

void KinectImages::readAmplitude(const RecordedImage &depth, const sphc_camera &camera, uint16_t *pixels) {
  load(depth.amplitude);
  decodeNumbers(stored_, camera, pixels);
}

void KinectImages::load(const MessagePlace &place) {
  if (place.bytes > kMostImageBytes) failImage("it is too long");
  stored_.resize(place.bytes);
  file_.read(place.start, stored_.data(), stored_.size());
}

}  // namespace sphc::recording
