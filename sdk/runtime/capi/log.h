// What a localizer tells its log of a frame.
#pragma once
#include "runtime/capi/objects.h"

namespace sphc {

void logFrame(const sphc_localizer_frame &frame, const sphc_localizer_result &result, sphc_localizer *localizer);

}  // namespace sphc
