#include "host/audit/attack/leaks.h"

#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <utility>

#include "runtime/base/random.h"
#include "runtime/map/layout.h"

namespace sphc::host {
namespace {

constexpr int kShuffles = 200;

// Mean cosine of the angle between entries that follow each other within a run, in the order given.
double neighbourCosine(const Published &map, const std::vector<uint32_t> &order) {
  double sum = 0;
  size_t count = 0;
  for (size_t run = 0; run + 1 < map.runs.size(); ++run)
    for (uint32_t at = map.runs[run]; at + 1 < map.runs[run + 1]; ++at, ++count)
      sum += map.directions[order[at]].dot(map.directions[order[at + 1]]);
  return count ? sum / static_cast<double>(count) : 0;
}

void shuffleRuns(const Published &map, Random *random, std::vector<uint32_t> *order) {
  for (size_t run = 0; run + 1 < map.runs.size(); ++run)
    for (uint32_t n = map.runs[run + 1] - map.runs[run]; n > 1; --n)
      std::swap((*order)[map.runs[run] + n - 1], (*order)[map.runs[run] + random->below(n)]);
}

Cue rankInRun(const Published &map) {
  Cue cue = {"rank in run", std::vector<double>(map.directions.size(), 0.5)};
  for (size_t run = 0; run + 1 < map.runs.size(); ++run)
    for (uint32_t at = map.runs[run]; at < map.runs[run + 1]; ++at)
      cue.scores[at] = (at - map.runs[run] + 0.5) / (map.runs[run + 1] - map.runs[run]);
  return cue;
}

Cue equalDirections(const Published &map) {
  std::map<std::pair<uint16_t, uint16_t>, double> count;
  for (const PackedDirection &p : map.packed) ++count[{p.u, p.v}];
  Cue cue = {"equal directions", {}};
  for (const PackedDirection &p : map.packed) cue.scores.push_back(count[{p.u, p.v}]);
  return cue;
}

}  // namespace

std::vector<Cue> fileCues(const Published &map) {
  std::vector<Cue> cues = {rankInRun(map), {"rank in file", {}}, equalDirections(map)};
  for (uint32_t i = 0; i < map.packed.size(); ++i) cues[1].scores.push_back(i);
  for (int bit = 0; bit < 4; ++bit) {
    Cue u = {"bit " + std::to_string(bit) + " of u", {}}, v = {"bit " + std::to_string(bit) + " of v", {}};
    for (const PackedDirection &p : map.packed) {
      u.scores.push_back(p.u >> bit & 1);
      v.scores.push_back(p.v >> bit & 1);
    }
    cues.push_back(u);
    cues.push_back(v);
  }
  return cues;
}

double orderZ(const Published &map) {
  std::vector<uint32_t> order(map.directions.size());
  std::iota(order.begin(), order.end(), 0u);
  const double actual = neighbourCosine(map, order);
  Random random(3);
  double sum = 0, squares = 0;
  for (int i = 0; i < kShuffles; ++i) {
    shuffleRuns(map, &random, &order);
    const double value = neighbourCosine(map, order);
    sum += value / kShuffles, squares += value * value / kShuffles;
  }
  const double variance = squares - sum * sum;
  return variance > 0 ? (actual - sum) / std::sqrt(variance) : 0;
}

size_t strayBytes(const std::vector<uint8_t> &file) {
  std::vector<bool> known(file.size());
  const auto claim = [&known](size_t offset, size_t count) {
    for (size_t i = offset; i < offset + count && i < known.size(); ++i) known[i] = true;
  };
  MapHeader header = {};
  if (file.size() < sizeof header) return file.size();
  std::memcpy(&header, file.data(), sizeof header);
  claim(0, sizeof header);
  for (size_t s = 0; s < header.section_count && s < kMapSections; ++s) {
    MapSection section = {};
    const size_t at = sizeof header + s * sizeof section;
    if (at + sizeof section > file.size()) break;
    std::memcpy(&section, file.data() + at, sizeof section);
    claim(at, offsetof(MapSection, reserved));
    claim(section.offset, section.bytes);
  }
  size_t stray = 0;
  for (size_t i = 0; i < file.size(); ++i) stray += !known[i] && file[i] != 0;
  return stray;
}

}  // namespace sphc::host
