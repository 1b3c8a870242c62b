#include "host/audit/attack/published.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "host/base/regular_file.h"
#include "runtime/map/map_view.h"

namespace sphc::host {

Published publishedIn(const std::vector<uint8_t> &file) {
  MapHeader header = {};
  std::memcpy(&header, file.data(), std::min(file.size(), sizeof header));
  MapView view;
  sphc_message message = {};
  if (MapView::open(file.data(), file.size(), header.extractor, &view, &message) != SPHC_OK)
    throw std::runtime_error(std::string("no valid map: ") + message.text);
  Published map;
  map.packed.assign(view.directions().begin(), view.directions().end());
  map.descriptors.assign(view.descriptors().begin(), view.descriptors().end());
  for (uint32_t i = 0; i < view.pointCount(); ++i) {
    const Direction d = view.direction(i);
    map.directions.emplace_back(d.x, d.y, d.z);
  }
  const uint32_t sectors = view.sectorSide() * view.sectorSide();
  for (uint32_t c = 0; c < view.cellCount(); ++c)
    for (uint32_t s = 0; s < sectors; ++s) map.runs.push_back(view.sectors(c, s, s).begin);
  map.runs.push_back(view.pointCount());
  return map;
}

std::vector<uint8_t> readMapFile(const std::string &path) {
  checkIsFile(path, "the map file itself");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("map " + path + " cannot be read; is the file there?");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace sphc::host
