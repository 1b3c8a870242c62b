#include "host/frames/frame_images.h"

#include "runtime/stages/features/gray.h"

namespace sphc::host {

GrayView grayOf(const sphc_image &color, std::vector<uint8_t> *pixels) {
  const auto width = static_cast<int32_t>(color.width), height = static_cast<int32_t>(color.height);
  pixels->resize(static_cast<size_t>(width) * static_cast<size_t>(height));
  bgrToGray(static_cast<const uint8_t *>(color.data), static_cast<int32_t>(color.stride_bytes), width, height,
            pixels->data(), width);
  return {pixels->data(), width, height, width};
}

ImageView<uint16_t> depthOf(const sphc_image &depth) {
  return {static_cast<const uint16_t *>(depth.data), static_cast<int32_t>(depth.width),
          static_cast<int32_t>(depth.height), static_cast<int32_t>(depth.stride_bytes / 2)};
}

}  // namespace sphc::host
