#include "drivers.h"

namespace sphc::contract {

std::vector<Driver> driversUnderTest() {
  std::vector<Driver> all;
  for (const auto &some : {sampleDrivers(), replayDrivers()}) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace sphc::contract
