#include "host/frames/frame_images.h"

#include "runtime/stages/features/gray.h"

namespace sphc::host {

namespace {

LumaLayout layoutOf(sphc_format format) {
  LumaLayout layout;
  if (format == SPHC_FORMAT_GRAY8) return layout;
  layout.kind = format == SPHC_FORMAT_RGB8 ? LumaLayout::kRgb : LumaLayout::kBgr;
  layout.group_bytes = 3;
  return layout;
}

}  // namespace

GrayView grayOf(const sphc_image &color, std::vector<uint8_t> *pixels) {
  const auto width = static_cast<int32_t>(color.width), height = static_cast<int32_t>(color.height);
  pixels->resize(static_cast<size_t>(width) * static_cast<size_t>(height));
  const GrayView bytes = {static_cast<const uint8_t *>(color.data), width, height,
                          static_cast<int32_t>(color.stride_bytes)};
  return sphc::grayOf({bytes, layoutOf(color.format)}, {pixels->data(), pixels->size()});
}

ImageView<uint16_t> depthOf(const sphc_image &depth) {
  return {static_cast<const uint16_t *>(depth.data), static_cast<int32_t>(depth.width),
          static_cast<int32_t>(depth.height), static_cast<int32_t>(depth.stride_bytes / 2)};
}

}  // namespace sphc::host
