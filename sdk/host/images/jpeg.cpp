#include "host/images/jpeg.h"

#include <turbojpeg.h>

#include <initializer_list>
#include <memory>
#include <new>

namespace sphc::host {
namespace {

struct Destroy {
  void operator()(void *handle) const { tjDestroy(handle); }
};
using Handle = std::unique_ptr<void, Destroy>;

// TJPF_UNKNOWN for those that no JPEG has.
int turboFormat(sphc_format format) {
  if (format == SPHC_FORMAT_GRAY8) return TJPF_GRAY;
  if (format == SPHC_FORMAT_RGB8) return TJPF_RGB;
  return format == SPHC_FORMAT_BGR8 ? TJPF_BGR : TJPF_UNKNOWN;
}

// TurboJPEG says of a failure after a warning that it was a warning.  So the last byte is marked, which is written
// last; twice, for it may be like the mark.
bool decompress(tjhandle handle, const uint8_t *jpeg, size_t bytes, const ImageRoom &room) {
  constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS;  // or a progressive file takes as long as it likes
  uint8_t &last = room.pixels[size_t{room.width} * room.height * sphc_format_bytes(room.format) - 1];
  for (const uint8_t mark : {uint8_t{0x5a}, uint8_t{0xa5}}) {
    last = mark;
    if (tjDecompress2(handle, jpeg, bytes, room.pixels, static_cast<int>(room.width), 0,
                      static_cast<int>(room.height), turboFormat(room.format), kFlags) == 0)
      return true;
    if (tjGetErrorCode(handle) != TJERR_WARNING) return false;
    if (last != mark) return true;
  }
  return false;
}

}  // namespace

Decoded decodeJpeg(const uint8_t *jpeg, size_t bytes, const ImageRoom &room) {
  if (turboFormat(room.format) == TJPF_UNKNOWN) return Decoded::kOfAnotherKind;
  const Handle handle(tjInitDecompress());
  if (!handle) throw std::bad_alloc();
  int width = 0, height = 0, subsampling = 0, colors = -1;
  // It fails too where it has no name for the subsampling, having told the rest; decompressing says what is wrong.
  tjDecompressHeader3(handle.get(), jpeg, bytes, &width, &height, &subsampling, &colors);
  if (width != static_cast<int>(room.width) || height != static_cast<int>(room.height)) return Decoded::kDamaged;
  if (colors == TJCS_CMYK || colors == TJCS_YCCK) return Decoded::kOfAnotherKind;
  return decompress(handle.get(), jpeg, bytes, room) ? Decoded::kWhole : Decoded::kDamaged;
}

bool encodeJpeg(const sphc_image &image, uint32_t quality, std::vector<uint8_t> *jpeg) {
  const int format = turboFormat(image.format);
  const Handle handle(format == TJPF_UNKNOWN ? nullptr : tjInitCompress());
  if (!handle) return false;
  const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  const int subsampling = format == TJPF_GRAY ? TJSAMP_GRAY : TJSAMP_420;
  unsigned long bytes = tjBufSize(width, height, subsampling);
  jpeg->resize(bytes);
  uint8_t *out = jpeg->data();
  const bool is_made = tjCompress2(handle.get(), static_cast<const uint8_t *>(image.data), width,
                                   static_cast<int>(image.stride_bytes), height, format, &out, &bytes, subsampling,
                                   static_cast<int>(quality), TJFLAG_ACCURATEDCT | TJFLAG_NOREALLOC) == 0;
  jpeg->resize(is_made ? bytes : 0);
  return is_made;
}

}  // namespace sphc::host
