#include "calibration.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "calibration_json.h"
#include "failure.h"
#include "file_reader.h"
#include "file_writer.h"

namespace sphc::recording {

namespace {

constexpr size_t kMostFileBytes = 1 << 20;

sphc_rig parseText(std::string_view text, const std::string &name) {
  try {
    return calibrationFromJson(text);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), name + ": " + failure.what());
  }
}

}  // namespace

const sphc_rig &requireGood(const sphc_rig &rig) {
  sphc_message message = {};
  if (sphc_rig_check(&rig, &message) < 0) throw Failure(SPHC_E_ARGUMENT, message.text);
  return rig;
}

sphc_rig readCalibration(const std::filesystem::path &path) {
  const std::string name = shortPath(path.string());
  Bytes content;
  std::error_code error;  // a folder that may not be looked into is told when the file is read
  if (!std::filesystem::exists(path, error) && error != std::errc::permission_denied)
    throw Failure(SPHC_E_DEVICE, name + ": no such calibration file; write one (docs/drivers.md) or give its path");
  try {
    readFile(path, kMostFileBytes, content);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), name + ": no calibration file: " + failure.what());
  }
  return parseText(textOf(viewOf(content)), name);
}

void writeCalibration(const std::filesystem::path &path, const sphc_rig &rig) {
  requireGood(rig);
  const std::string text = calibrationToJson(rig);
  writeFile(path, {reinterpret_cast<const uint8_t *>(text.data()), text.size()});
}

}  // namespace sphc::recording

using namespace sphc::recording;

extern "C" {

sphc_status sphc_calibration_read(const char *path, sphc_rig *rig, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!path || !rig) throw Failure(SPHC_E_ARGUMENT, "path or rig is null; give both");
    *rig = readCalibration(path);
    return SPHC_OK;
  });
}

sphc_status sphc_calibration_parse(const char *text, size_t bytes, const char *name, sphc_rig *rig,
                                   sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!text || !name || !rig) throw Failure(SPHC_E_ARGUMENT, "text, name or rig is null; give all");
    *rig = parseText({text, bytes}, shortPath(name));
    return SPHC_OK;
  });
}

sphc_status sphc_calibration_write(const char *path, const sphc_rig *rig, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!path || !rig) throw Failure(SPHC_E_ARGUMENT, "path or rig is null; give both");
    writeCalibration(path, *rig);
    return SPHC_OK;
  });
}

}  // extern "C"
