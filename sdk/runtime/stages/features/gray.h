// The luma of an image, a byte a pixel.
#pragma once
#include "runtime/base/span.h"
#include "runtime/types/image_view.h"

namespace sphc {

// In place where the image has it so; else written to `gray`, which has a byte for every pixel.  Colours by the
// BT.601 weights in integers; of more than 8 bits the highest 8; of a colour filter the green, and at pixels of
// another colour the mean of the greens beside them.
GrayView grayOf(const ColorView &color, Span<uint8_t> gray);

}  // namespace sphc
