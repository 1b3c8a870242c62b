#include <filesystem>
#include <memory>

#include "host/frames/frame_features.h"
#include "host/import/colmap_descriptors.h"
#include "host/import/colmap_images.h"

namespace sphc::host {
namespace {

constexpr int kSearchCellPx = 8;

// The feature stage's keypoints of one image, to be found by place.
class KeypointGrid {
 public:
  KeypointGrid(const FrameFeatures &features, int width, int height)
      : features_(features), across_(width / kSearchCellPx + 1), down_(height / kSearchCellPx + 1) {
    cells_.resize(static_cast<size_t>(across_ * down_));
    for (uint32_t i = 0; i < features.count(); ++i) cells_[cellOf(features.pixel(i))].push_back(i);
  }

  // Nearest within reach, or -1.
  int64_t nearest(const Vector2 &pixel, double reach) const {
    const int x = static_cast<int>(pixel.x()) / kSearchCellPx, y = static_cast<int>(pixel.y()) / kSearchCellPx;
    int64_t best = -1;
    double best2 = reach * reach;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, down_ - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, across_ - 1); ++u)
        for (uint32_t i : cells_[static_cast<size_t>(v * across_ + u)]) {
          const double distance2 = (features_.pixel(i) - pixel).squaredNorm();
          if (distance2 < best2) best2 = distance2, best = i;
        }
    return best;
  }

 private:
  size_t cellOf(const Vector2 &pixel) const {
    return static_cast<size_t>(static_cast<int>(pixel.y()) / kSearchCellPx * across_ +
                               static_cast<int>(pixel.x()) / kSearchCellPx);
  }

  const FrameFeatures &features_;
  int across_, down_;
  std::vector<std::vector<uint32_t>> cells_;
};

struct Seen {
  uint64_t point;
  uint32_t keypoint;
};

std::map<uint32_t, std::vector<Seen>> seenByImages(const ColmapModel &model) {
  std::map<uint32_t, std::vector<Seen>> seen;
  for (const auto &[id, point] : model.points)
    for (const ColmapObservation &o : point.track) seen[o.image].push_back({id, o.keypoint});
  return seen;
}

}  // namespace

DescriptorsOfPoints describeAgain(const ColmapModel &model, const ColmapImportOptions &options,
                                  const Progress &progress) {
  DescriptorsOfPoints descriptors;
  std::map<uint32_t, std::unique_ptr<FrameFeatures>> features;  // of a camera
  uint32_t done = 0;
  const auto seen = seenByImages(model);
  for (const auto &[id, points] : seen) {
    const ColmapImage &image = model.images.at(id);
    const sphc_camera &camera = model.cameras.at(image.camera);
    const int width = static_cast<int>(camera.width), height = static_cast<int>(camera.height);
    auto &found = features[image.camera];
    if (!found) found = std::make_unique<FrameFeatures>(width, height, options.max_keypoints);
    const cv::Mat gray = readColmapPhoto((std::filesystem::path(options.images) / image.name).string(), camera);
    found->extract({gray.data, width, height, static_cast<int32_t>(gray.step)});
    const KeypointGrid grid(*found, width, height);
    for (const Seen &o : points) {
      const int64_t nearest = grid.nearest(image.keypoints_px[o.keypoint], options.reach_px);
      if (nearest >= 0) descriptors[o.point].push_back(found->descriptor(static_cast<uint32_t>(nearest)));
    }
    if (progress) progress(++done, static_cast<uint32_t>(seen.size()));
  }
  return descriptors;
}

}  // namespace sphc::host
