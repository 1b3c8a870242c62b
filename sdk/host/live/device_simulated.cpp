#include "drivers/simulated/simulated.h"
#include "host/base/checked_call.h"
#include "host/live/device_kind.h"

namespace sphc::host {
namespace {

class SimulatedDevice : public Device {
 public:
  SimulatedDevice(const std::string &address, const Wish &wish) {
    if (!address.empty()) throw std::runtime_error("simulated: stands alone; leave out " + address);
    if (!wish.color || !wish.depth)
      throw std::runtime_error("simulated: gives both streams; say --device simulated:");
    sphc_simulated_config config;
    sphc_simulated_config_init(&config, sizeof config);
    orThrow("simulated:",
            [&](sphc_message *message) { return sphc_simulated_open(&config, &simulated_, message); });
    source_.struct_size = sizeof source_;
    orThrow("simulated:", [&](sphc_message *) { return sphc_simulated_source(simulated_, &source_); });
  }
  ~SimulatedDevice() override { sphc_simulated_close(&simulated_); }

  std::string describe() const override { return "simulated headset"; }
  bool calibration(sphc_rig *calibration) const override {
    return sphc_simulated_rig(simulated_, calibration) == SPHC_OK;
  }
  bool waits() const override { return true; }

 private:
  sphc_simulated *simulated_ = nullptr;
};

std::unique_ptr<Device> open(const std::string &address, const Wish &wish) {
  return std::make_unique<SimulatedDevice>(address, wish);
}

}  // namespace

DeviceKind simulatedKind() { return {"simulated", open, nullptr}; }

}  // namespace sphc::host
