#include "calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include "calibration_json.h"
#include "failure.h"
#include "file_reader.h"
#include "file_writer.h"

namespace sphc::recording {

namespace {

constexpr ModelName kModels[] = {
    {SPHC_CAMERA_PINHOLE, "pinhole", 4, "fx fy cx cy"},
    {SPHC_CAMERA_BROWN5, "brown5", 9, "fx fy cx cy k1 k2 p1 p2 k3"},
    {SPHC_CAMERA_BROWN8, "brown8", 12, "fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6"},
    {SPHC_CAMERA_KANNALA_BRANDT4, "kannala_brandt4", 8, "fx fy cx cy k1 k2 k3 k4"},
};

constexpr size_t kMostFileBytes = 1 << 20;

sphc_rig parseText(std::string_view text, const std::string &name) {
  try {
    return calibrationFromJson(text);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), name + ": " + failure.what());
  }
}

}  // namespace

const ModelName *findModel(sphc_camera_model model) {
  const auto it =
      std::find_if(std::begin(kModels), std::end(kModels), [&](const ModelName &m) { return m.model == model; });
  return it == std::end(kModels) ? nullptr : it;
}

const ModelName *findModel(std::string_view name) {
  const auto it =
      std::find_if(std::begin(kModels), std::end(kModels), [&](const ModelName &m) { return m.name == name; });
  return it == std::end(kModels) ? nullptr : it;
}

std::string modelNames() {
  std::string names;
  for (const ModelName &model : kModels) names += (names.empty() ? "" : ", ") + std::string(model.name);
  return names;
}

bool isImageSide(double value) {
  return value >= SPHC_CAMERA_MIN_PX && value <= SPHC_CAMERA_MAX_PX && value == std::floor(value);
}

std::string imageSideCure() {
  return "must be a whole number from " + std::to_string(SPHC_CAMERA_MIN_PX) + " to " +
         std::to_string(SPHC_CAMERA_MAX_PX);
}

const sphc_rig &requireGood(const sphc_rig &rig) {
  sphc_message message = {};
  if (sphc_rig_check(&rig, &message) < 0) throw Failure(SPHC_E_ARGUMENT, message.text);
  return rig;
}

sphc_rig readCalibration(const std::filesystem::path &path) {
  const std::string name = shortPath(path.string());
  Bytes content;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
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
