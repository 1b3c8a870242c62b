#include "calibration_json.h"

#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "failure.h"
#include "host/base/text_encoding.h"
#include "host/cameras/camera_models.h"
#include "host/cameras/rigid_matrix.h"
#include "pose_track.h"

namespace sphc::recording {

using Json = nlohmann::ordered_json;

bool isRegistered(const sphc_rig &rig) {
  const sphc_camera &a = rig.color_camera;
  const sphc_camera &b = rig.depth_camera;
  constexpr sphc_rigid kIdentity = {{1, 0, 0, 0}, {0, 0, 0}};
  const sphc_rigid &color_from_depth = rig.color_from_depth;
  return a.model == b.model && a.width == b.width && a.height == b.height &&
         std::equal(a.params, a.params + 12, b.params) &&
         std::equal(color_from_depth.q_wxyz, color_from_depth.q_wxyz + 4, kIdentity.q_wxyz) &&
         std::equal(color_from_depth.t_m, color_from_depth.t_m + 3, kIdentity.t_m);
}

namespace {

constexpr int kDeepest = 16;  // a calibration has three levels; what writes a value out again calls itself

[[noreturn]] void fail(const std::string &key, const std::string &text) {
  throw Failure(SPHC_E_ARGUMENT, key + ": " + text);
}

// Parses, refusing a key given twice in one object (the parser itself would take the last), and what is nested
// deeply.
Json parseJson(std::string_view text) {
  if (host::isUtf16(text)) fail("the file", "is in UTF-16; save it as UTF-8");
  std::map<int, std::set<std::string>> seen;
  const auto watch = [&seen](int depth, Json::parse_event_t event, Json &value) {
    if (depth > kDeepest) fail("the file", "is nested too deeply for a calibration; write it anew");
    if (event == Json::parse_event_t::object_start) seen[depth + 1].clear();
    if (event == Json::parse_event_t::key && !seen[depth].insert(value.get<std::string>()).second)
      fail(value.get<std::string>(), "given twice; remove one");
    return true;
  };
  try {
    return Json::parse(text.begin(), text.end(), watch);
  } catch (const Json::exception &error) {
    std::string cause = error.what();
    const size_t skip = cause.find("] ");  // behind "[json.exception.parse_error.101] "
    if (skip != std::string::npos) cause.erase(0, skip + 2);
    throw Failure(SPHC_E_ARGUMENT, "not valid JSON (numbers must be finite): " + cause);
  }
}

// An object whose keys are looked at one by one; whatever is left over is unknown.
class ObjectReader {
 public:
  ObjectReader(const Json &json, std::string path) : json_(json), path_(std::move(path)) {
    if (!json_.is_object()) fail(path_.empty() ? "the file" : path_, "must be an object {...}");
  }

  std::string path(const char *key) const { return path_.empty() ? key : path_ + "." + key; }

  const Json *find(const char *key) {
    known_.insert(key);
    const auto it = json_.find(key);
    return it == json_.end() ? nullptr : &*it;
  }

  const Json &require(const char *key, const char *example) {
    const Json *value = find(key);
    if (!value) fail(path(key), std::string("missing; add it, as in ") + example);
    return *value;
  }

  double number(const char *key, const char *example) { return numberOf(require(key, example), path(key)); }

  std::vector<double> numbers(const char *key, const char *example) {
    const Json &value = require(key, example);
    if (!value.is_array()) fail(path(key), std::string("must be a list of numbers, as in ") + example);
    std::vector<double> result;
    for (size_t i = 0; i < value.size(); ++i)
      result.push_back(numberOf(value[i], path(key) + "[" + std::to_string(i) + "]"));
    return result;
  }

  uint32_t pixels(const char *key) {
    const Json &value = require(key, "640");
    if (!value.is_number_unsigned() || !host::isImageSide(value.get<double>()))
      fail(path(key), "is " + shown(value) + "; " + host::imageSideCure());
    return value.get<uint32_t>();
  }

  // Call last.
  void refuseOthers() const {
    for (const auto &item : json_.items()) {
      if (known_.count(item.key())) continue;
      std::string expected;
      for (const std::string &key : known_) expected += (expected.empty() ? "" : ", ") + key;
      fail(path(item.key().substr(0, 40).c_str()), "unknown key; known here: " + expected);
    }
  }

  static std::string shown(const Json &value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 40);
  }

 private:
  static double numberOf(const Json &value, const std::string &path) {
    if (!value.is_number()) fail(path, "is " + shown(value) + "; must be a number");
    const double number = value.get<double>();
    if (!std::isfinite(number)) fail(path, "must be finite");
    return number;
  }

