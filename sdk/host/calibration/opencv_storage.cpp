// OpenCV's FileStorage (YAML, JSON or XML): the keys of its calibration sample, and of its stereo sample.
#include <cmath>
#include <opencv2/core/persistence.hpp>
#include <opencv2/core/utility.hpp>
#include <set>
#include <stdexcept>

#include "host/calibration/formats.h"
#include "host/cameras/camera_models.h"
#include "host/cameras/fault.h"
#include "host/cameras/intrinsics.h"
#include "host/cameras/number_text.h"
#include "host/cameras/rigid_matrix.h"

namespace sphc::host {
namespace {

constexpr size_t kMostElements = 64;
constexpr size_t kDeepest = 500;  // levels, which OpenCV's parser calls itself for

// Is it nested so deeply that OpenCV's parser would use up the stack?  Of brackets and tags the levels are counted.
// In YAML a line can open levels without them, as in "- - -" and "a: a: a:"; there its signs are counted.
bool isTooDeep(const std::string &text) {
  const bool is_yaml = text.rfind("%YAML", 0) == 0;
  size_t depth = 0, signs = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : '\0';
    const bool closes_tag = c == '/' && next == '>';
    if (c == '[' || c == '{' || (c == '<' && next != '/' && next != '!' && next != '?')) ++depth;
    if ((c == ']' || c == '}' || (c == '<' && next == '/') || closes_tag) && depth > 0) --depth;
    if (c == '\n') signs = 0;
    if (is_yaml && (c == ':' || (c == '-' && depth == 0))) ++signs;
    if (depth + signs > kDeepest) return true;
  }
  return false;
}

// OpenCV prints what it throws; we say it once, with the file's name.
class QuietOpencv {
 public:
  QuietOpencv() : before_(cv::redirectError(ignore, nullptr, &before_data_)) {}
  ~QuietOpencv() { cv::redirectError(before_, before_data_); }
  QuietOpencv(const QuietOpencv &) = delete;
  QuietOpencv &operator=(const QuietOpencv &) = delete;

 private:
  static int ignore(int, const char *, const char *, const char *, int, void *) { return 0; }
  void *before_data_ = nullptr;
  cv::ErrorCallback before_;
};

class Reader {
 public:
  explicit Reader(const TextFile &file)
      : name_(file.name), storage_(file.text, cv::FileStorage::READ | cv::FileStorage::MEMORY) {
    std::set<std::string> seen;
    for (const std::string &key : storage_.root().keys()) {
      if (!seen.insert(key).second) fail(shown(key), "given twice; remove one");
    }
  }

  bool has(const std::string &key) const { return !storage_[key].empty(); }

  // The first of the names that is there; the first of all if none is.
  std::string choose(const std::vector<std::string> &names) const {
    for (const std::string &name : names) {
      if (has(name)) return name;
    }
    return names.front();
  }

  // Of a matrix, which OpenCV need not make: the file may say any size.
  std::vector<double> numbers(const std::string &key) const {
    const cv::FileNode node = storage_[key];
    if (node.empty()) fail(key, "missing; add it, as OpenCV's calibration samples write it");
    const cv::FileNode data = node.isMap() ? node["data"] : node;
    if (!data.isSeq() || data.size() > kMostElements) fail(key, "must be a matrix with rows, cols and data");
    std::vector<double> result;
    for (const cv::FileNode value : data) {
      if (!value.isInt() && !value.isReal()) fail(key, "holds something that is no number; write the file anew");
      result.push_back(value.real());
      if (!std::isfinite(result.back())) fail(key, "holds a number that is not finite; calibrate again");
    }
    if (node.isMap()) checkShape(key, node, result.size());
    return result;
  }

  // 0 when the file does not say it.
  uint32_t pixels(const std::string &key) const {
    const cv::FileNode node = storage_[key];
    if (node.empty()) return 0;
    const double value = node.isInt() ? node.real() : -1;
    if (!isImageSide(value)) fail(key, imageSideCure());
    return static_cast<uint32_t>(value);
  }

  bool flag(const std::string &key) const {
    const cv::FileNode node = storage_[key];
    if (node.empty()) return false;
    if (!node.isInt()) fail(key, "must be 0 or 1");
    return node.real() != 0;
  }

  [[noreturn]] void fail(const std::string &key, const std::string &why) const { refuse(name_, key, why); }

