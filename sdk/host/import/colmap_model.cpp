#include "host/import/colmap_model.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "host/base/regular_file.h"
#include "host/cameras/fault.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

std::string readWhole(const fs::path &path) {
  checkIsFile(path.string(), "the file itself");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string() + "; is it there, and are you allowed to?");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool staysInside(const std::string &name) {
  const fs::path path(name);
  if (name.empty() || path.is_absolute()) return false;
  for (const fs::path &part : path)
    if (part == "..") return false;
  return true;
}

void checkImages(const ColmapModel &model) {
  for (const auto &[id, image] : model.images) {
    const std::string place = "image " + std::to_string(id);
    if (!model.cameras.count(image.camera))
      refuse("images", place,
             "is of camera " + std::to_string(image.camera) +
                 ", which cameras does not have; take files of one model");
    if (!staysInside(image.name))
      refuse("images", place,
             "its name " + shown(image.name) + " is not one inside the folder of images; name it as it lies there");
  }
}

void checkTracks(const ColmapModel &model) {
  for (const auto &[id, point] : model.points) {
    for (const ColmapObservation &seen : point.track) {
      const auto image = model.images.find(seen.image);
      if (image == model.images.end() || seen.keypoint >= image->second.keypoints_px.size())
        refuse("points3D", "point " + std::to_string(id),
               "was seen as keypoint " + std::to_string(seen.keypoint) + " of image " + std::to_string(seen.image) +
                   ", which images does not have; take files of one model");
    }
  }
}

}  // namespace

ColmapFiles readColmapFiles(const std::string &folder) {
  const fs::path path(folder);
  ColmapFiles files;
  files.binary = fs::exists(path / "cameras.bin");
  const char *ending = files.binary ? ".bin" : ".txt";
  if (!fs::exists(path / (std::string("cameras") + ending)))
    throw std::runtime_error(
        folder +
        " holds neither cameras.bin nor cameras.txt; name the folder that COLMAP's mapper wrote,"
        " such as sparse/0");
  files.cameras = readWhole(path / (std::string("cameras") + ending));
  files.images = readWhole(path / (std::string("images") + ending));
  files.points = readWhole(path / (std::string("points3D") + ending));
  return files;
}

ColmapModel parseColmapModel(const ColmapFiles &files) {
  ColmapModel model = files.binary ? parseColmapBinary(files) : parseColmapText(files);
  if (model.images.empty() || model.points.empty())
    refuse("images, points3D", "the model", "is empty; did COLMAP's mapper end well?");
  checkImages(model);
  checkTracks(model);
  return model;
}

}  // namespace sphc::host
