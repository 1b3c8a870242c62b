// One frame of Motion JPEG to GRAY8, RGB8 or BGR8, through TurboJPEG.
#pragma once

#include "raw_image.h"

namespace sphc::pixels {

// Made once, used for every frame, by one thread at a time.  libjpeg-turbo itself takes and gives back some 100 kB
// of working memory while it decodes a frame; this class takes none.
class MjpegDecoder {
 public:
  MjpegDecoder();  // isReady() is false when memory ran out
  ~MjpegDecoder();
  MjpegDecoder(const MjpegDecoder &) = delete;
  MjpegDecoder &operator=(const MjpegDecoder &) = delete;

  bool isReady() const { return handle_ != nullptr; }

  // E_IMAGE when the frame is no JPEG, is cut or damaged where a decoder can see it (JPEG has no checksum), or has
  // another size than `out`, which may have been written to; E_STATE when not ready; E_UNSUPPORTED for DEPTH16.
  // Bytes behind the end mark are ignored, padding before it too but in a progressive frame, which is refused, and
  // frames without Huffman tables have the standard ones, as cameras do.
  sphc_status decode(const uint8_t *data, size_t bytes, const OutImage &out, sphc_message *message);

 private:
  void *handle_;  // a tjhandle
};

}  // namespace sphc::pixels
