// ROS camera_info as camera_calibration_parsers writes it: one camera a file.
#include "host/calibration/formats.h"
#include "host/calibration/yaml_map.h"
#include "host/cameras/intrinsics.h"
#include "host/cameras/number_text.h"
#include "host/cameras/rigid_matrix.h"

namespace sphc::host {
namespace {

std::string rosMatrix(const std::string &key, size_t rows, size_t cols, const std::vector<double> &data) {
  return key + ":\n  rows: " + std::to_string(rows) + "\n  cols: " + std::to_string(cols) + "\n  data: [" +
         numbersText(data) + "]\n";
}

std::string rosCamera(const std::string &name, const sphc_camera &camera) {
  const std::vector<double> k = matrixFromCamera(camera, kZeroCentered), d = opencvDistortion(camera);
  const char *model = isFisheye(camera) ? "equidistant" : d.size() == 8 ? "rational_polynomial" : "plumb_bob";
  return "image_width: " + std::to_string(camera.width) + "\nimage_height: " + std::to_string(camera.height) +
         "\ncamera_name: " + name + "\n" + rosMatrix("camera_matrix", 3, 3, k) + "distortion_model: " + model +
         "\n" + rosMatrix("distortion_coefficients", 1, d.size(), d) +
         rosMatrix("rectification_matrix", 3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         rosMatrix("projection_matrix", 3, 4, {k[0], 0, k[2], 0, 0, k[4], k[5], 0, 0, 0, 1, 0});
}

}  // namespace

CalibrationPart readRos(const TextFile &file) {
  const YamlMap map = YamlMap::parse(file);
  Intrinsics intrinsics;
  intrinsics.width = map.pixels("image_width");
  intrinsics.height = map.pixels("image_height");
  const YamlMap matrix = map.map("camera_matrix");
  std::string fault =
      intrinsicsFromMatrix(matrix.numbers("data", "[fx, 0, cx, 0, fy, cy, 0, 0, 1]"), kZeroCentered, &intrinsics);
  if (!fault.empty()) matrix.refuse("data", fault);

  NamedCamera camera;
  camera.name = map.has("camera_name") ? map.text("camera_name", "color") : file.name;
  fault = cameraFromRos(intrinsics, map.text("distortion_model", "plumb_bob"),
                        map.map("distortion_coefficients").numbers("data", "[0, 0, 0, 0, 0]"), &camera.camera);
  if (!fault.empty()) map.refuse("distortion_model", "is " + fault);
  return {{camera}, {}, {}};
}

std::vector<TextFile> rosTexts(const sphc_rig &calibration) {
  return {{kRosNames[0], rosCamera("color", calibration.color_camera)},
          {kRosNames[1], rosCamera("depth", calibration.depth_camera)},
          // camera_info has no place for it; in the keys of OpenCV's stereo sample
          {kRosNames[2], "%YAML:1.0\n---\n" + opencvExtrinsics(inverse(calibration.color_from_depth))}};
}

}  // namespace sphc::host
