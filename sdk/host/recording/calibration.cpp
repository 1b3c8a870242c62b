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
// Limits of the runtime's config.
constexpr double kMostSquaredError = 2e-3;  // of the quaternion's length
constexpr double kMostOffsetM = 100;
constexpr double kLeastUnitM = 1e-6, kMostUnitM = 0.1;

std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// The runtime's own check, so that what is read here is taken there.
std::string cameraFault(const sphc_camera &camera, const std::string &key) {
  sphc_message message = {};
  return sphc_camera_check(&camera, &message) == SPHC_OK ? "" : key + ": " + message.text;
}

std::string rigidFault(const sphc_rigid &rigid) {
  const auto is_near = [](double x) { return std::fabs(x) <= kMostOffsetM; };
  if (!std::all_of(rigid.t_m, rigid.t_m + 3, is_near))
    return "color_from_depth.t_m: not finite, or beyond " + numberText(kMostOffsetM) + " m; give metres";
  double squared = 0;
  for (const double x : rigid.q_wxyz) squared += x * x;
  if (!(std::fabs(squared - 1.0) <= kMostSquaredError))
    return "color_from_depth.q_wxyz: length " + numberText(std::sqrt(squared)) +
           "; must be 1 (order w x y z), divide by its length";
  return {};
}

sphc_calibration parseText(std::string_view text, const std::string &name) {
  try {
    return calibrationFromJson(text);
  } catch (const Failure &failure) {
    throw Failure(failure.status(), name + ": " + failure.what());
  }
}

void requireGood(const sphc_calibration &calibration) {
  const std::string fault = calibrationFault(calibration);
  if (!fault.empty()) throw Failure(SPHC_E_ARGUMENT, fault);
}

sphc_status badSize(sphc_message *message) {
  setMessage(message, "struct_size is none this library knows; set it to sizeof (sphc_calibration_init does)");
  return SPHC_E_STRUCT_SIZE;
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

std::string calibrationFault(const sphc_calibration &calibration) {
  std::string fault = cameraFault(calibration.color_camera, "color_camera");
  if (fault.empty()) fault = cameraFault(calibration.depth_camera, "depth_camera");
  if (fault.empty()) fault = rigidFault(calibration.color_from_depth);
  const double unit = calibration.depth_unit_m;
  if (fault.empty() && !(unit >= kLeastUnitM && unit <= kMostUnitM))
    fault = "depth_unit_m: is " + numberText(unit) + "; must be 1e-6 to 0.1 (0.001 for millimetres)";
  return fault;
}

sphc_calibration readCalibration(const std::filesystem::path &path) {
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

void writeCalibration(const std::filesystem::path &path, const sphc_calibration &calibration) {
  requireGood(calibration);
  const std::string text = calibrationToJson(calibration);
  writeFile(path, {reinterpret_cast<const uint8_t *>(text.data()), text.size()});
}

}  // namespace sphc::recording

using namespace sphc::recording;

extern "C" {

sphc_status sphc_calibration_init(sphc_calibration *calibration, size_t struct_size) {
  if (!calibration) return SPHC_E_ARGUMENT;
  if (struct_size != sizeof *calibration) return SPHC_E_STRUCT_SIZE;
  *calibration = {};
  calibration->struct_size = sizeof *calibration;
  calibration->color_from_depth.q_wxyz[0] = 1;
  calibration->depth_unit_m = 0.001;
  return SPHC_OK;
}

sphc_status sphc_calibration_check(const sphc_calibration *calibration, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!calibration) throw Failure(SPHC_E_ARGUMENT, "calibration is null");
    if (calibration->struct_size != sizeof *calibration) return badSize(message);
    requireGood(*calibration);
    return SPHC_OK;
  });
}

sphc_status sphc_calibration_read(const char *path, sphc_calibration *calibration, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!path || !calibration) throw Failure(SPHC_E_ARGUMENT, "path or calibration is null");
    if (calibration->struct_size != sizeof *calibration) return badSize(message);
    *calibration = readCalibration(path);
    return SPHC_OK;
  });
}

sphc_status sphc_calibration_parse(const char *text, size_t bytes, const char *name, sphc_calibration *calibration,
                                   sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!text || !name || !calibration) throw Failure(SPHC_E_ARGUMENT, "text, name or calibration is null");
    if (calibration->struct_size != sizeof *calibration) return badSize(message);
    *calibration = parseText({text, bytes}, shortPath(name));
    return SPHC_OK;
  });
}

sphc_status sphc_calibration_write(const char *path, const sphc_calibration *calibration, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!path) throw Failure(SPHC_E_ARGUMENT, "path is null");
    const sphc_status status = sphc_calibration_check(calibration, message);
    if (status < 0) return status;
    writeCalibration(path, *calibration);
    return SPHC_OK;
  });
}

}  // extern "C"
