#include "drivers.h"

namespace sphc::contract {

std::vector<Driver> driversUnderTest() {
  std::vector<Driver> all;
  const auto add = [&all](const std::vector<Driver> &some) { all.insert(all.end(), some.begin(), some.end()); };
  add(sampleDrivers());
  add(replayDrivers());
  add(libcameraDrivers());
  add(v4l2Drivers());
  return all;
}

}  // namespace sphc::contract
