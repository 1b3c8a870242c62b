#include "host/live/device.h"

#include <stdexcept>

namespace sphc::host {
namespace {

struct Kind {
  const char *name;
  std::unique_ptr<Device> (*open)(const std::string &address, const Wish &wish);
};
constexpr Kind kKinds[] = {{"v4l2", openV4l2},
                           {"libcamera", openLibcamera},
                           {"openni2", openOpenni2},
                           {"replay", openReplay},
                           {"simulated", openSimulated}};

}  // namespace

std::unique_ptr<Device> openDevice(const std::string &spec, const Wish &wish) {
  const size_t colon = spec.find(':');
  for (const Kind &kind : kKinds)
    if (spec.substr(0, colon) == kind.name)
      return kind.open(colon == std::string::npos ? "" : spec.substr(colon + 1), wish);
  std::string known;
  for (const Kind &kind : kKinds) known += std::string(known.empty() ? "" : ", ") + kind.name + ":";
  throw std::runtime_error("no such kind of camera: " + spec + "; say one of " + known +
                           " and behind it which, as `spherecloud devices` prints it");
}

}  // namespace sphc::host
