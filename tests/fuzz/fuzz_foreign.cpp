#include <stdexcept>

#include "host/calibration/formats.h"
#include "host/cameras/join.h"
#include "tests/fuzz/targets.h"

namespace sphc::fuzz {
namespace {

using namespace sphc::host;

void readAndJoin(Format format, const TextFile &file, const TextFile *rigs) {
  const CalibrationPart part = readCalibration(format, file, rigs);
  if (part.cameras.empty() && !part.second_from_first) broken("a file that is read tells something");
  JoinOptions options;
  options.approximate = true;
  options.registered = part.cameras.size() == 1;
  const sphc_rig joined = joinParts({part}, options);
  sphc_message message = {};
  if (sphc_rig_check(&joined, &message) != SPHC_OK) broken("what is joined passes the check");
  if (formatHolds(format, joined.color_camera) && formatHolds(format, joined.depth_camera) &&
      writeCalibration(format, joined).empty())
    broken("what a format holds is written");
  accept();
}

}  // namespace

void foreign(const uint8_t *data, size_t bytes) {
  if (bytes == 0) return;
  const Format format = formatNames()[data[0] % formatNames().size()].format;
  const std::string text(data + 1, data + bytes);
  const size_t zero = format == Format::kColmap ? text.find('\0') : std::string::npos;
  const TextFile file = {"fuzz", text.substr(0, zero)};
  const TextFile rigs = {"rigs", zero == std::string::npos ? "" : text.substr(zero + 1)};
  try {
    readAndJoin(format, file, zero == std::string::npos ? nullptr : &rigs);
  } catch (const std::runtime_error &error) {
    if (!*error.what()) broken("a refusal explains itself");
  }
}

}  // namespace sphc::fuzz
