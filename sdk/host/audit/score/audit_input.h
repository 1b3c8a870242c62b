// What an audit is given: the map, and what its owner knows.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/audit/score/truth_view.h"
#include "host/publish/place.h"

namespace sphc::host {

struct AuditInput {
  std::vector<uint8_t> file;
  std::string networks;                          // folder of the attackers' trained files; empty: none
  std::optional<Place> place;                    // the owner's truth; without it some attacks cannot be scored
  std::vector<Release> other_releases;           // of other places of the ledger that show points of this one
  std::vector<InversionView> views;              // pictures of the place from the centre; else pseudo truth
  std::vector<std::vector<uint8_t>> releases;    // other maps of the place that were published
  std::vector<std::vector<ModelPoint>> queries;  // frames of a client, in the place's frame
  std::vector<std::vector<ModelPoint>> photos;   // frames that the map was not made of, likewise; else `queries`
  bool quick = false;                            // fewer lines and views
};

// `wanted` elements at most, evenly chosen.
template <typename T>
std::vector<T> everyNth(const std::vector<T> &all, size_t wanted) {
  const size_t step = (all.size() + wanted - 1) / wanted;
  std::vector<T> some;
  for (size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

}  // namespace sphc::host
