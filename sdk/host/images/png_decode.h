// PNG files to pixels, by libspng.
#pragma once

#include <cstddef>

#include "host/images/decoded.h"

namespace sphc::host {

// Fills the room.  GRAY8, RGB8 and BGR8 are made of every PNG: alpha is left out, and of 16 bits the upper 8 stay.
// BGRA8 is made of colour with alpha in 8 bits, DEPTH16 of grey in 16 bits; others are kOfAnotherKind.  An image of
// another size than the room's is kDamaged, and is not decoded.
Decoded decodePng(const uint8_t *png, size_t bytes, const ImageRoom &room);

}  // namespace sphc::host
