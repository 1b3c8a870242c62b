// Borrowed images.
#pragma once
#include <cstdint>

namespace sphc {

template <typename T>
struct ImageView {
  const T *data = nullptr;
  int32_t width = 0, height = 0;
  int32_t stride = 0;  // elements from a row to the next

  const T *row(int32_t y) const { return data + static_cast<int64_t>(y) * stride; }
};
using GrayView = ImageView<uint8_t>;

enum class ChannelOrder : uint8_t { kGray, kRgb, kBgr };

// A colour or grey image, a byte a channel.
struct ColorView {
  const uint8_t *data = nullptr;
  int32_t width = 0, height = 0;
  int32_t stride = 0;  // bytes from a row to the next
  ChannelOrder order = ChannelOrder::kGray;
};

}  // namespace sphc
