#include "host/import/colmap_images.h"

#include <filesystem>
#include <optional>
#include <stdexcept>

#include "host/base/regular_file.h"
#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"
#include "host/recording/file_reader.h"
#include "host/recording/image_header.h"
#include "host/recording/pixels.h"

namespace sphc::host {
namespace {

using recording::ImageSize;
using recording::ImageType;
using recording::viewOf;

recording::Bytes readEncoded(const std::string &path) {
  constexpr size_t kMostBytes = size_t{1} << 30;
  recording::Bytes encoded;
  recording::readFile(path, kMostBytes, encoded);
  return encoded;
}

bool isOfSize(const ImageSize &size, const sphc_camera &camera) {
  return size.width == camera.width && size.height == camera.height;
}

cv::Mat decoded(const recording::Bytes &encoded, ImageType type, const sphc_camera &camera, sphc_format format) {
  cv::Mat image(static_cast<int>(camera.height), static_cast<int>(camera.width),
                format == SPHC_FORMAT_DEPTH16 ? CV_16UC1 : CV_8UC1);
  recording::decodeImage(viewOf(encoded), type, camera, format, image.data);
  return image;
}

}  // namespace

cv::Mat readColmapPhoto(const std::string &path, const sphc_camera &camera) try {
  checkIsFile(path, "COLMAP's folder of images");
  if (!std::filesystem::exists(path))
    throw std::runtime_error("cannot read the image " + path + "; name COLMAP's folder of images");
  const recording::Bytes encoded = readEncoded(path);
  const std::optional<ImageType> type = recording::imageTypeOf(viewOf(encoded));
  if (!type) throw std::runtime_error("the image " + path + " is neither PNG nor JPEG; convert it to one of them");
  const ImageSize size = recording::imageSizeOf(viewOf(encoded), *type);
  if (!isOfSize(size, camera))
    throw std::runtime_error("the image " + path + " is " + recording::sizeText(size.width, size.height) +
                             ", its camera " + recording::sizeText(camera.width, camera.height) +
                             "; name the images that COLMAP saw");
  return decoded(encoded, *type, camera, SPHC_FORMAT_GRAY8);
} catch (const recording::Failure &failure) {
  throw std::runtime_error("the image " + path + " " + failure.what());
}

cv::Mat readColmapDepth(const std::string &path, const sphc_camera &camera) try {
  checkIsFile(path, "a folder of depth images");
  const recording::Bytes encoded = readEncoded(path);
  if (isOfSize(recording::imageSizeOf(viewOf(encoded), ImageType::kPng), camera))
    return decoded(encoded, ImageType::kPng, camera, SPHC_FORMAT_DEPTH16);
  throw recording::Failure(SPHC_E_IMAGE, "is of another size");
} catch (const recording::Failure &failure) {
  if (failure.status() != SPHC_E_IMAGE) throw std::runtime_error("the depth image " + path + " " + failure.what());
  throw std::runtime_error("the depth image " + path + " is not one of 16 bits and " +
                           recording::sizeText(camera.width, camera.height) +
                           "; where depth has a camera of its own, say so with --calibration");
}

}  // namespace sphc::host
