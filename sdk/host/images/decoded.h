// Where a decoded image goes, and how decoding ends.
#pragma once

#include <spherecloud/spherecloud.h>

namespace sphc::host {

// Memory of the caller, rows without padding.
struct ImageRoom {
  uint8_t *pixels;
  uint32_t width, height;
  sphc_format format;
};

// The room may have been written to, however it ended.
enum class Decoded { kWhole, kDamaged, kOfAnotherKind };

}  // namespace sphc::host
