#include "host/recording/foreign/r3d_depth.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "host/recording/encoded_image.h"
#include "host/recording/failure.h"
#include "host/recording/foreign/lzfse_bytes.h"
#include "host/recording/foreign/ros_images.h"

namespace sphc::recording {

namespace {

constexpr double kMostPixels = 1 << 24;  // a hundred times what any phone's sensor has

size_t pixelsOf(const sphc_camera &camera) { return size_t{camera.width} * camera.height; }

float floatAt(const uint8_t *bytes) {
  const uint32_t bits = loadLittle<uint32_t>(bytes);
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void requirePixels(size_t count, const sphc_camera &camera) {
  if (count == pixelsOf(camera)) return;
  throw Failure(SPHC_E_IMAGE, "has " + std::to_string(count) + " pixels, the calibration's depth_camera " +
                                  sizeText(camera.width, camera.height) + "; use this recording's calibration");
}

// Of whole numbers; 0 x 0 where there is none.
ImageSize sizeOfShape(double pixels, double shape) {
  const double width = std::round(std::sqrt(pixels * shape)), height = std::round(std::sqrt(pixels / shape));
  if (width * height != pixels) return {0, 0};
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

}  // namespace

ImageSize r3dDepthSizeOf(ByteView file, const Record3dMetadata &metadata) {
  const double most_pixels = std::min(metadata.width * metadata.height, kMostPixels);
  Bytes floats;
  decodeLzfse(file, sizeof(float) * static_cast<size_t>(most_pixels), floats);
  const double pixels = static_cast<double>(floats.size()) / sizeof(float);
  const double shape = metadata.depth_width > 0 && metadata.depth_height > 0
                           ? metadata.depth_width / metadata.depth_height
                           : metadata.width / metadata.height;
  const ImageSize size = sizeOfShape(pixels, shape);
  if (size.width == 0)
    throw Failure(SPHC_E_DEVICE, "its " + std::to_string(floats.size()) +
                                     " bytes are no image of the shape that the metadata tells; copy it again");
  return size;
}

void decodeR3dDepth(ByteView file, const sphc_camera &camera, uint16_t *depth_mm) {
  Bytes floats;
  decodeLzfse(file, sizeof(float) * pixelsOf(camera), floats);
  requirePixels(floats.size() / sizeof(float), camera);
  for (size_t i = 0; i < pixelsOf(camera); ++i)
    depth_mm[i] = millimetresOf(floatAt(floats.data() + sizeof(float) * i));
}

void decodeR3dConfidence(ByteView file, const sphc_camera &camera, Bytes &confidence) {
  decodeLzfse(file, pixelsOf(camera), confidence);
  requirePixels(confidence.size(), camera);
}

}  // namespace sphc::recording
