#include "host/cameras/azure_kinect.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/cameras/camera_models.h"
#include "host/cameras/fault.h"
#include "host/cameras/intrinsics.h"
#include "host/cameras/number_text.h"
#include "host/cameras/rigid_matrix.h"

namespace sphc::host {
namespace {

using Json = nlohmann::ordered_json;

// The order of ModelParameters.
enum { kCx, kCy, kFx, kFy, kK1, kK2, kK3, kK4, kK5, kK6, kCenterX, kCenterY, kP2, kP1, kParameterCount };

const char kBrown[] = "CALIBRATION_LensDistortionModelBrownConrady";
const char kRational[] = "CALIBRATION_LensDistortionModelRational6KT";
const char kColorPurpose[] = "CALIBRATION_CameraPurposePhotoVideo";
const char kAccelerometer[] = "CALIBRATION_InertialSensorType_Accelerometer";
const char kDepthPurpose[] = "CALIBRATION_CameraPurposeDepth";

// The modes of the sensor development kit.
const std::vector<ImageMode> kDepthModes = {
    {512, 512, 96, 90, 320, 288}, {1024, 1024, 192, 180, 640, 576}, {512, 512, 0, 0, 512, 512}};
const std::vector<ImageMode> kColorModes = {{1280, 960, 0, 120, 1280, 720},
                                            {1920, 1440, 0, 180, 1920, 1080},
                                            {2560, 1920, 0, 240, 2560, 1440},
                                            {2048, 1536, 0, 0, 2048, 1536},
                                            {3840, 2880, 0, 360, 3840, 2160}};

// A JSON value and where it stands.
class Value {
 public:
  Value(const Json &json, std::string file, std::string path)
      : json_(json), file_(std::move(file)), path_(std::move(path)) {}

  Value at(const char *key) const {
    const std::string path = path_.empty() ? key : path_ + "." + key;
    if (!json_.is_object() || !json_.contains(key))
      refuse(file_, path, "missing; is it an Azure Kinect's raw calibration?");
    return {json_[key], file_, path};
  }
  bool has(const char *key) const { return json_.is_object() && json_.contains(key); }
  std::vector<Value> items() const {
    if (!json_.is_array() || json_.size() > 64) fail("must be a list of at most 64");
    std::vector<Value> result;
    for (size_t i = 0; i < json_.size(); ++i)
      result.emplace_back(json_[i], file_, path_ + "[" + std::to_string(i) + "]");
    return result;
  }
  double number() const {
    if (!json_.is_number() || !std::isfinite(json_.get<double>())) fail("must be a finite number");
    return json_.get<double>();
  }
  std::vector<double> numbers() const {
    std::vector<double> result;
    for (const Value &item : items()) result.push_back(item.number());
    return result;
  }
  uint32_t pixels() const {
    const double value = number();
    if (!isImageSide(value)) fail(imageSideCure());
    return static_cast<uint32_t>(value);
  }
  std::string text() const {
    if (!json_.is_string()) fail("must be a word in quotes");
    return json_.get<std::string>();
  }
  [[noreturn]] void fail(const std::string &why) const { refuse(file_, path_, why); }

