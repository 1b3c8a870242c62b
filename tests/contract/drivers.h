// The drivers of this tree that the contract suite runs on; one file each.
#pragma once

#include "drivers/contract/contract.h"

namespace sphc::contract {

std::vector<Driver> sampleDrivers();
std::vector<Driver> replayDrivers();
std::vector<Driver> libcameraDrivers();
std::vector<Driver> v4l2Drivers();

}  // namespace sphc::contract
