// Images as a file lists them, in any order.
#pragma once

#include <algorithm>

#include "host/recording/recording.h"

namespace sphc::recording {

// In order of time, numbered; of equal times the first counts, and the others are counted as lost.
inline std::vector<RecordedImage> inOrderOfTime(std::vector<RecordedImage> images, uint64_t *lost_count) {
  std::stable_sort(images.begin(), images.end(),
                   [](const RecordedImage &a, const RecordedImage &b) { return a.time_ns < b.time_ns; });
  const auto end = std::unique(images.begin(), images.end(), [](const RecordedImage &a, const RecordedImage &b) {
    return a.time_ns == b.time_ns;
  });
  *lost_count += static_cast<uint64_t>(images.end() - end);
  images.erase(end, images.end());
  for (size_t i = 0; i < images.size(); ++i) images[i].sequence = static_cast<uint32_t>(i);
  return images;
}

}  // namespace sphc::recording
