#include "host/audit/attack/presence.h"

#include "host/audit/attack/descriptor_pairs.h"
#include "host/audit/attack/mirror.h"

namespace sphc::host {

double presenceScore(const Published &map, const std::vector<Descriptor> &crop, double ratio) {
  if (crop.empty()) return 0;
  const size_t found = pairEntries(crop, map.descriptors, ratio).size();
  return static_cast<double>(found) / static_cast<double>(crop.size());
}

double presenceScoreMirroredToo(const Published &map, const std::vector<Descriptor> &crop, double ratio) {
  return presenceScore(map, crop, ratio) + presenceScore(map, mirrorsOf(crop), ratio);
}

}  // namespace sphc::host
