#include <charconv>

#include "drivers/simulated/simulated.h"
#include "host/base/checked_call.h"
#include "host/live/device_kind.h"

namespace sphc::host {
namespace {

template <typename Number>
void readNumber(const std::string &item, const std::string &text, Number *number) {
  const char *end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, *number);
  if (error != std::errc() || rest != end)
    throw std::runtime_error("simulated: " + item + " has no number; write as in seed=7");
}

// An address is a list: names of what makes the world hard, and seed=N, walk-seed=N, arrangement=N,
// row-time-ns=N, cameras=NAME.
sphc_simulated_config configOf(const std::string &address) {
  sphc_simulated_config config;
  sphc_simulated_config_init(&config, sizeof config);
  std::string names;
  for (size_t begin = 0; begin < address.size();) {
    const size_t end = std::min(address.find(',', begin), address.size());
    const std::string item = address.substr(begin, end - begin);
    const size_t equals = item.find('=');
    const std::string key = item.substr(0, equals);
    const auto read = [&](auto *number) { readNumber(item, item.substr(equals + 1), number); };
    if (equals == std::string::npos) {
      names += (names.empty() ? "" : ",") + item;
    } else if (key == "seed") {
      read(&config.seed);
    } else if (key == "walk-seed") {
      read(&config.walk_seed);
    } else if (key == "arrangement") {
      read(&config.arrangement_seed);
    } else if (key == "row-time-ns") {
      read(&config.color_row_time_ns);
    } else if (key == "cameras") {
      orThrow("simulated:" + address, [&](sphc_message *message) {
        return sphc_simulated_parse_cameras(item.c_str() + equals + 1, &config.cameras, message);
      });
    } else {
      throw std::runtime_error(
          "simulated: " + key +
          " is unknown; there are seed=, walk-seed=, arrangement=, row-time-ns=, cameras=, and names alone, as in "
          "simulated:people,tiles");
    }
    begin = end + 1;
  }
  orThrow("simulated:" + address,
          [&](sphc_message *message) { return sphc_simulated_parse_with(names.c_str(), &config.with, message); });
  if ((config.with & SPHC_SIMULATED_FLAT) != 0) config.lap_s = SPHC_SIMULATED_LAP_OF_FLAT_S;
  return config;
}

class SimulatedDevice : public Device {
 public:
  SimulatedDevice(const std::string &address, const Wish &wish) {
    if (!wish.color || !wish.depth)
      throw std::runtime_error("simulated: gives both streams; say --device simulated:");
    const sphc_simulated_config config = configOf(address);
    cameras_ = sphc_simulated_cameras_name(config.cameras);
    orThrow("simulated:" + address,
            [&](sphc_message *message) { return sphc_simulated_open(&config, &simulated_, message); });
    source_.struct_size = sizeof source_;
    orThrow("simulated:", [&](sphc_message *) { return sphc_simulated_source(simulated_, &source_); });
  }
  ~SimulatedDevice() override { sphc_simulated_close(&simulated_); }

  std::string describe() const override { return "simulated headset, cameras=" + cameras_; }
  bool calibration(sphc_rig *calibration) const override {
    return sphc_simulated_rig(simulated_, calibration) == SPHC_OK;
  }
  bool waits() const override { return true; }

 private:
  std::string cameras_;  // their name
  sphc_simulated *simulated_ = nullptr;
};

std::unique_ptr<Device> openSimulated(const std::string &address, const Wish &wish) {
  return std::make_unique<SimulatedDevice>(address, wish);
}

}  // namespace

DeviceKind simulatedKind() { return {"simulated", openSimulated, nullptr}; }

}  // namespace sphc::host
