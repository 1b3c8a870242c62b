#include "drivers/replay/reader.h"
#include "drivers/replay/replay.h"
#include "host/base/checked_call.h"
#include "host/frames/damage.h"
#include "host/live/device_kind.h"

namespace sphc::host {
namespace {

class ReplayDevice : public Device {
 public:
  ReplayDevice(const std::string &address, const Wish &wish) : address_(address) {
    sphc_replay_config config;
    sphc_replay_config_init(&config, sizeof config);
    config.mode = wish.at_once ? SPHC_REPLAY_FAST : SPHC_REPLAY_REAL_TIME;
    config.streams = 0;
    if (wish.color) config.streams |= SPHC_REPLAY_STREAM_COLOR;
    if (wish.depth) config.streams |= SPHC_REPLAY_STREAM_DEPTH;
    config.loan_limit = 2 * kLoans;
    config.pair_tolerance_ns = static_cast<int64_t>(1e6 * wish.tolerance_ms);
    const char *calibration = wish.calibration.empty() ? nullptr : wish.calibration.c_str();
    orThrow("replay:" + address, [&](sphc_message *message) {
      return sphc_replay_open(address.c_str(), calibration, &config, &replay_, message);
    });
    source_.struct_size = sizeof source_;
    orThrow("replay:", [&](sphc_message *) { return sphc_replay_source(replay_, &source_); });
  }
  ~ReplayDevice() override { sphc_replay_close(&replay_); }

  std::string describe() const override { return "recording " + address_; }
  std::string troubles() const override {
    Damage damage = damageOf(replay::readerOf(replay_)->recording());
    damage.pose_fault.clear();  // doctor tells these two by themselves
    damage.order_faults.clear();
    std::string all;
    for (const std::string &sentence : sentencesOf(damage)) all += (all.empty() ? "" : "; ") + sentence;
    return all;
  }
  bool calibration(sphc_rig *calibration) const override {
    return sphc_replay_rig(replay_, calibration) == SPHC_OK;
  }
  bool waits() const override { return true; }
  recording::RecordingReader *replayed() const override { return replay::readerOf(replay_); }

 private:
  std::string address_;
  sphc_replay *replay_ = nullptr;
};

std::unique_ptr<Device> openReplay(const std::string &address, const Wish &wish) {
  return std::make_unique<ReplayDevice>(address, wish);
}

}  // namespace

DeviceKind replayKind() { return {"replay", openReplay, nullptr}; }

}  // namespace sphc::host
