// In place of exr_depth.cpp where OpenEXR is not installed.
#include "host/recording/failure.h"
#include "host/recording/foreign/exr_depth.h"

namespace sphc::recording {

ImageSize exrSizeOf(ByteView) {
  throw Failure(SPHC_E_UNSUPPORTED, "this build reads no OpenEXR; install libopenexr-dev and build again");
}

void decodeExrDepth(ByteView file, const sphc_camera &, uint16_t *) { exrSizeOf(file); }

}  // namespace sphc::recording
