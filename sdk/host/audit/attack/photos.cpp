#include "host/audit/attack/photos.h"

#include <cmath>
#include <set>

#include "host/audit/attack/mirror.h"

namespace sphc::host {
namespace {

constexpr double kPhotoRatio = 0.8, kBesideM = 0.3, kBesideRad = 0.14;  // a patch of fakes is as wide
constexpr int kCompany = 2;

bool hasCompany(const EntryPair &pair, const std::vector<EntryPair> &pairs, const Published &map,
                const std::vector<OwnPoint> &photo) {
  int company = -1;  // itself is found too
  for (const EntryPair &other : pairs)
    company += (photo[pair.a].position_m - photo[other.a].position_m).norm() < kBesideM &&
               (map.directions[pair.b] - map.directions[other.b]).norm() < kBesideRad;
  return company >= kCompany;
}

}  // namespace

std::vector<EntryPair> matchesInCompany(const Published &map, const std::vector<OwnPoint> &photo, Photo how) {
  std::vector<Descriptor> seen;
  for (const OwnPoint &point : photo)
    seen.push_back(how == Photo::kMirrored ? mirrorOf(point.descriptor) : point.descriptor);
  const std::vector<EntryPair> pairs = pairEntries(seen, map.descriptors, kPhotoRatio);
  std::vector<EntryPair> kept;
  for (const EntryPair &pair : pairs)
    if (hasCompany(pair, pairs, map, photo)) kept.push_back(pair);
  return kept;
}

std::vector<uint32_t> markedBy(const Published &map, const std::vector<std::vector<OwnPoint>> &photos, Photo how) {
  std::set<uint32_t> marked;
  for (const std::vector<OwnPoint> &photo : photos)
    for (const EntryPair &pair : matchesInCompany(map, photo, how)) marked.insert(pair.b);
  return {marked.begin(), marked.end()};
}

}  // namespace sphc::host
