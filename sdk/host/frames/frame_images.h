// A frame's images as the stages take them.
#pragma once
#include <spherecloud/spherecloud.h>

#include <vector>

#include "runtime/types/image_view.h"

namespace sphc::host {

// Of GRAY8, RGB8 or BGR8, as recordings have them; `pixels` are made to hold what the view shows.
GrayView grayOf(const sphc_image &color, std::vector<uint8_t> *pixels);
ImageView<uint16_t> depthOf(const sphc_image &depth);

}  // namespace sphc::host
