#include "host/import/depth_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sphc::host {
namespace {

constexpr int32_t kColumns = 160;      // blocks across an image, at most
constexpr double kFartherStill = 1.5;  // what is measured so far beyond the range says that all before it is empty
constexpr double kInFrontM = 0.1;      // of a point in front of the camera
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

uint16_t inUnits(double depth_m, double unit_m) {
  return static_cast<uint16_t>(std::min(std::max(std::ceil(depth_m / unit_m), 1.0), 65535.0));
}

}  // namespace

DepthViews::DepthViews(const sphc_rig &rig, double depth_min_m, double depth_max_m)
    : camera_(rig.depth_camera),
      depth_from_color_(rigidFromC(rig.color_from_depth).inverse()),
      unit_m_(rig.depth_unit_m),
      least_(inUnits(depth_min_m, rig.depth_unit_m)),
      most_(inUnits(kFartherStill * depth_max_m, rig.depth_unit_m)),
      block_px_((camera_.width() + kColumns - 1) / kColumns),
      columns_(camera_.width() / block_px_),
      rows_(camera_.height() / block_px_) {}

DepthViews::Block DepthViews::blockOf(ImageView<uint16_t> depth, int32_t column, int32_t row) const {
  Block block = {65535, 0};
  int32_t measured = 0;
  for (int32_t y = row * block_px_; y < (row + 1) * block_px_; ++y)
    for (int32_t x = column * block_px_; x < (column + 1) * block_px_; ++x) {
      const uint16_t d = depth.row(y)[x];
      if (d < least_ || d > most_) continue;
      block.nearest = std::min(block.nearest, d);
      block.farthest = std::max(block.farthest, d);
      ++measured;
    }
  return 2 * measured >= block_px_ * block_px_ ? block : Block{0, 0};
}

void DepthViews::add(ImageView<uint16_t> depth, const Rigid &world_from_camera) {
  if (offered_++ % every_ != 0) return;
  if (views_.size() == kMost) {
    for (size_t i = 1; i < kMost / 2; ++i) views_[i] = std::move(views_[2 * i]);  // the first one stays
    views_.resize(kMost / 2);
    every_ *= 2;
    if ((offered_ - 1) % every_ != 0) return;
  }
  View view = {world_from_camera, depth_from_color_ * world_from_camera.inverse(), {}};
  view.blocks.reserve(static_cast<size_t>(columns_) * static_cast<size_t>(rows_));
  for (int32_t row = 0; row < rows_; ++row)
    for (int32_t column = 0; column < columns_; ++column) view.blocks.push_back(blockOf(depth, column, row));
  views_.push_back(std::move(view));
}

std::vector<Matrix3> DepthViews::cameraFromWorld() const {
  std::vector<Matrix3> rotations;
  for (const View &view : views_) rotations.push_back(view.world_from_camera.rotation.transpose());
  return rotations;
}

bool DepthViews::look(size_t index, const Vector3 &point_m, Sight *sight) const {
  const View &view = views_[index];
  const Vector3 point = view.depth_from_world * point_m;
  Vector2 pixel;
  if (point.z() < kInFrontM || !camera_.project(point, &pixel)) return false;
  // The four blocks whose centres are around the pixel.
  const double u = pixel.x() / block_px_ - 0.5, v = pixel.y() / block_px_ - 0.5;
  if (!(u >= 0 && v >= 0 && u < columns_ - 1 && v < rows_ - 1)) return false;
  *sight = {point.z(), kUnbounded, kUnbounded};
  for (int32_t i = 0; i < 4; ++i) {
    const int32_t column = static_cast<int32_t>(u) + i % 2, row = static_cast<int32_t>(v) + i / 2;
    const Block &block = view.blocks[static_cast<size_t>(row * columns_ + column)];
    if (block.nearest == 0) {
      sight->beyond_m = -kUnbounded;
      continue;
    }
    const double nearest = block.nearest * unit_m_ - point.z(), farthest = block.farthest * unit_m_ - point.z();
    sight->beyond_m = std::min(sight->beyond_m, nearest);
    sight->off_m = std::min({sight->off_m, std::abs(nearest), std::abs(farthest)});
  }
  return true;
}

}  // namespace sphc::host
