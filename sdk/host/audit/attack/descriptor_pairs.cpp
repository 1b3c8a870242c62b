#include "host/audit/attack/descriptor_pairs.h"

#include <cstring>
#include <string>
#include <unordered_map>

#include "runtime/stages/match/distance.h"

namespace sphc::host {
namespace {

std::string bytesOf(const Descriptor &d) { return {reinterpret_cast<const char *>(d.bytes), kDescriptorBytes}; }

// False when no descriptor stands out.
bool nearest(const Descriptor &query, const std::vector<Descriptor> &table, double ratio, uint32_t *index) {
  uint32_t best = UINT32_MAX, second = UINT32_MAX;
  for (uint32_t i = 0; i < table.size(); ++i) {
    const uint32_t d = distance2(query, table[i]);
    if (d < best) {
      second = best;
      best = d;
      *index = i;
    } else if (d < second) {
      second = d;
    }
  }
  return best < ratio * ratio * second;
}

}  // namespace

std::vector<EntryPair> pairEntries(const std::vector<Descriptor> &a, const std::vector<Descriptor> &b,
                                   double ratio) {
  std::unordered_map<std::string, uint32_t> equal;
  for (uint32_t i = 0; i < b.size(); ++i) equal.emplace(bytesOf(b[i]), i);
  std::vector<EntryPair> pairs;
  for (uint32_t i = 0; i < a.size(); ++i) {
    const auto same = equal.find(bytesOf(a[i]));
    uint32_t partner = 0;
    if (same != equal.end())
      pairs.push_back({i, same->second});
    else if (nearest(a[i], b, ratio, &partner))
      pairs.push_back({i, partner});
  }
  return pairs;
}

}  // namespace sphc::host
