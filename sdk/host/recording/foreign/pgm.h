// Binary PGM images of 16 bits, the higher byte first.
#pragma once

#include "host/recording/image_header.h"

namespace sphc::recording {

// Throws Failure (DEVICE) without a name when it is none or ends early, or a side is over SPHC_CAMERA_MAX_PX.
ImageSize pgmSizeOf(ByteView file);
// Fills an image of that size.
void decodePgm(ByteView file, uint16_t *pixels);

}  // namespace sphc::recording
