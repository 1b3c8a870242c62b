#include "host/audit/attack/intersection.h"

#include <cmath>

#include "host/audit/attack/descriptor_pairs.h"

namespace sphc::host {

std::vector<std::vector<uint32_t>> intersectReleases(const std::vector<Published> &releases,
                                                     const IntersectionOptions &options) {
  std::vector<std::vector<bool>> confirmed;
  for (const Published &release : releases) confirmed.emplace_back(release.directions.size());
  for (size_t i = 0; i < releases.size(); ++i)
    for (size_t j = i + 1; j < releases.size(); ++j)
      for (const EntryPair &pair : pairEntries(releases[i].descriptors, releases[j].descriptors, options.ratio)) {
        const double apart = (releases[i].directions[pair.a] - releases[j].directions[pair.b]).norm();
        if (apart < 2 * std::sin(options.angle_rad / 2)) confirmed[i][pair.a] = confirmed[j][pair.b] = true;
      }
  std::vector<std::vector<uint32_t>> entries;
  for (const std::vector<bool> &flags : confirmed) {
    entries.emplace_back();
    for (uint32_t e = 0; e < flags.size(); ++e)
      if (flags[e]) entries.back().push_back(e);
  }
  return entries;
}

}  // namespace sphc::host
