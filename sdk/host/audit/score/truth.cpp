#include "host/audit/score/truth.h"

#include <stdexcept>
#include <string>
#include <unordered_map>

namespace sphc::host {
namespace {

std::string bytesOf(const PackedDirection &direction, const Descriptor &descriptor) {
  return std::string(reinterpret_cast<const char *>(&direction), sizeof direction) +
         std::string(reinterpret_cast<const char *>(&descriptor), sizeof descriptor);
}

}  // namespace

std::vector<EntryTruth> truthOf(const Published &map, const Place &place) {
  std::unordered_map<std::string, const PlacePoint *> points;
  for (const PlacePoint &point : place.points) points.emplace(bytesOf(point.direction, point.descriptor), &point);
  std::vector<EntryTruth> truth;
  for (size_t i = 0; i < map.packed.size(); ++i) {
    const auto found = points.find(bytesOf(map.packed[i], map.descriptors[i]));
    if (found == points.end())
      throw std::runtime_error("the map has an entry that the ledger's place does not; is it another place's?");
    const PlacePoint &point = *found->second;
    truth.push_back({point.real, point.seen.position_m - place.centre_m, point.release});
  }
  return truth;
}

}  // namespace sphc::host
