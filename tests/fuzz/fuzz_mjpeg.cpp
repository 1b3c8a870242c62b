#include "drivers/pixels/mjpeg.h"
#include "tests/fuzz/targets.h"
#include "tests/support/jpeg_frame.h"

namespace sphc::fuzz {
namespace {

constexpr uint32_t kWidth = 32, kHeight = 16;  // of the seeds
constexpr uint8_t kUntouched = 0xa5;

pixels::MjpegDecoder decoder;  // one for all frames, as in a driver

std::vector<uint8_t> decode(const std::vector<uint8_t> &frame, sphc_format format, sphc_status *status) {
  const uint32_t row_bytes = sphc_format_bytes(format) * kWidth, stride = row_bytes + 5;
  std::vector<uint8_t> image(stride * kHeight - 5, kUntouched);
  const pixels::OutImage out{image.data(), image.size(), kWidth, kHeight, stride, format};
  sphc_message message = {};
  *status = decoder.decode(frame.data(), frame.size(), out, &message);
  if (*status > 0 || (*status < 0) != (message.text[0] != '\0')) broken("a refusal explains itself");
  for (size_t i = 0; i < image.size(); ++i)
    if (i % stride >= row_bytes && image[i] != kUntouched) broken("the padding is not written to");
  return image;
}

}  // namespace

void mjpeg(const uint8_t *data, size_t bytes) {
  static const std::vector<uint8_t> good = test::jpegFrame(test::gradientRgb(kWidth, kHeight), kWidth, kHeight);
  static sphc_status status;
  static const std::vector<uint8_t> expected = decode(good, SPHC_FORMAT_RGB8, &status);
  const std::vector<uint8_t> frame(data, data + bytes);  // exactly sized
  for (const sphc_format format : {SPHC_FORMAT_GRAY8, SPHC_FORMAT_BGR8}) {
    decode(frame, format, &status);
    if (status == SPHC_OK) accept();
  }
  if (decode(good, SPHC_FORMAT_RGB8, &status) != expected || status != SPHC_OK)
    broken("a bad frame spoils no other");
}

}  // namespace sphc::fuzz
