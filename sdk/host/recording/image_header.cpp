#include "image_header.h"

#include <filesystem>
#include <string_view>

#include "failure.h"

namespace sphc::recording {

namespace {

using namespace std::string_view_literals;

[[noreturn]] void failType(const char *type) {
  throw Failure(SPHC_E_DEVICE, std::string("cannot be decoded: is no ") + type +
                                   ", as its name or message says; remove the frame or copy the file again");
}

uint32_t bigEndian(ByteView bytes) {
  uint32_t value = 0;
  for (size_t i = 0; i < bytes.size; ++i) value = value << 8 | bytes.data[i];
  return value;
}

// Signature, then the chunk IHDR, which comes first.
bool readPngSize(ByteView file, ImageSize &size) {
  ByteReader reader(file);
  if (textOf(reader.take(16)) != "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR"sv) return false;
  size.width = bigEndian(reader.take(4));
  size.height = bigEndian(reader.take(4));
  return reader.ok();
}

bool isFrameHeader(uint8_t marker) {  // SOF0 to SOF15; C4, C8 and CC mean something else
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// Segments of a marker and a length, up to the frame's header.
bool readJpegSize(ByteView file, ImageSize &size) {
  ByteReader reader(file);
  if (bigEndian(reader.take(2)) != 0xFFD8) return false;
  while (reader.ok()) {
    if (bigEndian(reader.take(1)) != 0xFF) return false;
    uint32_t marker = 0xFF;
    while (marker == 0xFF && reader.ok()) marker = bigEndian(reader.take(1));  // fill bytes
    const uint32_t bytes = bigEndian(reader.take(2));
    if (bytes < 2) return false;
    ByteReader segment(reader.take(bytes - 2));
    if (!isFrameHeader(static_cast<uint8_t>(marker))) continue;
    segment.take(1);  // bits a sample
    size.height = bigEndian(segment.take(2));
    size.width = bigEndian(segment.take(2));
    return segment.ok();
  }
  return false;
}

}  // namespace

ImageType imageTypeOf(const std::string &file) {
  std::string ending = std::filesystem::path(file).extension().string();
  for (char &c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (ending == ".png") return ImageType::kPng;
  if (ending == ".jpg" || ending == ".jpeg") return ImageType::kJpeg;
  throw Failure(SPHC_E_IMAGE, "is no .png, .jpg or .jpeg; convert it to PNG");
}

std::optional<ImageType> imageTypeOf(ByteView file) {
  if (file.size == 0) return std::nullopt;
  if (file.data[0] == 0x89) return ImageType::kPng;
  return file.data[0] == 0xFF ? std::optional(ImageType::kJpeg) : std::nullopt;
}

ImageSize imageSizeOf(ByteView file, ImageType type) {
  ImageSize size = {};
  if (type == ImageType::kPng && !readPngSize(file, size)) failType("PNG");
  if (type == ImageType::kJpeg && !readJpegSize(file, size)) failType("JPEG");
  return size;
}

}  // namespace sphc::recording
