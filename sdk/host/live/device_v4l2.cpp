#include <algorithm>
#include <cmath>
#include <vector>

#include "drivers/v4l2/v4l2.h"
#include "host/base/checked_call.h"
#include "host/live/device_kind.h"
#include "host/live/words.h"

namespace sphc::host {
namespace {

class V4l2Device : public Device {
 public:
  V4l2Device(const std::string &address, const Wish &wish) {
    if (wish.color && wish.depth)
      throw std::runtime_error("v4l2:" + address + " is one node, which gives one stream; say --color and --depth");
    sphc_v4l2_config config;
    sphc_v4l2_config_init(&config, sizeof config);
    config.stream = wish.depth ? SPHC_STREAM_DEPTH : SPHC_STREAM_COLOR;
    if (!wish.depth && wish.color_images) config.format = SPHC_FORMAT_RGB8;
    config.width = wish.width;
    config.height = wish.height;
    config.fps = wish.fps;
    config.buffers = kLoans + 2;
    config.loan_limit = kLoans;
    orThrow("v4l2:" + address,
            [&](sphc_message *message) { return sphc_v4l2_open(address.c_str(), &config, &v4l2_, message); });
    source_.struct_size = sizeof source_;
    orThrow("v4l2:", [&](sphc_message *) { return sphc_v4l2_source(v4l2_, &source_); });
  }
  ~V4l2Device() override { sphc_v4l2_close(&v4l2_); }

  std::string describe() const override {
    sphc_v4l2_mode mode = {};
    mode.struct_size = sizeof mode;
    sphc_v4l2_get_mode(v4l2_, &mode);
    std::string rate;
    if (mode.period_numerator > 0)
      rate = " at " + std::to_string(std::lround(double(mode.period_denominator) / mode.period_numerator)) + " Hz";
    return std::string(mode.card) + " (" + mode.node + "), " + fourccText(mode.fourcc) + " " +
           std::to_string(mode.width) + " x " + std::to_string(mode.height) + rate;
  }
  std::string troubles() const override {
    sphc_v4l2_stats s = {};
    s.struct_size = sizeof s;
    sphc_v4l2_get_stats(v4l2_, &s);
    return countsInWords({{"lost", s.lost},
                          {"corrupt", s.corrupt},
                          {"cut short", s.short_frames},
                          {"duplicated", s.duplicated},
                          {"with an impossible time", s.time_replaced + s.time_refused},
                          {"times no buffer was free", s.starved}});
  }

 private:
  sphc_v4l2 *v4l2_ = nullptr;
};

std::unique_ptr<Device> openV4l2(const std::string &address, const Wish &wish) {
  return std::make_unique<V4l2Device>(address, wish);
}

constexpr uint32_t kMostV4l2 = 64;

std::string offersOf(const sphc_v4l2_device &device) {
  if (device.problem[0]) return "";  // it was not asked
  std::string text = device.can_color ? "colour" : "";
  if (device.can_depth) text += text.empty() ? "depth" : " and depth";
  if (text.empty()) text = "nothing that we read";
  text += ":";
  for (uint32_t i = 0; i < std::min(device.fourcc_count, 32u); ++i) text += " " + fourccText(device.fourccs[i]);
  return text;
}

void findV4l2(Found *found) {
  std::vector<sphc_v4l2_device> devices(kMostV4l2);
  uint32_t count = 0;
  if (sphc_v4l2_list(devices.data(), kMostV4l2, &count) < 0)
    return found->notes.push_back("v4l2: the cameras cannot be listed; may this user read /dev and /sys?");
  for (uint32_t i = 0; i < std::min(count, kMostV4l2); ++i) {
    const sphc_v4l2_device &d = devices[i];
    found->cameras.push_back({std::string("v4l2:") + d.node, d.card, offersOf(d), d.problem});
  }
}

}  // namespace

DeviceKind v4l2Kind() { return {"v4l2", openV4l2, findV4l2}; }

}  // namespace sphc::host
