#include "host/calibration/formats.h"

#include "host/calibration/rational6kt.h"
#include "host/cameras/azure_kinect.h"
#include "host/cameras/fault.h"
#include "host/cameras/intrinsics.h"
#include "host/recording/calibration_json.h"

namespace sphc::host {
namespace {

bool contains(const TextFile &file, const char *word) { return file.text.find(word) != std::string::npos; }

CalibrationPart readOwn(const TextFile &file) {
  sphc_rig calibration;
  sphc_rig_init(&calibration);
  sphc_message message = {};
  if (sphc_calibration_parse(file.text.data(), file.text.size(), file.name.c_str(), &calibration, &message) < 0)
    throw std::runtime_error(message.text);
  const sphc_rigid identity = {{1, 0, 0, 0}, {0, 0, 0}};
  return {{{"color", calibration.color_camera, calibration.color_from_depth, {}, {}},
           {"depth", calibration.depth_camera, identity, {}, {}}},
          {},
          calibration.depth_unit_m};
}

}  // namespace

const std::vector<FormatName> &formatNames() {
  static const std::vector<FormatName> kNames = {
      {Format::kSpherecloud, "spherecloud", false, true}, {Format::kOpencv, "opencv", false, false},
      {Format::kKalibr, "kalibr", false, false},          {Format::kRos, "ros", true, false},
      {Format::kColmap, "colmap", true, false},           {Format::kAzureKinect, "azure-kinect", false, false}};
  return kNames;
}

const FormatName &nameOf(Format format) { return formatNames()[static_cast<size_t>(format)]; }

Format detectFormat(const TextFile &file) {
  if (contains(file, "spherecloud-calibration")) return Format::kSpherecloud;
  if (contains(file, "CalibrationInformation")) return Format::kAzureKinect;
  if (contains(file, "%YAML") || contains(file, "opencv-matrix") || contains(file, "opencv_storage"))
    return Format::kOpencv;
  // a ROS camera may be called cam0
  if (contains(file, "distortion_model") && contains(file, "distortion_coefficients")) return Format::kRos;
  if (contains(file, "cam0")) return Format::kKalibr;
  if (contains(file, "distortion_model")) return Format::kRos;
  const size_t name = file.name.rfind("cameras.txt");
  if (name != std::string::npos && name + 11 == file.name.size()) return Format::kColmap;
  refuse(file.name, "the file", "its format cannot be told from its text; say it with --format");
}

bool formatHolds(Format format, const sphc_camera &camera) {
  if (format == Format::kKalibr) return isFisheye(camera) || hasFourCoefficients(camera);
  return format != Format::kAzureKinect || !isFisheye(camera);
}

CalibrationPart readCalibration(Format format, const TextFile &file, const TextFile *rigs) {
  switch (format) {
    case Format::kSpherecloud:
      return readOwn(file);
    case Format::kOpencv:
      return readOpencv(file);
    case Format::kKalibr:
      return readKalibr(file);
    case Format::kRos:
      return readRos(file);
    case Format::kColmap:
      return readColmap(file, rigs);
    case Format::kAzureKinect:
      return withNearestCameras(readAzureKinect(file));
  }
  refuse(file.name, "the file", "unknown format; name one of those that the help lists");
}

std::vector<TextFile> writeCalibration(Format format, const sphc_rig &calibration) {
  switch (format) {
    case Format::kSpherecloud:
      return {{"", recording::calibrationToJson(calibration)}};
    case Format::kOpencv:
      return {{"", opencvText(calibration)}};
    case Format::kKalibr:
      return {{"", kalibrText(calibration)}};
    case Format::kRos:
      return rosTexts(calibration);
    case Format::kColmap:
      return colmapTexts(calibration);
    case Format::kAzureKinect:
      return {{"", azureKinectText(calibration)}};
  }
  return {};
}

}  // namespace sphc::host
