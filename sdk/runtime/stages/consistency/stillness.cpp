#include "runtime/stages/consistency/stillness.h"

#include <algorithm>

#include "runtime/base/clock.h"
#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr int32_t kColumns = 32, kRows = 24;  // samples of grey
constexpr int32_t kGrayNoise = 12;            // levels
constexpr int32_t kDepthNoiseShare = 50;      // 1 / 50 of the measurement
constexpr uint32_t kFewestMeasured = 100;
constexpr uint64_t kFrozenNs = 60000000;  // cameras that run freely give one image twice now and then

}  // namespace

void Stillness::layout(size_t depth_samples, Arena &state, Stillness *stillness) {
  Stillness discarded;
  Stillness &s = stillness ? *stillness : discarded;
  s.depth_ = state.take<uint16_t>("consistency.before", depth_samples);
  s.gray_ = state.take<uint8_t>("consistency.before", size_t{kColumns} * kRows);
  // The first frame is compared with them too, and what is found is not used.
  std::fill(s.depth_.begin(), s.depth_.end(), uint16_t{0});
  std::fill(s.gray_.begin(), s.gray_.end(), uint8_t{0});
}

// Each takes in what is new.
Stillness::Change Stillness::compareDepth(Span<const uint16_t> depth) {
  Change change;
  for (size_t i = 0; i < depth.size(); ++i) {
    const int32_t before = depth_[i], now = depth[i];
    depth_[i] = depth[i];
    if (before == 0 && now == 0) continue;
    ++change.compared;
    change.changed += now != before;
    change.moved += before && now && kDepthNoiseShare * absOf(now - before) > before;
  }
  if (change.compared < kFewestMeasured) change.compared = 0;
  return change;
}

Stillness::Change Stillness::compareGray(GrayView gray) {
  Change change;
  uint8_t darkest = UINT8_MAX, brightest = 0;
  for (int32_t row = 0; row < kRows; ++row) {
    const uint8_t *line = gray.row((2 * row + 1) * gray.height / (2 * kRows));
    for (int32_t column = 0; column < kColumns; ++column) {
      uint8_t &kept = gray_[static_cast<size_t>(row * kColumns + column)];
      const uint8_t now = line[(2 * column + 1) * gray.width / (2 * kColumns)];
      ++change.compared;
      change.changed += now != kept;
      change.moved += absOf(int32_t{now} - int32_t{kept}) > kGrayNoise;
      kept = now;
      darkest = std::min(darkest, now);
      brightest = std::max(brightest, now);
    }
  }
  const bool shows = brightest - darkest > kGrayNoise;
  if (!shows || !gray_shows_) change.compared = 0;  // in the dark nothing stands still, and light is no motion
  gray_shows_ = shows;
  return change;
}

Faults Stillness::look(Span<const uint16_t> depth, int64_t depth_time_ns, GrayView gray, int64_t color_time_ns) {
  const Change of_depth = compareDepth(depth), of_gray = compareGray(gray);
  // An image that is said to be the one of before may well be.
  if (!has_before_ || !of_depth.isStill()) depth_time_ns_ = depth_time_ns;
  if (!has_before_ || !of_gray.isStill()) color_time_ns_ = color_time_ns;
  has_before_ = true;
  if (elapsedNs(depth_time_ns_, depth_time_ns) > kFrozenNs && of_gray.isMotion()) return kDepthFrozen;
  if (elapsedNs(color_time_ns_, color_time_ns) > kFrozenNs && of_depth.isMotion()) return kColorFrozen;
  return 0;
}

}  // namespace sphc
