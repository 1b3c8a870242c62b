// Reads a sphere-cloud file in place: validates every byte once, then hands out views.
#pragma once
#include "runtime/base/span.h"
#include "runtime/map/layout.h"
#include "runtime/map/packed_direction.h"
#include "runtime/types/keypoint.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

// Consecutive points, cells or groups.
struct IndexRange {
  uint32_t begin, end;
};

class MapView {
 public:
  // `file` is borrowed as long as the view is used.  Refuses anything that docs/map_format.md does not allow.
  static sphc_status open(const void *file, size_t file_bytes, uint32_t extractor, MapView *view,
                          sphc_message *message);

  uint32_t pointCount() const { return header_->point_count; }
  Direction direction(uint32_t i) const { return unpackDirection(directions_[i]); }
  Span<const PackedDirection> directions() const { return directions_; }
  const Descriptor &descriptor(uint32_t i) const { return descriptors_[i]; }
  Span<const Descriptor> descriptors() const { return descriptors_; }
  const MapHeader &header() const { return *header_; }
  sphc_band band() const { return header_->band; }

  // The index: points lie in the order of their cells, and within a cell of their sectors (sector.h).
  uint32_t cellCount() const { return header_->cell_count; }
  uint32_t groupCount() const { return header_->group_count; }
  uint32_t sectorSide() const { return header_->sector_side; }
  Span<const Descriptor> centroids() const { return centroids_; }
  Span<const Descriptor> groupCentroids() const { return group_centroids_; }
  // Cells of a group.
  IndexRange group(uint32_t g) const { return {groups_[g], groups_[g + 1]}; }
  // First cell of each group, and the number of cells.
  Span<const uint32_t> groupBegins() const { return groups_; }
  // Points of a cell; and those of its sectors [first, last].
  IndexRange cell(uint32_t c) const { return sectors(c, 0, sectorCount() - 1); }
  IndexRange sectors(uint32_t c, uint32_t first, uint32_t last) const {
    const size_t start = size_t{c} * sectorCount();
    return {runs_[start + first], runs_[start + last + 1]};
  }

 private:
  uint32_t sectorCount() const { return header_->sector_side * header_->sector_side; }

  const MapHeader *header_ = nullptr;
  Span<const PackedDirection> directions_;
  Span<const Descriptor> descriptors_, centroids_, group_centroids_;
  Span<const uint32_t> runs_, groups_;
};

}  // namespace sphc
