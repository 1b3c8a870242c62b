#include "lab/negative/fault.h"

namespace sphc::host {

std::vector<SensorFault> allFaults() {
  std::vector<SensorFault> all = {{"healthy", [](Sequence *) {}, 0, false, false},
                                  {"healthy, odometry", [](Sequence *) {}, 0, true, false}};
  for (const auto &kind : {depthFaults(), colorFaults(), calibrationFaults(), odometryFaults(), priorFaults()})
    all.insert(all.end(), kind.begin(), kind.end());
  return all;
}

}  // namespace sphc::host
