// Broken sequences through the localizer: is a wrong pose given, and is the fault named?
#pragma once
#include <array>
#include <functional>

#include "host/evaluate/map_file.h"
#include "lab/negative/fault.h"

namespace sphc::host {

constexpr double kSureConfidence = 0.5;

struct PoseError {
  double translation_m = 0, rotation_deg = 0;
};
PoseError errorOf(const sphc_rigid &camera_from_map, const std::array<double, 3> &centre_in_world_m,
                  const sphc_rigid &truth_world_from_camera);
// By the bounds of host/report/statistics.h.
bool isGood(const PoseError &error);
bool isWrong(const PoseError &error);

struct NegativeRow {
  std::string fault, mode;
  uint32_t tried = 0, accepted = 0;
  uint32_t wrong = 0, wrong_sure = 0;  // of the accepted; with a confidence above kSureConfidence
  double worst_m = 0, worst_deg = 0;   // of those
  uint32_t named = 0;                  // frames; where nothing is wrong: false alarms
  uint32_t sequences = 0, sequences_named = 0;
  uint32_t seen = 0;  // SPHC_FAULT_ bits of any frame
};

struct NegativeInput {
  std::vector<Sequence> sequences;
  const std::vector<MapFile> *maps = nullptr;
  std::array<double, 3> centre_in_world_m = {};
  bool elsewhere = false;  // the recording shows another place than the map: no pose is right
};

using RowDone = std::function<void(uint32_t done, uint32_t total)>;

// Each of the faults in each mode; a sequence starts a localizer of its own.
std::vector<NegativeRow> runNegative(const NegativeInput &input, const std::vector<SensorFault> &faults,
                                     const RowDone &done);

}  // namespace sphc::host
