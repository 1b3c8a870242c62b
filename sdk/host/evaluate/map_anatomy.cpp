#include "host/evaluate/map_anatomy.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "host/report/statistics.h"
#include "runtime/map/layout.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {
namespace {

std::string sectionName(uint32_t type) {
  switch (type) {
    case kSectionDirections:
      return "directions";
    case kSectionDescriptors:
      return "descriptors";
    case kSectionRuns:
      return "index: runs";
    case kSectionCentroids:
      return "index: cell centroids";
    case kSectionGroups:
      return "index: groups";
    case kSectionGroupCentroids:
      return "index: group centroids";
    default:
      return "section " + std::to_string(type);
  }
}

std::vector<MapSection> sectionsOf(const MapFile &file) {
  MapHeader header;
  std::memcpy(&header, file.bytes.data(), sizeof header);
  std::vector<MapSection> sections(header.section_count);
  std::memcpy(sections.data(), static_cast<const uint8_t *>(file.bytes.data()) + sizeof header,
              sections.size() * sizeof(MapSection));
  return sections;
}

void weigh(const MapFile &file, const std::vector<MapSection> &sections, MapAnatomy *anatomy) {
  anatomy->parts = {{"header", sizeof(MapHeader)}, {"section table", sections.size() * sizeof(MapSection)}};
  for (const MapSection &section : sections) anatomy->parts.push_back({sectionName(section.type), section.bytes});
  uint64_t sum = 0;
  for (const BytePart &part : anatomy->parts) sum += part.bytes;
  anatomy->parts.push_back({"padding", file.bytes.size() - sum});
}

void studyNeighbours(const std::vector<std::array<double, 3>> &directions, MapAnatomy *anatomy) {
  // A sample is enough for a median, and keeps large maps quick.
  const size_t stride = std::max<size_t>(1, directions.size() / 2000);
  std::vector<double> nearest;
  for (size_t i = 0; i < directions.size(); i += stride) {
    double best = -1;
    for (size_t j = 0; j < directions.size(); ++j) {
      const auto &a = directions[i], &b = directions[j];
      if (i != j) best = std::max(best, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    }
    nearest.push_back(std::acos(std::clamp(best, -1.0, 1.0)) * 180 / M_PI);
  }
  anatomy->nearest_median_deg = percentile(nearest, 0.5);
  anatomy->nearest_p10_deg = percentile(nearest, 0.1);
}

void studySpread(const std::vector<std::array<double, 3>> &directions, MapAnatomy *anatomy) {
  constexpr size_t kBands = 20, kTurns = 40;  // equal steps of z: equal areas
  std::vector<bool> hit(kBands * kTurns);
  std::array<double, 3> sum = {};
  for (const auto &d : directions) {
    const double band = (d[2] + 1) / 2 * kBands, turn = (std::atan2(d[1], d[0]) / (2 * M_PI) + 0.5) * kTurns;
    hit[std::min(kBands - 1, static_cast<size_t>(band)) * kTurns +
        std::min(kTurns - 1, static_cast<size_t>(turn))] = true;
    for (size_t i = 0; i < 3; ++i) sum[i] += d[i];
  }
  anatomy->covered_percent =
      100.0 * static_cast<double>(std::count(hit.begin(), hit.end(), true)) / static_cast<double>(hit.size());
  anatomy->lopsidedness = std::hypot(sum[0], sum[1], sum[2]) / static_cast<double>(directions.size());
}

void studyDescriptors(const uint8_t *bytes, size_t count, MapAnatomy *anatomy) {
  double sum = 0, squares = 0;
  uint64_t zeros = 0, saturated = 0;
  std::set<std::string> distinct;
  for (size_t i = 0; i < count; ++i) {
    const uint8_t *descriptor = bytes + i * kDescriptorBytes;
    double length2 = 0;
    for (size_t k = 0; k < kDescriptorBytes; ++k) {
      length2 += static_cast<double>(descriptor[k]) * descriptor[k];
      zeros += descriptor[k] == 0;
      saturated += descriptor[k] == 255;
    }
    sum += std::sqrt(length2);
    squares += length2;
    distinct.emplace(reinterpret_cast<const char *>(descriptor), kDescriptorBytes);
  }
  const double n = static_cast<double>(count), all = n * kDescriptorBytes;
  anatomy->length_mean = sum / n;
  anatomy->length_sigma = std::sqrt(std::max(0.0, squares / n - anatomy->length_mean * anatomy->length_mean));
  anatomy->zero_percent = 100 * static_cast<double>(zeros) / all;
  anatomy->saturated_percent = 100 * static_cast<double>(saturated) / all;
  anatomy->doubles = static_cast<uint32_t>(count - distinct.size());
}

}  // namespace

MapAnatomy dissect(const MapFile &file, const MapFacts &facts) {
  MapAnatomy anatomy;
  const std::vector<MapSection> sections = sectionsOf(file);
  weigh(file, sections, &anatomy);
  studyNeighbours(facts.directions, &anatomy);
  studySpread(facts.directions, &anatomy);
  for (const MapSection &section : sections) {
    if (section.type != kSectionDescriptors) continue;
    studyDescriptors(static_cast<const uint8_t *>(file.bytes.data()) + section.offset, facts.points, &anatomy);
  }
  return anatomy;
}

}  // namespace sphc::host
