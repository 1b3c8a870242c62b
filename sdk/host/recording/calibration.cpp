#include "calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "calibration_json.h"
#include "failure.h"

namespace sphc::replay {

namespace {

constexpr ModelName kModels[] = {
    {SPHC_CAMERA_PINHOLE, "pinhole", 4, "fx fy cx cy"},
    {SPHC_CAMERA_BROWN5, "brown5", 9, "fx fy cx cy k1 k2 p1 p2 k3"},
    {SPHC_CAMERA_BROWN8, "brown8", 12, "fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6"},
    {SPHC_CAMERA_KANNALA_BRANDT4, "kannala_brandt4", 8, "fx fy cx cy k1 k2 k3 k4"},
};

constexpr size_t kMostFileBytes = 1 << 20;

std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string cameraFault(const sphc_camera &camera, const std::string &key) {
  const ModelName *model = findModel(camera.model);
  if (!model) return key + ".model: is " + std::to_string(camera.model) + "; known: " + modelNames();
  if (camera.param_count != model->param_count)
    return key + ".params: has " + std::to_string(camera.param_count) + " numbers; " + model->name + " takes " +
           std::to_string(model->param_count) + ": " + model->params;
  if (std::min(camera.width, camera.height) < 16 || std::max(camera.width, camera.height) > 8192)
    return key + ": is " + std::to_string(camera.width) + " x " + std::to_string(camera.height) +
           "; width and height must be 16 to 8192";
  if (!std::all_of(camera.params, camera.params + camera.param_count, [](double x) { return std::isfinite(x); }))
    return key + ".params: not finite; give numbers";
  if (camera.params[0] <= 0 || camera.params[1] <= 0)
    return key + ".params: fx " + numberText(camera.params[0]) + ", fy " + numberText(camera.params[1]) +
           "; both must be greater than 0, in pixels";
  return {};
}

std::string rigidFault(const sphc_rigid &rigid) {
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(rigid.t_m, rigid.t_m + 3, finite)) return "color_from_depth.t_m: not finite; give metres";
  double squared = 0;
  for (const double x : rigid.q_wxyz) squared += x * x;
  if (!(std::fabs(std::sqrt(squared) - 1.0) <= 1e-3))
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

std::string readFile(const char *path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string name = shortPath(path);
  if (!stream || !std::filesystem::is_regular_file(path))
    throw Failure(SPHC_E_DEVICE, name + ": no such calibration file; write one (docs/drivers.md) or give its path");
  std::string text(kMostFileBytes, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) throw Failure(SPHC_E_DEVICE, name + ": cannot be read");
  if (!stream.eof()) throw Failure(SPHC_E_ARGUMENT, name + ": over 1 MiB: no calibration file");
  text.resize(static_cast<size_t>(stream.gcount()));
  return text;
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
  if (fault.empty() && !(unit >= 1e-6 && unit <= 1))
    fault = "depth_unit_m: is " + numberText(unit) + "; must be 1e-6 to 1 (0.001 for millimetres)";
  return fault;
}

}  // namespace sphc::replay

using namespace sphc::replay;

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
    const std::string fault = calibrationFault(*calibration);
    if (!fault.empty()) throw Failure(SPHC_E_ARGUMENT, fault);
    return SPHC_OK;
  });
}

sphc_status sphc_calibration_read(const char *path, sphc_calibration *calibration, sphc_message *message) {
  return guarded(message, [&]() -> sphc_status {
    if (!path || !calibration) throw Failure(SPHC_E_ARGUMENT, "path or calibration is null");
    if (calibration->struct_size != sizeof *calibration) return badSize(message);
    *calibration = parseText(readFile(path), shortPath(path));
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
    std::ofstream stream(path, std::ios::binary | std::ios::trunc);
    stream << calibrationToJson(*calibration) << std::flush;
    if (!stream)
      throw Failure(SPHC_E_DEVICE, shortPath(path) + ": cannot be written; is there room and permission?");
    return SPHC_OK;
  });
}

}  // extern "C"
