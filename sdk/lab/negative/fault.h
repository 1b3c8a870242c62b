// What can be wrong with a sensor, a calibration or a prior, each as a change of a healthy sequence.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "lab/negative/sequence.h"

namespace sphc::host {

struct SensorFault {
  std::string name;
  std::function<void(Sequence *)> apply;
  uint32_t named_by = 0;       // SPHC_FAULT_ bits of which any names it; 0: nothing is wrong
  bool with_odometry = false;  // is odometry given?
  bool is_elsewhere = false;   // no pose is right: the views show another place
};

// A kind each.
std::vector<SensorFault> depthFaults();
std::vector<SensorFault> colorFaults();
std::vector<SensorFault> calibrationFaults();
std::vector<SensorFault> odometryFaults();
std::vector<SensorFault> priorFaults();

// All, healthy frames first.
std::vector<SensorFault> allFaults();

}  // namespace sphc::host
