// JPEG files to pixels and back, by TurboJPEG.
#pragma once

#include <cstddef>
#include <vector>

#include "host/images/decoded.h"

namespace sphc::host {

// Fills the room: GRAY8, which is luma alone, RGB8 or BGR8.  Damage that libjpeg papers over is none, as in
// viewers; a note of how to turn the image is ignored.  Colours of print, CMYK, are kOfAnotherKind, and so is all
// for a room of another format.  An image of another size than the room's is kDamaged, and is not decoded.
Decoded decodeJpeg(const uint8_t *jpeg, size_t bytes, const ImageRoom &room);

// Of a valid image, GRAY8, RGB8 or BGR8, with half the colours across and down; the quality is 0 to 100.  False
// when it is of another format or memory runs out.
[[nodiscard]] bool encodeJpeg(const sphc_image &image, uint32_t quality, std::vector<uint8_t> *jpeg);

}  // namespace sphc::host
