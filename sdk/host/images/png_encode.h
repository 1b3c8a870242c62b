// Pixels to PNG files, by libspng.
#pragma once

#include <spherecloud/spherecloud.h>

#include <vector>

namespace sphc::host {

// Of a valid image, GRAY8, RGB8, BGR8 or DEPTH16; compressed for speed.  False when it is of another format or
// memory runs out.
[[nodiscard]] bool encodePng(const sphc_image &image, std::vector<uint8_t> *png);

}  // namespace sphc::host
