#include "host/import/colmap_world.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>

#include "host/import/colmap_images.h"
#include "host/import/point_tracks.h"
#include "host/import/upright.h"
#include "host/recording/calibration.h"
#include "runtime/stages/align/sparse.h"

namespace sphc::host {
namespace {

namespace fs = std::filesystem;

constexpr double kNearestM = 0.3, kFarthestM = 6.0;
constexpr size_t kFewestOfImage = 10, kFewestImages = 3;

// A scale that one point tells, and how much it counts: the relative error of depth, by either way, grows with
// depth.
struct Vote {
  double value, weight;
};

double medianOf(std::vector<Vote> votes) {
  std::sort(votes.begin(), votes.end(), [](const Vote &a, const Vote &b) { return a.value < b.value; });
  double half = 0;
  for (const Vote &vote : votes) half += 0.5 * vote.weight;
  for (const Vote &vote : votes)
    if ((half -= vote.weight) <= 0) return vote.value;
  return votes.back().value;
}

// X.depth.png for X.color.jpg, else X.png for X.jpg.  The first comes first: where depth lies beside colour, X.png
// may be the colour image itself.
fs::path depthPath(const std::string &folder, const std::string &name) {
  const fs::path path = fs::path(folder) / fs::path(name).replace_extension(".png");
  std::string file = path.filename().string();
  const size_t color = file.rfind("color");
  if (color == std::string::npos) return path;
  fs::path beside = path;
  beside.replace_filename(file.replace(color, 5, "depth"));
  return fs::exists(beside) ? beside : path;
}

class DepthImages {
 public:
  DepthImages(const std::string &folder, const std::string &calibration) : folder_(folder) {
    sphc_rig_init(&calibration_);
    if (calibration.empty()) return;
    separate_ = true;
    sphc_message message = {};
    if (sphc_calibration_read(calibration.c_str(), &calibration_, &message) != SPHC_OK)
      throw std::runtime_error(message.text);
  }

  // What single points of an image tell; nothing where there is no depth image.
  std::vector<Vote> votes(const ColmapModel &model, const ColmapImage &image,
                          const std::vector<std::pair<Vector2, double>> &depths) const {
    const sphc_camera &color = model.cameras.at(image.camera);
    const cv::Mat depth = read(image.name, separate_ ? calibration_.depth_camera : color);
    std::vector<Vote> votes;
    if (depth.empty()) return votes;
    const DepthSensor sensor = {calibration_.depth_unit_m, kNearestM, kFarthestM, kMappingNoise.sigma_m,
                                kMappingNoise.sigma_per_m2};
    const SparseAligner aligner(Camera(color), Camera(separate_ ? calibration_.depth_camera : color),
                                rigidFromC(calibration_.color_from_depth), sensor);
    const ImageView<uint16_t> view = {depth.ptr<uint16_t>(), depth.cols, depth.rows,
                                      static_cast<int32_t>(depth.step1())};
    for (const auto &[pixel, units] : depths) {
      Vector3 point_m;
      double sigma_m = 0;
      if (units > 0 && aligner.lift(view, pixel, &point_m, &sigma_m))
        votes.push_back({point_m.z() / units, 1 / (point_m.z() * point_m.z())});
    }
    return votes;
  }

 private:
  cv::Mat read(const std::string &name, const sphc_camera &camera) const {
    const fs::path path = depthPath(folder_, name);
    if (!fs::exists(path)) return {};
    return readColmapDepth(path.string(), camera);
  }

  std::string folder_;
  sphc_rig calibration_;
  bool separate_ = false;
};

// Where each image's points are in it: pixel, and depth in the model's unit.
std::map<uint32_t, std::vector<std::pair<Vector2, double>>> depthsOfImages(const ColmapModel &model) {
  std::map<uint32_t, std::vector<std::pair<Vector2, double>>> depths;
  for (const auto &[id, point] : model.points)
    for (const ColmapObservation &o : point.track) {
      const ColmapImage &image = model.images.at(o.image);
      depths[o.image].emplace_back(image.keypoints_px[o.keypoint], (image.camera_from_model * point.position).z());
    }
  return depths;
}

}  // namespace

Vector3 downByCameras(const ColmapModel &model) {
  std::vector<Matrix3> camera_from_model;
  for (const auto &[id, image] : model.images) camera_from_model.push_back(image.camera_from_model.rotation);
  return downByCameras(camera_from_model);
}

ColmapScale scaleByDepth(const ColmapModel &model, const std::string &depth, const std::string &calibration) {
  const DepthImages images(depth, calibration);
  std::vector<Vote> of_images;
  for (const auto &[id, depths] : depthsOfImages(model)) {
    const std::vector<Vote> votes = images.votes(model, model.images.at(id), depths);
    if (votes.size() >= kFewestOfImage) of_images.push_back({medianOf(votes), 1});
  }
  if (of_images.size() < kFewestImages)
    throw std::runtime_error("only " + std::to_string(of_images.size()) + " images have depth at their points in " +
                             depth + "; depth images are named like the colour images, X.png for X.jpg");
  ColmapScale scale;
  scale.metres_per_unit = medianOf(of_images);
  std::vector<Vote> off;
  for (const Vote &vote : of_images) off.push_back({std::abs(vote.value / scale.metres_per_unit - 1), 1});
  scale.spread = 1.4826 * medianOf(off);
  return scale;
}

}  // namespace sphc::host
