// What the first bytes of an image file say, read before a decoder sees any of it.
#pragma once

#include <optional>
#include <string>

#include "host/recording/mcap/bytes.h"

namespace sphc::recording {

enum class ImageType { kPng, kJpeg };

// By the name's ending, .png, .jpg or .jpeg; throws Failure (IMAGE) without the name for another.
ImageType imageTypeOf(const std::string &file);
// By the first byte, which is another in every other type.
std::optional<ImageType> imageTypeOf(ByteView file);

struct ImageSize {
  uint32_t width, height;
};
// Throws Failure (DEVICE) without a name when the bytes do not begin as an image of this type.
ImageSize imageSizeOf(ByteView file, ImageType type);

}  // namespace sphc::recording
