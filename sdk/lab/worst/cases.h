// Frames, maps and configs that cost the most, made from ones that do not.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/evaluate/map_file.h"
#include "host/evaluate/parameters.h"
#include "lab/negative/sequence.h"

namespace sphc::host {

struct WorstCase {
  std::string name;
  std::function<void(uint64_t seed, const Sequence &, Shot *)> spoil;  // null: frames as they were recorded
  std::function<MapFile(const MapFile &)> map;                         // null: the map as it is
  uint32_t max_keypoints = 0;                                          // 0: as given
  Parameters parameters = {};
};

// The first is the normal one.
std::vector<WorstCase> worstCases();

}  // namespace sphc::host
