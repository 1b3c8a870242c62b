#include "host/import/fixed_in_image.h"

#include <algorithm>

#include "host/import/near_duplicates.h"

namespace sphc::host {
namespace {

constexpr int kSpotCellPx = 8;                    // what is seen in a cell beside a spot's belongs to it
constexpr double kSamePixelPx = 1, kAlike = 200;  // a descriptor's distance, L2 of bytes
constexpr double kMovedRad = 0.015;               // of the view of what stands still
constexpr double kNearestSeenM = 0.1;
constexpr uint32_t kForgetFrames = 8;  // after which a spot is a new one
constexpr uint32_t kLeastMoves = 2;
// Less of what is seen is chance: a few keypoints of whole recordings in which nothing is fixed.
constexpr double kLeastShare = 0.001;

}  // namespace

// With a border of empty cells, so that every other one has nine around it.
void FixedInImage::begin(const Camera &camera) {
  camera_ = camera;
  across_ = static_cast<size_t>(camera.width() / kSpotCellPx + 3);
  first_cell_ += recent_.size();
  recent_.assign(across_ * static_cast<size_t>(camera.height() / kSpotCellPx + 3), {});
}

size_t FixedInImage::cellOf(const Vector2 &pixel_px) const {
  const auto column = static_cast<size_t>(pixel_px.x()) / kSpotCellPx,
             row = static_cast<size_t>(pixel_px.y()) / kSpotCellPx;
  return first_cell_ + (row + 1) * across_ + column + 1;
}

std::array<size_t, 9> FixedInImage::around(size_t cell) const {
  const size_t up = cell - across_, down = cell + across_;
  return {up - 1, up, up + 1, cell - 1, cell, cell + 1, down - 1, down, down + 1};
}

// The one most alike; null where there is none.
FixedInImage::RecentSpot *FixedInImage::find(size_t cell, const Observation &seen) {
  RecentSpot *found = nullptr;
  double nearest = kAlike;
  for (const size_t near : around(cell))
    for (RecentSpot &spot : recent_[near - first_cell_]) {
      if (frame_ - spot.last_frame > kForgetFrames || spot.last_frame == frame_) continue;
      if ((spot.image_px - seen.image_px).norm() > kSamePixelPx) continue;
      const double distance = descriptorDistance(spot.descriptor, seen.descriptor);
      if (distance >= nearest) continue;
      nearest = distance;
      found = &spot;
    }
  return found;
}

void FixedInImage::addSpot(size_t cell, Observation *seen) {
  std::vector<RecentSpot> &here = recent_[cell - first_cell_];
  const auto is_old = [this](const RecentSpot &spot) { return frame_ - spot.last_frame > kForgetFrames; };
  here.erase(std::remove_if(here.begin(), here.end(), is_old), here.end());
  seen->spot = static_cast<uint32_t>(spots_.size());
  here.push_back({seen->spot, frame_, seen->image_px, seen->position_m, seen->descriptor});
  spots_.push_back({cell, 1, 0});
}

// If it stood still?
bool FixedInImage::isSeenElsewhere(const Rigid &camera_from_world, const RecentSpot &spot) const {
  const Vector3 point_m = camera_from_world * spot.position_m;
  Vector2 expected_px;
  if (point_m.z() < kNearestSeenM || !camera_.project(point_m, &expected_px)) return true;
  return (expected_px - spot.image_px).norm() > kMovedRad * camera_.focal();
}

void FixedInImage::add(const Rigid &camera_from_world, std::vector<Observation> *observations) {
  ++frame_;
  for (Observation &seen : *observations) {
    const size_t cell = cellOf(seen.image_px);
    RecentSpot *spot = find(cell, seen);
    if (!spot) {
      addSpot(cell, &seen);
      continue;
    }
    seen.spot = spot->number;
    spot->last_frame = frame_;
    ++spots_[spot->number].seen;
    if (!isSeenElsewhere(camera_from_world, *spot)) continue;
    ++spots_[spot->number].moves;
    spot->position_m = seen.position_m;
  }
}

// The cells in which something is fixed, and those around them; none where that is chance.
std::vector<bool> FixedInImage::fixedCells() const {
  std::vector<bool> cells(first_cell_ + recent_.size());
  uint64_t seen = 0, fixed = 0;
  for (const Spot &spot : spots_) {
    seen += spot.seen;
    if (spot.moves < kLeastMoves) continue;
    fixed += spot.seen;
    for (const size_t cell : around(spot.cell)) cells[cell] = true;
  }
  if (static_cast<double>(fixed) < kLeastShare * static_cast<double>(seen)) cells.assign(cells.size(), false);
  return cells;
}

uint32_t FixedInImage::dropFrom(std::vector<TrackedPoint> *points) const {
  const std::vector<bool> cells = fixedCells();
  const auto stays = [&](const TrackedPoint &point) {
    const auto fixed = std::count_if(point.spots.begin(), point.spots.end(),
                                     [&](uint32_t spot) { return cells[spots_[spot].cell]; });
    return 2 * static_cast<size_t>(fixed) <= point.spots.size();
  };
  const auto first_dropped = std::stable_partition(points->begin(), points->end(), stays);
  const auto dropped = points->end() - first_dropped;
  points->erase(first_dropped, points->end());
  return static_cast<uint32_t>(dropped);
}

}  // namespace sphc::host
