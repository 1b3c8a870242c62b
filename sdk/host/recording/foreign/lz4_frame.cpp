#include "host/recording/foreign/lz4_frame.h"

#include <lz4frame.h>

#include <memory>

namespace sphc::recording {

bool readsLz4() { return true; }

bool decodeLz4Frame(ByteView frame, Bytes &out) {
  LZ4F_dctx *raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION))) return false;
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(raw,
                                                                                     LZ4F_freeDecompressionContext);
  size_t written = 0, read = 0;
  while (true) {
    size_t room = out.size() - written, left = frame.size - read;
    const size_t wanted =
        LZ4F_decompress(context.get(), out.data() + written, &room, frame.data + read, &left, nullptr);
    written += room;
    read += left;
    if (LZ4F_isError(wanted)) return false;
    if (wanted == 0) return written == out.size();  // the frame ends
    if (room == 0 && left == 0) return false;
  }
}

}  // namespace sphc::recording
