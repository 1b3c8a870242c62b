// Images and accelerations as a file lists them, in any order.
#pragma once

#include <algorithm>

#include "host/recording/recording.h"

namespace sphc::recording {

// In order of time, numbered; of equal times the first counts, and the recording counts the others as left out.
inline std::vector<RecordedImage> inOrderOfTime(std::vector<RecordedImage> images, Recording *recording) {
  std::stable_sort(images.begin(), images.end(),
                   [](const RecordedImage &a, const RecordedImage &b) { return a.time_ns < b.time_ns; });
  const auto end = std::unique(images.begin(), images.end(), [](const RecordedImage &a, const RecordedImage &b) {
    return a.time_ns == b.time_ns;
  });
  const auto again_count = static_cast<uint32_t>(images.end() - end);
  recording->lost_count += again_count;
  recording->backward_count += again_count;
  images.erase(end, images.end());
  for (size_t i = 0; i < images.size(); ++i) images[i].sequence = static_cast<uint32_t>(i);
  return images;
}

// In order of time; of equal times the first counts.
inline std::vector<TimedAcceleration> inOrderOfTime(std::vector<TimedAcceleration> all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const TimedAcceleration &a, const TimedAcceleration &b) { return a.time_ns < b.time_ns; });
  const auto is_again = [](const TimedAcceleration &a, const TimedAcceleration &b) {
    return a.time_ns == b.time_ns;
  };
  all.erase(std::unique(all.begin(), all.end(), is_again), all.end());
  return all;
}

// From a sensor's axes to the colour camera's.
inline void turnAccelerations(sphc_rigid color_from_sensor, std::vector<TimedAcceleration> *all) {
  std::fill_n(color_from_sensor.t_m, 3, 0.0);  // a direction
  for (TimedAcceleration &each : *all) {
    const TimedAcceleration felt = each;
    sphc_rigid_apply(&color_from_sensor, felt.felt_mps2, each.felt_mps2);
  }
}

}  // namespace sphc::recording
