// Sequences under conditions through the localizer: is a frame without a pose told why?
#pragma once
#include <array>

#include "host/evaluate/map_file.h"
#include "lab/hints/conditions.h"

namespace sphc::host {

constexpr uint32_t kHints = 6;  // bits of SPHC_HINT_

struct HintRow {
  std::string condition, mode;
  uint32_t frames = 0, without_pose = 0;
  uint32_t told = 0;                        // without a pose, with the condition's hint; healthy: with none
  std::array<uint32_t, kHints> hints = {};  // without a pose, with each hint
};

struct HintInput {
  std::vector<Sequence> sequences;
  const std::vector<MapFile> *maps = nullptr;
};

using HintRowDone = std::function<void(uint32_t done, uint32_t total)>;

// Each condition in each mode, without odometry; a sequence starts a localizer of its own.
std::vector<HintRow> runHints(const HintInput &input, const std::vector<HintCondition> &conditions,
                              const HintRowDone &done);

}  // namespace sphc::host
