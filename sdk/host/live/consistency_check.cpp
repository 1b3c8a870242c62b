#include "host/live/consistency_check.h"

#include "host/report/fault_words.h"

namespace sphc::host {
namespace {

constexpr uint32_t kOneIn = 10;  // of the pairs: a fault that is seen less often may be one of the scene

}  // namespace

ConsistencyCheck::ConsistencyCheck(const sphc_rig &calibration, double depth_min_m, double depth_max_m)
    : consistency_(calibration, depth_min_m, depth_max_m) {}

void ConsistencyCheck::look(const sphc_image &color, int64_t color_time_ns, const sphc_image &depth,
                            int64_t depth_time_ns) {
  seen_.add(consistency_.look(color, color_time_ns, depth, depth_time_ns));
  ++pairs_;
}

Findings ConsistencyCheck::findings() const {
  Findings findings;
  for (const BitWords &words : kFaultWords)
    if (const uint32_t seen = seen_.of(words.bit))
      findings.push_back(
          {seen * kOneIn >= pairs_ ? Finding::Grade::kWrong : Finding::Grade::kDoubtful, words.name,
           "in " + std::to_string(seen) + " of " + std::to_string(pairs_) + " pairs: " + words.cure});
  if (pairs_ && findings.empty())
    findings.push_back(
        {Finding::Grade::kFine, "consistency", "no pair of " + std::to_string(pairs_) + " contradicts itself"});
  return findings;
}

}  // namespace sphc::host
