// Reads a sphere-cloud file in place: validates every byte once, then hands out views.
#pragma once
#include "runtime/base/span.h"
#include "runtime/map/layout.h"
#include "runtime/map/packed_direction.h"
#include "runtime/types/keypoint.h"
#include "spherecloud/spherecloud.h"

namespace sphc {

class MapView {
 public:
  // `file` is borrowed as long as the view is used.  Refuses anything that docs/map_format.md does not allow.
  static sphc_status open(const void *file, size_t file_bytes, uint32_t extractor, MapView *view,
                          sphc_message *message);

  uint32_t pointCount() const { return header_->point_count; }
  Direction direction(uint32_t i) const { return unpackDirection(directions_[i]); }
  Span<const Descriptor> descriptors() const { return descriptors_; }
  const MapHeader &header() const { return *header_; }

 private:
  const MapHeader *header_ = nullptr;
  Span<const PackedDirection> directions_;
  Span<const Descriptor> descriptors_;
};

}  // namespace sphc
