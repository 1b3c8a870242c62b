#include "host/live/device.h"

#include <filesystem>
#include <stdexcept>

#include "host/live/device_kind.h"

namespace sphc::host {

std::unique_ptr<Device> openDevice(const std::string &spec, const Wish &wish) {
  const size_t colon = spec.find(':');
  std::string known;
  for (const DeviceKind &kind : deviceKinds()) {
    if (spec.substr(0, colon) == kind.name)
      return kind.open(colon == std::string::npos ? "" : spec.substr(colon + 1), wish);
    known += std::string(known.empty() ? "" : ", ") + kind.name + ":";
  }
  std::error_code unknown;
  const bool is_there = std::filesystem::exists(std::filesystem::u8path(spec), unknown);
  throw std::runtime_error("no such kind of camera: " + spec + "; say " +
                           (is_there ? "replay:" + spec + " for a recording, or " : "") + "one of " + known +
                           " and behind it which, as `spherecloud devices` prints it");
}

}  // namespace sphc::host
