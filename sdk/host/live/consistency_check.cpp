#include "host/live/consistency_check.h"

#include <spherecloud/spherecloud.hpp>

#include "host/frames/frame_images.h"
#include "host/frames/heap_arena.h"
#include "host/report/fault_words.h"

namespace sphc::host {
namespace {

constexpr uint32_t kOneIn = 10;  // of the pairs: a fault that is seen less often may be one of the scene

ConsistencyConfig configOf(const sphc_rig &calibration) {
  const sphc_localizer_config usual = spherecloud::defaultConfig();
  ConsistencyConfig config;
  config.color_camera = Camera(calibration.color_camera);
  config.depth_camera = Camera(calibration.depth_camera);
  config.depth_sensor.unit_m = calibration.depth_unit_m;
  config.depth_sensor.min_m = usual.depth_min_m;
  config.depth_sensor.max_m = usual.depth_max_m;
  config.follows = true;
  return config;
}

}  // namespace

ConsistencyCheck::ConsistencyCheck(const sphc_rig &calibration)
    : color_from_depth_(rigidFromC(calibration.color_from_depth)) {
  Arena state_size, scratch_size;
  Consistency::layout(state_size, scratch_size, nullptr);
  Arena state = heapFor(state_size, &state_), scratch = heapFor(scratch_size, &scratch_);
  Consistency::layout(state, scratch, &consistency_);
  consistency_.init(configOf(calibration));
}

void ConsistencyCheck::look(const sphc_image &color, int64_t color_time_ns, const sphc_image &depth,
                            int64_t depth_time_ns) {
  const Faults faults =
      consistency_.look({grayOf(color, &gray_), depthOf(depth), color_from_depth_, color_time_ns, depth_time_ns});
  for (size_t bit = 0; bit < kFaults; ++bit) seen_[bit] += (faults >> bit) & 1u;
  ++pairs_;
}

Findings ConsistencyCheck::findings() const {
  Findings findings;
  for (size_t bit = 0; bit < kFaults; ++bit) {
    if (!seen_[bit]) continue;
    for (const BitWords &words : kFaultWords)
      if (words.bit == 1u << bit)
        findings.push_back(
            {seen_[bit] * kOneIn >= pairs_ ? Finding::Grade::kWrong : Finding::Grade::kDoubtful, words.name,
             "in " + std::to_string(seen_[bit]) + " of " + std::to_string(pairs_) + " pairs: " + words.cure});
  }
  if (pairs_ && findings.empty())
    findings.push_back(
        {Finding::Grade::kFine, "consistency", "no pair of " + std::to_string(pairs_) + " contradicts itself"});
  return findings;
}

}  // namespace sphc::host
