#include "host/live/found.h"

#include <algorithm>

#include "drivers/libcamera/libcamera.h"
#include "drivers/openni2/openni2.h"
#include "drivers/v4l2/v4l2.h"
#include "host/live/words.h"

namespace sphc::host {
namespace {

constexpr uint32_t kMost = 64;

std::string offersOf(const sphc_v4l2_device &device) {
  std::string text = device.can_color ? "colour" : "";
  if (device.can_depth) text += text.empty() ? "depth" : " and depth";
  if (text.empty()) text = "nothing that we read";
  text += ":";
  for (uint32_t i = 0; i < std::min(device.fourcc_count, 32u); ++i) text += " " + fourccText(device.fourccs[i]);
  return text;
}

void findV4l2(Found *found) {
  std::vector<sphc_v4l2_device> devices(kMost);
  uint32_t count = 0;
  if (sphc_v4l2_list(devices.data(), kMost, &count) < 0)
    return found->notes.push_back("v4l2: the cameras cannot be listed; may this user read /dev and /sys?");
  for (uint32_t i = 0; i < std::min(count, kMost); ++i) {
    const sphc_v4l2_device &d = devices[i];
    found->cameras.push_back({std::string("v4l2:") + d.node, d.card, offersOf(d), d.problem});
  }
}

void findLibcamera(Found *found) {
  std::vector<sphc_libcamera_name> names(kMost);
  uint32_t count = 0;
  sphc_message message = {};
  if (sphc_libcamera_list(nullptr, names.data(), kMost, &count, &message) < 0)
    return found->notes.push_back(std::string("libcamera: ") + message.text);
  for (uint32_t i = 0; i < std::min(count, kMost); ++i)
    found->cameras.push_back({std::string("libcamera:") + names[i].id, names[i].model, "colour", ""});
}

void findOpenni2(Found *found) {
  std::vector<sphc_openni2_device> devices(kMost);
  uint32_t count = 0;
  sphc_message message = {};
  if (sphc_openni2_list(devices.data(), kMost, &count, &message) < 0)
    return found->notes.push_back(std::string("openni2: ") + message.text);
  for (uint32_t i = 0; i < std::min(count, kMost); ++i)
    found->cameras.push_back({std::string("openni2:") + devices[i].uri,
                              std::string(devices[i].vendor) + " " + devices[i].name, "colour and depth", ""});
}

}  // namespace

Found findCameras() {
  Found found;
  findV4l2(&found);
  findLibcamera(&found);
  findOpenni2(&found);
  return found;
}

}  // namespace sphc::host
