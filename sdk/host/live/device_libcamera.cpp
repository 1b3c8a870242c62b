#include <algorithm>
#include <vector>

#include "drivers/libcamera/libcamera.h"
#include "host/base/checked_call.h"
#include "host/live/device_kind.h"
#include "host/live/words.h"

namespace sphc::host {
namespace {

class LibcameraDevice : public Device {
 public:
  LibcameraDevice(const std::string &address, const Wish &wish) {
    if (wish.depth)
      throw std::runtime_error("libcamera: has no depth; say --color libcamera:" + address +
                               " and --depth v4l2:/dev/videoN");
    sphc_libcamera_config config;
    sphc_libcamera_config_init(&config, sizeof config);
    config.format = wish.color_images ? SPHC_FORMAT_RGB8 : SPHC_FORMAT_GRAY8;
    config.width = wish.width;
    config.height = wish.height;
    config.rate_hz = wish.fps;
    config.loan_limit = kLoans;
    orThrow("libcamera:" + address, [&](sphc_message *message) {
      return sphc_libcamera_open(address.empty() ? nullptr : address.c_str(), &config, &camera_, message);
    });
    source_.struct_size = sizeof source_;
    orThrow("libcamera:", [&](sphc_message *) { return sphc_libcamera_source(camera_, &source_); });
  }
  ~LibcameraDevice() override { sphc_libcamera_close(&camera_); }

  std::string describe() const override {
    const sphc_libcamera_info info = now();
    return std::string(info.name.model) + " (" + info.name.id + "), " + info.pixel_format + " " +
           std::to_string(info.width) + " x " + std::to_string(info.height) + ", libcamera " + info.library;
  }
  std::string troubles() const override {
    const sphc_libcamera_info info = now();
    return countsInWords(
        {{"lost", info.lost}, {"damaged", info.refused}, {"without a time of the camera", info.without_time}});
  }

 private:
  sphc_libcamera_info now() const {
    sphc_libcamera_info info = {};
    info.struct_size = sizeof info;
    sphc_libcamera_get_info(camera_, &info);
    return info;
  }

  sphc_libcamera *camera_ = nullptr;
};

std::unique_ptr<Device> openLibcamera(const std::string &address, const Wish &wish) {
  return std::make_unique<LibcameraDevice>(address, wish);
}

constexpr uint32_t kMostLibcamera = 64;

void findLibcamera(Found *found) {
  std::vector<sphc_libcamera_name> names(kMostLibcamera);
  uint32_t count = 0;
  sphc_message message = {};
  if (sphc_libcamera_list(nullptr, names.data(), kMostLibcamera, &count, &message) < 0)
    return found->notes.push_back(std::string("libcamera: ") + message.text);
  for (uint32_t i = 0; i < std::min(count, kMostLibcamera); ++i)
    found->cameras.push_back({std::string("libcamera:") + names[i].id, names[i].model, "colour", ""});
}

}  // namespace

DeviceKind libcameraKind() { return {"libcamera", openLibcamera, findLibcamera}; }

}  // namespace sphc::host
