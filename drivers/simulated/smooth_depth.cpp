#include "drivers/simulated/smooth_depth.h"

#include <algorithm>
#include <vector>

namespace sphc::simulated {
namespace {

constexpr int kReach = 2;

uint16_t meanAround(const std::vector<uint16_t> &depth, int width, int height, int x, int y) {
  uint32_t sum = 0, count = 0;
  for (int row = std::max(y - kReach, 0); row <= std::min(y + kReach, height - 1); ++row)
    for (int column = std::max(x - kReach, 0); column <= std::min(x + kReach, width - 1); ++column) {
      const uint16_t value =
          depth[static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(column)];
      sum += value;
      count += value > 0;
    }
  return count == 0 ? uint16_t{0} : static_cast<uint16_t>((sum + count / 2) / count);
}

}  // namespace

void smoothDepth(uint32_t width, uint32_t height, uint16_t *depth) {
  const std::vector<uint16_t> measured(depth, depth + static_cast<size_t>(width) * height);
  const auto columns = static_cast<int>(width), rows = static_cast<int>(height);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) *depth++ = meanAround(measured, columns, rows, x, y);
}

}  // namespace sphc::simulated
