#include <algorithm>
#include <vector>

#include "drivers/openni2/openni2.h"
#include "host/base/checked_call.h"
#include "host/live/device_kind.h"
#include "host/live/words.h"

namespace sphc::host {
namespace {

std::string modeText(const sphc_openni2_mode &mode) {
  return std::to_string(mode.width) + " x " + std::to_string(mode.height) + " at " +
         std::to_string(mode.frames_per_s) + " Hz";
}

class Openni2Device : public Device {
 public:
  Openni2Device(const std::string &address, const Wish &wish) {
    sphc_openni2_config config;
    sphc_openni2_config_init(&config, sizeof config);
    config.streams = 0;
    if (wish.color) config.streams |= SPHC_OPENNI2_STREAM_COLOR;
    if (wish.depth) config.streams |= SPHC_OPENNI2_STREAM_DEPTH;
    config.loan_limit = 2 * kLoans + 4;  // for both streams, and some to queue
    orThrow("openni2:" + address, [&](sphc_message *message) {
      return sphc_openni2_open(address.empty() ? nullptr : address.c_str(), &config, &openni2_, message);
    });
    source_.struct_size = sizeof source_;
    orThrow("openni2:", [&](sphc_message *) { return sphc_openni2_source(openni2_, &source_); });
  }
  ~Openni2Device() override { sphc_openni2_close(&openni2_); }

  std::string describe() const override {
    const sphc_openni2_info info = this->info();
    std::string text = std::string(info.device.vendor) + " " + info.device.name + " (" + info.device.uri + ")";
    if (info.color.width > 0) text += ", colour " + modeText(info.color);
    if (info.depth.width > 0) text += ", depth " + modeText(info.depth);
    return text;
  }
  std::string troubles() const override {
    sphc_openni2_statistics s = {};
    s.struct_size = sizeof s;
    sphc_openni2_get_statistics(openni2_, &s);
    const sphc_openni2_counts &c = s.color, &d = s.depth;
    return countsInWords({{"lost", c.lost + d.lost},
                          {"overrun", c.overrun + d.overrun},
                          {"late", c.late + d.late},
                          {"duplicated", c.duplicated + d.duplicated},
                          {"bad", c.bad + d.bad},
                          {"jumps of the clock", c.clock_jumps + d.clock_jumps},
                          {"stalls", c.stalls + d.stalls}});
  }
  bool waits() const override { return info().is_recording != 0; }

 private:
  sphc_openni2_info info() const {
    sphc_openni2_info info = {};
    info.struct_size = sizeof info;
    sphc_openni2_get_info(openni2_, &info);
    return info;
  }

  sphc_openni2 *openni2_ = nullptr;
};

std::unique_ptr<Device> openOpenni2(const std::string &address, const Wish &wish) {
  return std::make_unique<Openni2Device>(address, wish);
}

constexpr uint32_t kMostOpenni2 = 64;

void findOpenni2(Found *found) {
  std::vector<sphc_openni2_device> devices(kMostOpenni2);
  uint32_t count = 0;
  sphc_message message = {};
  if (sphc_openni2_list(devices.data(), kMostOpenni2, &count, &message) < 0)
    return found->notes.push_back(std::string("openni2: ") + message.text);
  for (uint32_t i = 0; i < std::min(count, kMostOpenni2); ++i)
    found->cameras.push_back({std::string("openni2:") + devices[i].uri,
                              std::string(devices[i].vendor) + " " + devices[i].name, "colour and depth", ""});
}

}  // namespace

DeviceKind openni2Kind() { return {"openni2", openOpenni2, findOpenni2}; }

}  // namespace sphc::host
