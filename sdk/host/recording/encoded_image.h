// The bytes of PNG and JPEG files: made, and decoded into memory that is there already.
#pragma once

#include "image_header.h"
#include "pixels.h"

namespace sphc::recording {

// Fills `pixels` with an image of the camera's size: DEPTH16, or colour in `format`.  Throws Failure without a
// name: DEVICE when the bytes are of another type, corrupt or cut, IMAGE when the image does not fit the
// calibration or has the colours of print. Type and size are read from the header first: nothing larger than the
// camera's image is ever decoded.
void decodeImage(ByteView encoded, ImageType type, const sphc_camera &camera, sphc_format format, uint8_t *pixels);

// The same of a PNG image of this size that has four channels of 8 bits: blue, green, red, and a fourth.
void decodeFourChannels(ByteView png, const ImageSize &size, uint8_t *pixels);

class ImageEncoder {
 public:
  // The image was checked.  Valid until the next call; throws Failure.
  ByteView png(const sphc_image &image);  // of fast compression
  ByteView jpeg(const sphc_image &image, uint32_t quality);

 private:
  Bytes encoded_;
};

// IMAGE unless the size is the camera's.
void requireSize(uint32_t width, uint32_t height, const sphc_camera &camera, bool is_color);

}  // namespace sphc::recording
