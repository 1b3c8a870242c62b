// The only writer of sphere-cloud files (docs/map_format.md), and of the owner's note beside them.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/publish/descriptor_index.h"
#include "host/publish/place.h"
#include "host/publish/sphere_cloud.h"

namespace sphc::host {

// The nearest direction that a map can hold; one that was unpacked is packed into the same bytes.
PackedDirection packDirection(const Vector3 &direction);

std::vector<uint8_t> encodeMap(const SphereCloud &cloud, const MapId &map_id);
// With an index of the caller's.
std::vector<uint8_t> encodeMap(const SphereCloud &cloud, const MapId &map_id, const DescriptorIndex &index);

// What the owner keeps and never ships: where the centre is in the world of the recording.  JSON.
struct OwnerNote {
  MapId map_id;
  Vector3 centre_in_world_m;  // world_from_map is a translation by this
  double eta;
  std::string strategy;
};
// Readable by its owner alone.
void writeOwnerNote(const std::string &path, const OwnerNote &note);
OwnerNote readOwnerNote(const std::string &path);  // throws std::runtime_error with cause and cure

}  // namespace sphc::host
