// Kalibr's camchain.yaml: cameras cam0, cam1, ... of which each holds the transform from the one before it.
#include <algorithm>

#include "host/calibration/formats.h"
#include "host/calibration/yaml_map.h"
#include "host/cameras/camera_models.h"
#include "host/cameras/fault.h"
#include "host/cameras/intrinsics.h"
#include "host/cameras/number_text.h"
#include "host/cameras/rigid_matrix.h"

namespace sphc::host {
namespace {

constexpr size_t kMostCameras = 32;

sphc_camera readCamera(const YamlMap &map) {
  const std::string model = map.text("camera_model", "pinhole");
  if (model != "pinhole")
    map.refuse("camera_model",
               "is " + shown(model) + "; known here: pinhole; calibrate with pinhole-radtan or pinhole-equi");
  const std::vector<double> k = map.numbers("intrinsics", "[fu, fv, pu, pv]");
  if (k.size() != 4)
    map.refuse("intrinsics", "has " + std::to_string(k.size()) + " numbers; pinhole takes 4: fu fv pu pv");
  const std::vector<double> size = map.numbers("resolution", "[640, 480]");
  if (size.size() != 2 || !std::all_of(size.begin(), size.end(), isImageSide))
    map.refuse("resolution", "must be [width, height]; each " + imageSideCure());
  const Intrinsics intrinsics = {k[0],
                                 k[1],
                                 k[2] + kZeroCentered,
                                 k[3] + kZeroCentered,
                                 static_cast<uint32_t>(size[0]),
                                 static_cast<uint32_t>(size[1])};
  const std::string distortion = map.text("distortion_model", "radtan");
  std::vector<double> coefficients;
  if (distortion != "none") coefficients = map.numbers("distortion_coeffs", "[0, 0, 0, 0]");
  if (distortion != "radtan" && distortion != "equidistant" && distortion != "none")
    map.refuse("distortion_model", "is " + shown(distortion) + "; known here: radtan, equidistant, none");
  if (distortion != "none" && coefficients.size() != 4)
    map.refuse("distortion_coeffs",
               "has " + std::to_string(coefficients.size()) + " numbers; " + distortion + " takes 4");
  sphc_camera camera;
  const std::string fault = cameraFromOpencv(intrinsics, coefficients, distortion == "equidistant", &camera);
  if (!fault.empty()) map.refuse("distortion_coeffs", fault);
  return camera;
}

sphc_rigid readTransform(const YamlMap &map, const std::string &key) {
  const std::vector<double> m = map.numbers(key, "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]");
  if (m.size() != 16 || m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
    map.refuse(key, "must be 4 rows of 4 numbers, the last 0 0 0 1");
  sphc_rigid rigid;
  const std::string fault =
      rigidFromMatrix({m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}, {m[3], m[7], m[11]}, &rigid);
  if (!fault.empty()) map.refuse(key, fault);
  return rigid;
}

std::string kalibrCamera(const std::string &name, const sphc_camera &camera) {
  const std::vector<double> k = matrixFromCamera(camera, kZeroCentered);
  std::vector<double> distortion = opencvDistortion(camera);
  distortion.resize(4);
  return name + ":\n  camera_model: pinhole\n  intrinsics: [" + numbersText({k[0], k[4], k[2], k[5]}) +
         "]\n  distortion_model: " + (isFisheye(camera) ? "equidistant" : "radtan") + "\n  distortion_coeffs: [" +
         numbersText(distortion) + "]\n  resolution: [" + std::to_string(camera.width) + ", " +
         std::to_string(camera.height) + "]\n";
}

}  // namespace

CalibrationPart readKalibr(const TextFile &file) {
  const YamlMap chain = YamlMap::parse(file);
  CalibrationPart part;
  sphc_rigid camera_from_cam0 = {{1, 0, 0, 0}, {0, 0, 0}};
  for (size_t i = 0; i < kMostCameras && chain.has("cam" + std::to_string(i)); ++i) {
    NamedCamera camera;
    camera.name = "cam" + std::to_string(i);
    const YamlMap map = chain.map(camera.name);
    if (i > 0) {
      const sphc_rigid step = readTransform(map, "T_cn_cnm1");
      sphc_rigid_compose(&step, &camera_from_cam0, &camera_from_cam0);
    }
    camera.camera = readCamera(map);
    camera.camera_from_rig = camera_from_cam0;
    part.cameras.push_back(std::move(camera));
  }
  if (part.cameras.empty()) chain.refuse("cam0", "missing; a Kalibr camchain begins with it");
  return part;
}

std::string kalibrText(const sphc_rig &calibration) {
  const RigidMatrix m = matrixFromRigid(inverse(calibration.color_from_depth));
  std::string text = "# cam0: colour, cam1: depth\n" + kalibrCamera("cam0", calibration.color_camera) +
                     kalibrCamera("cam1", calibration.depth_camera) + "  T_cn_cnm1:\n";
  for (int i = 0; i < 3; ++i)
    text +=
        "  - [" + numbersText({m.rotation[3 * i], m.rotation[3 * i + 1], m.rotation[3 * i + 2], m.t_m[i]}) + "]\n";
  return text + "  - [0.0, 0.0, 0.0, 1.0]\n";
}

}  // namespace sphc::host
