#include "lab/deadline/frames.h"

#include "host/publish/descriptor_index.h"
#include "runtime/base/random.h"
#include "runtime/map/map_view.h"
#include "runtime/stages/features/extractor.h"

namespace sphc::host {

void makeNoise(uint64_t seed, Shot *shot) {
  Random random(seed);
  for (uint8_t &value : shot->color) value = static_cast<uint8_t>(random.below(256));
}

SphereCloud cloudOf(const MapFile &map) {
  MapView view;
  sphc_message message;
  if (MapView::open(map.bytes.data(), map.bytes.size(), kExtractorId, &view, &message) != SPHC_OK)
    throw std::runtime_error(message.text);
  SphereCloud cloud;
  cloud.band = view.band();
  for (uint32_t i = 0; i < view.pointCount(); ++i) {
    const Direction d = view.direction(i);
    cloud.points.push_back({Vector3(static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)),
                            view.descriptor(i)});
  }
  return cloud;
}

MapFile inOneCell(const MapFile &map) {
  const SphereCloud cloud = cloudOf(map);
  const auto points = static_cast<uint32_t>(cloud.points.size());
  DescriptorIndex index;
  for (uint32_t i = 0; i < points; ++i) index.order.push_back(i);
  index.centroids = index.group_centroids = {cloud.points[0].descriptor};
  index.groups = {0, 1};
  index.runs = {0, points};
  return openMapBytes(encodeMap(cloud, {}, index));
}

}  // namespace sphc::host