 private:
  const Json &json_;
  std::string file_, path_;
};

sphc_rigid sensorFromRig(const Value &sensor) {
  const Value rt = sensor.at("Rt");
  sphc_rigid rigid;
  const std::string fault = rigidFromMatrix(rt.at("Rotation").numbers(), rt.at("Translation").numbers(), &rigid);
  if (!fault.empty()) rt.fail(fault);
  return rigid;
}

NamedCamera readCamera(const Value &value, const char *name, const std::vector<ImageMode> &modes) {
  NamedCamera result;
  result.name = name;
  const uint32_t width = value.at("SensorWidth").pixels(), height = value.at("SensorHeight").pixels();
  const Value model = value.at("Intrinsics").at("ModelType"), list = value.at("Intrinsics").at("ModelParameters");
  const bool rational = model.text() == kRational;
  if (!rational && model.text() != kBrown)
    model.fail("is " + shown(model.text()) + "; known here: " + kBrown + " and " + kRational);
  const std::vector<double> p = list.numbers();
  if (p.size() != kParameterCount && p.size() != kParameterCount + 1)  // the metric radius may follow
    list.fail("has " + std::to_string(p.size()) + " numbers; must be 14");
  if (p[kCenterX] != 0 || p[kCenterY] != 0)
    list.fail(
        "has a centre of distortion of its own (numbers 11 and 12), which no camera model here has; calibrate the "
        "camera with OpenCV");
  const Intrinsics intrinsics = {
      p[kFx] * width, p[kFy] * height, p[kCx] * width + kCornerCentered, p[kCy] * height + kCornerCentered,
      width,          height};
  result.camera = brownCamera(intrinsics, {p[kK1], p[kK2], p[kP1], p[kP2], p[kK3], p[kK4], p[kK5], p[kK6]});
  if (rational && (p[kP1] != 0 || p[kP2] != 0)) result.inexact = "its model Rational6KT is not OpenCV's";
  if ((width == 1024 && height == 1024) || (width == 4096 && height == 3072)) result.modes = modes;

  result.camera_from_rig = sensorFromRig(value);
  return result;
}

Json cameraJson(const sphc_camera &camera, const char *purpose, const char *location,
                const sphc_rigid &camera_from_rig) {
  const double *c = camera.params;
  std::vector<double> d = opencvDistortion(camera);
  d.resize(8);
  const RigidMatrix m = matrixFromRigid(camera_from_rig);
  const std::vector<double> parameters = {(c[2] - kCornerCentered) / camera.width,
                                          (c[3] - kCornerCentered) / camera.height,
                                          c[0] / camera.width,
                                          c[1] / camera.height,
                                          d[0],
                                          d[1],
                                          d[4],
                                          d[5],
                                          d[6],
                                          d[7],
                                          0,
                                          0,
                                          d[3],
                                          d[2]};
  return {{"Intrinsics",
           {{"ModelParameterCount", int{kParameterCount}}, {"ModelParameters", parameters}, {"ModelType", kBrown}}},
          {"Location", location},
          {"Purpose", purpose},
          {"Rt", {{"Rotation", m.rotation}, {"Translation", m.t_m}}},
          {"SensorHeight", camera.height},
          {"SensorWidth", camera.width}};
}

// The kit hands the text out with the zero at its end.
Json parse(const TextFile &file) {
  const size_t end = file.text.find_last_not_of('\0');
  try {
    return Json::parse(file.text.substr(0, end == std::string::npos ? 0 : end + 1));
  } catch (const Json::exception &error) {
    refuse(file.name, "the file", std::string("no valid JSON; copy the file again: ") + error.what());
  }
}

}  // namespace

CalibrationPart readAzureKinect(const TextFile &file) {
  const Json json = parse(file);
  const Value cameras = Value(json, file.name, "").at("CalibrationInformation").at("Cameras");
  CalibrationPart part;
  for (const Value &camera : cameras.items()) {
    const std::string purpose = camera.at("Purpose").text();
    if (purpose == kColorPurpose) part.cameras.push_back(readCamera(camera, "color", kColorModes));
    if (purpose == kDepthPurpose) part.cameras.push_back(readCamera(camera, "depth", kDepthModes));
  }
  if (part.cameras.empty())
    cameras.fail(std::string("has no camera of purpose ") + kColorPurpose + " or " + kDepthPurpose +
                 "; give the raw calibration of the whole device");
  return part;
}

std::optional<sphc_rigid> readAzureKinectAccelerometer(const TextFile &file) {
  const Json json = parse(file);
  const Value all = Value(json, file.name, "").at("CalibrationInformation");
  if (!all.has("InertialSensors")) return {};
  for (const Value &sensor : all.at("InertialSensors").items())
    if (sensor.at("SensorType").text() == kAccelerometer) return sensorFromRig(sensor);
  return {};
}

std::string azureKinectText(const sphc_rig &calibration) {
  const sphc_rigid identity = {{1, 0, 0, 0}, {0, 0, 0}};
  const Json cameras =
      Json::array({cameraJson(calibration.depth_camera, kDepthPurpose, "CALIBRATION_CameraLocationD0", identity),
                   cameraJson(calibration.color_camera, kColorPurpose, "CALIBRATION_CameraLocationPV0",
                              calibration.color_from_depth)});
  const Json json = {{"CalibrationInformation", {{"Cameras", cameras}}}};
  return json.dump(2) + "\n";
}

}  // namespace sphc::host