 private:
  void checkShape(const std::string &key, const cv::FileNode &node, size_t count) const {
    const cv::FileNode rows = node["rows"], cols = node["cols"];
    if (!rows.isInt() || !cols.isInt() || rows.real() * cols.real() != static_cast<double>(count))
      fail(key, "has " + std::to_string(count) + " numbers, which is not rows x cols; correct these");
  }

  std::string name_;
  cv::FileStorage storage_;
};

struct Keys {
  std::string matrix, distortion, width, height, fisheye;
};

NamedCamera readCamera(const Reader &reader, const std::string &name, const Keys &keys) {
  Intrinsics intrinsics;
  intrinsics.width = reader.pixels(keys.width);
  intrinsics.height = reader.pixels(keys.height);
  NamedCamera camera;
  camera.name = name;
  std::string fault = intrinsicsFromMatrix(reader.numbers(keys.matrix), kZeroCentered, &intrinsics);
  if (!fault.empty()) reader.fail(keys.matrix, fault);
  fault = cameraFromOpencv(intrinsics, reader.numbers(keys.distortion), reader.flag(keys.fisheye), &camera.camera);
  if (!fault.empty()) reader.fail(keys.distortion, fault);
  return camera;
}

Keys stereoKeys(const Reader &reader, const std::string &n) {
  return {reader.choose({"M" + n, "K" + n}), "D" + n, reader.choose({"image_width" + n, "image_width"}),
          reader.choose({"image_height" + n, "image_height"}),
          reader.choose({"fisheye_model" + n, "fisheye_model"})};
}

CalibrationPart read(const TextFile &file) {
  const Reader reader(file);
  CalibrationPart part;
  if (reader.has("M1") || reader.has("K1")) {
    for (const char *n : {"1", "2"}) part.cameras.push_back(readCamera(reader, n, stereoKeys(reader, n)));
  } else if (reader.has("camera_matrix")) {
    part.cameras.push_back(
        readCamera(reader, file.name,
                   {"camera_matrix", "distortion_coefficients", "image_width", "image_height", "fisheye_model"}));
  }
  if (reader.has("R") || reader.has("T")) {
    sphc_rigid rigid;
    const std::string fault = rigidFromMatrix(reader.numbers("R"), reader.numbers("T"), &rigid);
    if (!fault.empty()) reader.fail("R, T", fault);
    part.second_from_first = rigid;
  }
  if (part.cameras.empty() && !part.second_from_first)
    reader.fail("camera_matrix", "missing, and M1 or K1, and R and T; one of them must be there");
  return part;
}

std::string opencvMatrix(const std::string &key, int rows, const std::vector<double> &data) {
  return key + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
         "\n   cols: " + std::to_string(data.size() / static_cast<size_t>(rows)) + "\n   dt: d\n   data: [ " +
         numbersText(data) + " ]\n";
}

std::string opencvCamera(const std::string &n, const sphc_camera &camera) {
  return "image_width" + n + ": " + std::to_string(camera.width) + "\nimage_height" + n + ": " +
         std::to_string(camera.height) + "\nfisheye_model" + n + ": " + (isFisheye(camera) ? "1" : "0") + "\n" +
         opencvMatrix("M" + n, 3, matrixFromCamera(camera, kZeroCentered)) +
         opencvMatrix("D" + n, 1, opencvDistortion(camera));
}

}  // namespace

CalibrationPart readOpencv(const TextFile &file) {
  const QuietOpencv quiet;
  if (isTooDeep(file.text)) refuse(file.name, "the file", "is nested too deeply for a calibration; write it anew");
  const char *what = "no valid OpenCV FileStorage, which begins with %YAML:1.0, { or <?xml; write the file anew: ";
  try {
    return read(file);
  } catch (const cv::Exception &error) {
    refuse(file.name, "the file", what + error.err);
  } catch (const std::logic_error &error) {  // its parser has these too
    refuse(file.name, "the file", what + std::string(error.what()));
  }
}

std::string opencvExtrinsics(const sphc_rigid &depth_from_color) {
  const RigidMatrix m = matrixFromRigid(depth_from_color);
  return "# x_2 = R x_1 + T, metres; 1: colour, 2: depth\n" + opencvMatrix("R", 3, m.rotation) +
         opencvMatrix("T", 3, m.t_m);
}

std::string opencvText(const sphc_rig &calibration) {
  return "%YAML:1.0\n---\n" + opencvCamera("1", calibration.color_camera) +
         opencvCamera("2", calibration.depth_camera) + opencvExtrinsics(inverse(calibration.color_from_depth));
}

}  // namespace sphc::host
