// Raw pixels to GRAY8, RGB8, BGR8 or DEPTH16.  Allocates nothing and keeps no state.
#pragma once

#include "raw_image.h"

namespace sphc::pixels {

// Whether `layout` can become `format`: depth becomes DEPTH16 alone, and all else everything but DEPTH16.
bool canConvert(Layout layout, sphc_format format);

// The images have one size.  GRAY8 of a YUV layout is its luma, byte for byte, in the camera's own range; of
// colours the weights are the runtime's.  E_IMAGE with the values seen when a size, stride or byte count does not
// fit, E_UNSUPPORTED for a pair that canConvert denies; nothing was written then.
sphc_status convert(const RawImage &raw, const OutImage &out, sphc_message *message);

}  // namespace sphc::pixels
