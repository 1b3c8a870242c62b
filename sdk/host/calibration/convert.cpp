#include "host/calibration/convert.h"

#include <filesystem>
#include <fstream>

#include "host/base/listed.h"
#include "host/base/regular_file.h"
#include "host/base/text_encoding.h"
#include "host/calibration/nearest_camera.h"
#include "host/cameras/camera_models.h"
#include "host/cameras/fault.h"

namespace sphc::host {
namespace {

constexpr size_t kMostFileBytes = 256 << 10;

TextFile readText(const std::string &path) {
  TextFile file = {path, std::string(kMostFileBytes + 1, '\0')};
  checkIsFile(path, "the calibration file itself");
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw std::runtime_error(path + ": no such file, or it may not be read; check its name and permissions");
  stream.read(file.text.data(), static_cast<std::streamsize>(file.text.size()));
  if (stream.bad()) throw std::runtime_error(path + ": cannot be read to its end; check the disk");
  file.text.resize(static_cast<size_t>(stream.gcount()));
  if (file.text.size() > kMostFileBytes)
    throw std::runtime_error(path + ": over 256 KiB, so no calibration file; give the calibration alone");
  if (isUtf16(file.text)) throw std::runtime_error(path + ": is in UTF-16; save it as UTF-8");
  file.text = withoutByteOrderMark(file.text);
  return file;
}

// COLMAP keeps its rigs beside its cameras.
std::optional<TextFile> readRigs(const std::string &cameras_path) {
  const std::filesystem::path rigs = std::filesystem::path(cameras_path).replace_filename("rigs.txt");
  if (!std::filesystem::exists(rigs)) return {};
  return readText(rigs.string());
}

std::vector<std::string> rosFilesOf(const std::string &folder) {
  std::vector<std::string> files;
  for (const char *name : kRosNames) files.push_back(folder + "/" + name);
  return files;
}

// A folder stands for what is written into one: COLMAP's cameras.txt, or ROS's files.
std::vector<std::string> filesOf(const std::string &path, std::optional<Format> format) {
  if (!std::filesystem::is_directory(path)) return {path};
  const std::string colmap = path + "/cameras.txt", ros = path + "/" + kRosNames[0];
  if (format == Format::kColmap || !std::filesystem::exists(ros)) return {colmap};
  if (format != Format::kRos && std::filesystem::exists(colmap))
    throw std::runtime_error(path + ": holds both " + kRosNames[0] +
                             " of ROS and cameras.txt of COLMAP; say which " +
                             "with --format ros or --format colmap, or name the files");
  return rosFilesOf(path);
}

// ROS has no place for where two cameras are to each other; the file of that is OpenCV's.
Format formatOf(const TextFile &file, std::optional<Format> said) {
  if (!said) return detectFormat(file);
  const bool is_of_both = std::filesystem::path(file.name).filename() == kRosNames[2];
  return said == Format::kRos && is_of_both ? Format::kOpencv : *said;
}

// What of a format may stand in for a camera that it cannot hold.
std::vector<WantedModel> modelsOf(Format format) {
  if (format == Format::kKalibr) return {{SPHC_CAMERA_BROWN5, 8}, {SPHC_CAMERA_KANNALA_BRANDT4, 8}};
  return {{SPHC_CAMERA_BROWN8, 12}};
}

sphc_camera fitCamera(const sphc_camera &camera, const char *role, Format format, bool approximate) {
  if (formatHolds(format, camera)) return camera;
  if (!approximate)
    throw std::runtime_error(std::string(nameOf(format).name) + " cannot hold the " + role + " camera's model, " +
                             findModel(camera.model)->name +
                             ", exactly; choose another format, or accept the nearest with --approximate");
  const std::vector<RaySample> samples = sampleCamera(camera);
  if (samples.empty())
    throw std::runtime_error(std::string("the ") + role + " camera sees nothing; check its parameters");
  std::optional<NearestCamera> best;
  for (const WantedModel wanted : modelsOf(format)) {
    const NearestCamera nearest = nearestCamera(samples, wanted, camera);
    if (!best || nearest.rms_px < best->rms_px) best = nearest;
  }
  return best->camera;
}

}  // namespace

ReadCalibration readCalibrationFiles(const std::vector<std::string> &paths, std::optional<Format> format,
                                     const JoinOptions &options) {
  ReadCalibration result = {};
  std::vector<CalibrationPart> parts;
  std::vector<std::string> files;
  for (const std::string &path : paths)
    for (const std::string &file : filesOf(path, format)) files.push_back(file);
  for (const std::string &path : files) {
    const TextFile file = readText(path);
    const Format own = formatOf(file, format);
    const std::optional<TextFile> rigs = own == Format::kColmap ? readRigs(file.name) : std::nullopt;
    parts.push_back(readCalibration(own, file, rigs ? &*rigs : nullptr));
    result.files.push_back({file.name, own});
  }
  try {
    result.calibration = joinParts(parts, options);
  } catch (const std::runtime_error &error) {  // which knows cameras, and no files
    throw std::runtime_error(listed(files) + ": " + error.what());
  }
  return result;
}

sphc_rig fitToFormat(const sphc_rig &calibration, Format format, bool approximate) {
  sphc_rig result = calibration;
  result.color_camera = fitCamera(calibration.color_camera, "colour", format, approximate);
  result.depth_camera = fitCamera(calibration.depth_camera, "depth", format, approximate);
  return result;
}

}  // namespace sphc::host
