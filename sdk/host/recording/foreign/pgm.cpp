#include "host/recording/foreign/pgm.h"

#include <spherecloud/spherecloud.h>

#include <string_view>

#include "host/recording/failure.h"
#include "host/recording/text_field.h"

namespace sphc::recording {

namespace {

struct PgmHead {
  ImageSize size;
  size_t bytes;
};

// "P5", width, height and the largest value, with space between them and one more byte behind.
PgmHead headOfPgm(ByteView file) {
  constexpr size_t kMostHeadBytes = 64;
  const std::string_view all = textOf(file);
  std::string_view rest = all.substr(0, kMostHeadBytes);
  PgmHead head = {};
  uint32_t most = 0;
  const bool is_pgm = takeWord(rest) == "P5" && parseUnsigned(takeWord(rest), head.size.width) &&
                      parseUnsigned(takeWord(rest), head.size.height) && parseUnsigned(takeWord(rest), most);
  const bool has_size = head.size.width > 0 && head.size.height > 0 && head.size.width <= SPHC_CAMERA_MAX_PX &&
                        head.size.height <= SPHC_CAMERA_MAX_PX;
  if (!is_pgm || !has_size || most <= 255 || most > 65535 || rest.empty())
    throw Failure(SPHC_E_DEVICE, "is no PGM image of 16 bits; copy the file again");
  head.bytes = static_cast<size_t>(rest.data() - all.data()) + 1;
  if ((file.size - head.bytes) / 2 < size_t{head.size.width} * head.size.height)
    throw Failure(SPHC_E_DEVICE, "is cut short; remove the frame or copy the file again");
  return head;
}

}  // namespace

ImageSize pgmSizeOf(ByteView file) { return headOfPgm(file).size; }

void decodePgm(ByteView file, uint16_t *pixels) {
  const PgmHead head = headOfPgm(file);
  const uint8_t *at = file.data + head.bytes;
  const size_t count = size_t{head.size.width} * head.size.height;
  for (size_t i = 0; i < count; ++i, at += 2) pixels[i] = static_cast<uint16_t>(at[0] << 8 | at[1]);
}

}  // namespace sphc::recording
