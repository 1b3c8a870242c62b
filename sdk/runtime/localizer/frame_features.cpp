#include "runtime/localizer/frame_features.h"

#include <cstring>

#include "runtime/stages/features/gray.h"

namespace sphc {

void FrameFeatures::layout(const LocalizerConfig &config, Arena &state, FrameFeatures *features) {
  static constexpr const char *kNames[3] = {"features.keypoints", "features.descriptors", "features.cameras"};
  const size_t pixels = size_t(config.color_camera.width()) * size_t(config.color_camera.height());
  FrameFeatures discarded;  // receives empty spans while measuring
  FrameFeatures &f = features ? *features : discarded;
  FeatureRoom::layout(kNames, config, state, features ? &f.room : nullptr);
  f.gray_room = state.take<uint8_t>("features.gray", pixels);
}

void FrameFeatures::keepGray(const ColorView &color) {
  const GrayView seen = grayOf(color, gray_room);
  gray = {gray_room.data(), seen.width, seen.height, seen.width};
  if (seen.data == gray.data) return;
  for (int32_t y = 0; y < seen.height; ++y)
    std::memcpy(gray_room.data() + int64_t{y} * seen.width, seen.row(y), size_t(seen.width));
}

}  // namespace sphc
