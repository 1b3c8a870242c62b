#include "mjpeg.h"

#include <turbojpeg.h>

#include <cstring>
#include <initializer_list>

#include "explain.h"

namespace sphc::pixels {

namespace {

int turboFormat(sphc_format format) {
  return format == SPHC_FORMAT_GRAY8 ? TJPF_GRAY : format == SPHC_FORMAT_RGB8 ? TJPF_RGB : TJPF_BGR;
}

sphc_status explainTurbo(sphc_message *message, tjhandle handle, size_t bytes) {
  return explain(message, SPHC_E_IMAGE, "JPEG frame of %zu bytes: %s; the frame is left out", bytes,
                 tjGetErrorStr2(handle));
}

// After a bad header TurboJPEG goes on in its middle with the next frame; only tjDecompress2 starts anew, after it
// failed.
void forgetHeader(tjhandle handle) {
  const uint8_t no_jpeg = 0;
  uint8_t pixel = 0;
  tjDecompress2(handle, &no_jpeg, 1, &pixel, 1, 1, 1, TJPF_GRAY, 0);
}

// Cheap cameras pad a frame before its end mark, and the decoder complains when it looks for that mark.
bool isPadding(tjhandle handle) {
  return tjGetErrorCode(handle) == TJERR_WARNING &&
         std::strstr(tjGetErrorStr2(handle), "extraneous bytes before marker 0xd9") != nullptr;
}

}  // namespace

MjpegDecoder::MjpegDecoder() : handle_(tjInitDecompress()) {}

MjpegDecoder::~MjpegDecoder() {
  if (handle_) tjDestroy(handle_);
}

sphc_status MjpegDecoder::decode(const uint8_t *data, size_t bytes, const OutImage &out, sphc_message *message) {
  if (!handle_) return explain(message, SPHC_E_STATE, "JPEG decoder: was not made, memory ran out; free some");
  const sphc_status status = checkOut(out, message);
  if (status < 0) return status;
  if (out.format == SPHC_FORMAT_DEPTH16)
    return explain(message, SPHC_E_UNSUPPORTED, "JPEG is not of depth; give an output of GRAY8, RGB8 or BGR8");
  if (!data || bytes == 0)
    return explain(message, SPHC_E_IMAGE, "JPEG frame of %zu bytes: empty; take the next", bytes);

  int width = 0, height = 0, subsampling = 0, colorspace = 0;
  if (tjDecompressHeader3(handle_, data, bytes, &width, &height, &subsampling, &colorspace) != 0) {
    const sphc_status failed = explainTurbo(message, handle_, bytes);
    forgetHeader(handle_);
    return failed;
  }
  if (width != static_cast<int>(out.width) || height != static_cast<int>(out.height))
    return explain(message, SPHC_E_IMAGE, "JPEG frame of %d x %d pixels; %u x %u were negotiated", width, height,
                   out.width, out.height);
  // A warning means damage that the decoder papered over; a progressive frame may not keep it busy for ever.
  const int flags = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
  const size_t row_bytes = size_t{out.width} * sphc_format_bytes(out.format);
  uint8_t &last = out.data[size_t{out.stride_bytes} * (out.height - 1) + row_bytes - 1];
  // A progressive frame is read to its end before a row is written, and one with restart marks that was cut looks
  // padded too: the rest would be the last frame's.  So the last byte is marked; twice, for it may be like the
  // mark.
  for (const uint8_t mark : {uint8_t{0x5a}, uint8_t{0xa5}}) {
    last = mark;
    if (tjDecompress2(handle_, data, bytes, out.data, width, static_cast<int>(out.stride_bytes), height,
                      turboFormat(out.format), flags) == 0)
      return SPHC_OK;
    if (!isPadding(handle_)) break;
    if (last != mark) return SPHC_OK;
  }
  return explainTurbo(message, handle_, bytes);
}

}  // namespace sphc::pixels