  const Json &json_;
  std::string path_;
  std::set<std::string> known_;
};

sphc_camera readCamera(const Json &json, const std::string &key, double pixel_shift) {
  ObjectReader reader(json, key);
  const Json &model_json = reader.require("model", "\"pinhole\"");
  const host::ModelName *model = model_json.is_string() ? host::findModel(model_json.get<std::string>()) : nullptr;
  if (!model) fail(key + ".model", "is " + ObjectReader::shown(model_json) + "; known: " + host::modelNames());
  sphc_camera camera{};
  camera.model = model->model;
  camera.width = reader.pixels("width");
  camera.height = reader.pixels("height");
  camera.param_count = model->param_count;
  const std::vector<double> params = reader.numbers("params", "[500, 500, 320, 240]");
  if (params.size() != model->param_count)
    fail(key + ".params", "has " + std::to_string(params.size()) + " numbers; " + model->name + " takes " +
                              std::to_string(model->param_count) + ": " + model->params);
  std::copy(params.begin(), params.end(), camera.params);
  camera.params[2] += pixel_shift;
  camera.params[3] += pixel_shift;
  reader.refuseOthers();
  return camera;
}

sphc_rigid readRigid(const Json &json, const std::string &key) {
  ObjectReader reader(json, key);
  const std::vector<double> q = reader.numbers("q_wxyz", "[1, 0, 0, 0]");
  const std::vector<double> t = reader.numbers("t_m", "[0, 0, 0]");
  if (q.size() != 4) fail(key + ".q_wxyz", "has " + std::to_string(q.size()) + " numbers; must be 4: w x y z");
  if (t.size() != 3) fail(key + ".t_m", "has " + std::to_string(t.size()) + " numbers; must be 3: x y z in metres");
  reader.refuseOthers();
  return {{q[0], q[1], q[2], q[3]}, {t[0], t[1], t[2]}};
}

void readHeader(ObjectReader &reader) {
  const Json &format = reader.require("format", "\"spherecloud-calibration\"");
  if (format != "spherecloud-calibration")
    fail("format", "is " + ObjectReader::shown(format) + "; must be \"spherecloud-calibration\"");
  const Json &version = reader.require("version", "1");
  if (version != 1) fail("version", "is " + ObjectReader::shown(version) + "; this library reads 1");
}

double readPixelShift(ObjectReader &reader) {
  const double center = reader.number("pixel_center", "0.5 (COLMAP) or 0 (OpenCV)");
  if (center != 0.5 && center != 0.0)
    fail("pixel_center", "must be 0.5 (COLMAP: the first pixel's centre) or 0 (OpenCV)");
  return 0.5 - center;
}

// Depth camera and transform; "depth_registered": true stands for both.
void readDepthSide(ObjectReader &reader, double pixel_shift, sphc_rig &rig) {
  const Json *registered = reader.find("depth_registered");
  if (registered && !registered->is_boolean()) fail("depth_registered", "must be true or false");
  const bool is_registered = registered && registered->get<bool>();
  rig.depth_camera = rig.color_camera;
  rig.color_from_depth = {{1, 0, 0, 0}, {0, 0, 0}};
  if (!is_registered || reader.find("depth_camera"))
    rig.depth_camera = readCamera(reader.require("depth_camera", "color_camera, or \"depth_registered\": true"),
                                  "depth_camera", pixel_shift);
  if (!is_registered || reader.find("color_from_depth"))
    rig.color_from_depth = readRigid(
        reader.require("color_from_depth", "{\"q_wxyz\": [1, 0, 0, 0], \"t_m\": [0, 0, 0]}"), "color_from_depth");
  if (is_registered && !isRegistered(rig))
    fail("depth_registered", "true, but depth_camera or color_from_depth differ; remove them or say false");
}

Json cameraToJson(const sphc_camera &camera) {
  return {{"model", host::findModel(camera.model)->name},
          {"width", camera.width},
          {"height", camera.height},
          {"params", std::vector<double>(camera.params, camera.params + camera.param_count)}};
}

}  // namespace

sphc_rig calibrationFromJson(std::string_view text) {
  const Json json = parseJson(text);
  ObjectReader reader(json, "");
  readHeader(reader);
  const double pixel_shift = readPixelShift(reader);
  sphc_rig rig{};
  rig.color_camera = readCamera(reader.require("color_camera", "docs/drivers.md"), "color_camera", pixel_shift);
  readDepthSide(reader, pixel_shift, rig);
  rig.depth_unit_m = reader.number("depth_unit_m", "0.001");
  reader.refuseOthers();
  requireGood(rig);
  host::normalizeQuaternion(rig.color_from_depth.q_wxyz, 1.0);
  return rig;
}

std::string calibrationToJson(const sphc_rig &rig) {
  const sphc_rigid &rigid = rig.color_from_depth;
  Json json = {{"format", "spherecloud-calibration"},
               {"version", 1},
               {"pixel_center", 0.5},
               {"color_camera", cameraToJson(rig.color_camera)},
               {"depth_camera", cameraToJson(rig.depth_camera)},
               {"color_from_depth",
                {{"q_wxyz", std::vector<double>(rigid.q_wxyz, rigid.q_wxyz + 4)},
                 {"t_m", std::vector<double>(rigid.t_m, rigid.t_m + 3)}}},
               {"depth_unit_m", rig.depth_unit_m}};
  if (isRegistered(rig)) json["depth_registered"] = true;
  return json.dump(2) + "\n";
}

}  // namespace sphc::recording
