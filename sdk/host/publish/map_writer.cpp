#include "host/publish/map_writer.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "host/base/hex_text.h"
#include "host/base/regular_file.h"
#include "host/base/write_file.h"
#include "runtime/map/crc32.h"
#include "runtime/map/layout.h"
#include "runtime/map/packed_direction.h"
#include "runtime/stages/features/extractor.h"

namespace sphc::host {
namespace {

PackedDirection packOnce(const Vector3 &direction) {
  const double sum = direction.cwiseAbs().sum();
  double u = direction.x() / sum, v = direction.y() / sum;
  if (direction.z() < 0) {
    const double folded_u = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
    u = folded_u;
  }
  const auto pack = [](double x) { return static_cast<uint16_t>(32768 + std::lround(x * 32767)); };
  return {pack(u), pack(v)};
}

size_t alignUp(size_t offset) { return (offset + kSectionAlignment - 1) / kSectionAlignment * kSectionAlignment; }

// Appends sections to a file, in ascending order of type.
class Sections {
 public:
  explicit Sections(std::vector<uint8_t> *file) : file_(file) {
    file_->resize(sizeof(MapHeader) + kMapSections * sizeof(MapSection));
  }

  template <typename T>
  void add(SectionType type, const std::vector<T> &elements) {
    const size_t offset = alignUp(file_->size()), bytes = sizeof(T) * elements.size();
    file_->resize(offset + bytes);
    std::memcpy(file_->data() + offset, elements.data(), bytes);
    table_.push_back({type, sizeof(T), offset, bytes, crc32(0, elements.data(), bytes), 0});
  }
  const std::vector<MapSection> &table() const { return table_; }

 private:
  std::vector<uint8_t> *file_;
  std::vector<MapSection> table_;
};

template <typename T>
std::vector<T> inOrder(const std::vector<T> &items, const std::vector<uint32_t> &order) {
  std::vector<T> sorted;
  sorted.reserve(items.size());
  for (uint32_t from : order) sorted.push_back(items[from]);
  return sorted;
}

std::vector<PackedDirection> directionsOf(const SphereCloud &cloud) {
  std::vector<PackedDirection> directions;
  directions.reserve(cloud.points.size());
  for (const SpherePoint &point : cloud.points) directions.push_back(packDirection(point.direction));
  return directions;
}

std::vector<Descriptor> descriptorsOf(const SphereCloud &cloud) {
  std::vector<Descriptor> descriptors;
  descriptors.reserve(cloud.points.size());
  for (const SpherePoint &point : cloud.points) descriptors.push_back(point.descriptor);
  return descriptors;
}

MapId unhex(const std::string &text) {
  MapId id = {};
  if (text.size() != 2 * id.size() || text.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw std::runtime_error("map_id is not 32 hexadecimal digits; build the map again");
  for (size_t i = 0; i < id.size(); ++i)
    id[i] = static_cast<uint8_t>(std::stoul(text.substr(2 * i, 2), nullptr, 16));
  return id;
}

}  // namespace

PackedDirection packDirection(const Vector3 &direction) {
  // On the edges of the square a direction has two encodings: the second round chooses one.
  const Direction d = unpackDirection(packOnce(direction));
  return packOnce({static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)});
}

std::vector<uint8_t> encodeMap(const SphereCloud &cloud, const MapId &map_id) {
  return encodeMap(cloud, map_id, makeIndex(descriptorsOf(cloud), directionsOf(cloud)));
}

std::vector<uint8_t> encodeMap(const SphereCloud &cloud, const MapId &map_id, const DescriptorIndex &index) {
  std::vector<uint8_t> file;
  Sections sections(&file);
  sections.add(kSectionDirections, inOrder(directionsOf(cloud), index.order));
  sections.add(kSectionDescriptors, inOrder(descriptorsOf(cloud), index.order));
  sections.add(kSectionRuns, index.runs);
  sections.add(kSectionCentroids, index.centroids);
  sections.add(kSectionGroups, index.groups);
  sections.add(kSectionGroupCentroids, index.group_centroids);

  MapHeader header = {};
  std::memcpy(header.magic, kMapMagic, sizeof kMapMagic);
  header.version = kMapVersion;
  header.band = static_cast<uint16_t>(cloud.band);
  header.extractor = kExtractorId;
  header.file_bytes = file.size();
  header.point_count = static_cast<uint32_t>(cloud.points.size());
  header.section_count = kMapSections;
  std::memcpy(header.map_id, map_id.data(), map_id.size());
  header.cell_count = static_cast<uint32_t>(index.centroids.size());
  header.group_count = static_cast<uint32_t>(index.group_centroids.size());
  header.sector_side = index.sector_side;
  const size_t table_bytes = kMapSections * sizeof(MapSection);
  header.crc32 = crc32(crc32(0, &header, sizeof header), sections.table().data(), table_bytes);
  std::memcpy(file.data(), &header, sizeof header);
  std::memcpy(file.data() + sizeof header, sections.table().data(), table_bytes);
  return file;
}

void writeOwnerNote(const std::string &path, const OwnerNote &note) {
  const nlohmann::ordered_json json = {
      {"format", "spherecloud-owner-note"},
      {"version", 1},
      {"private", "the map's owner keeps this file; whoever has it knows where the map's centre is"},
      {"map_id", hexText(note.map_id.data(), note.map_id.size())},
      {"centre_in_world_m", {note.centre_in_world_m.x(), note.centre_in_world_m.y(), note.centre_in_world_m.z()}},
      {"eta", note.eta},
      {"strategy", note.strategy}};
  writeFile(path, json.dump(2) + "\n", Readers::kOwner);
}

OwnerNote readOwnerNote(const std::string &path) {
  checkIsFile(path, "the owner's note that spherecloud build wrote beside the map");
  std::ifstream in(path);
  if (!in)
    throw std::runtime_error("owner's note " + path +
                             " cannot be read; spherecloud build writes it beside the map");
  try {
    const nlohmann::json json = nlohmann::json::parse(in);
    if (json.at("format") != "spherecloud-owner-note" || json.at("version") != 1)
      throw std::runtime_error("it is not an owner's note of version 1; give the one that spherecloud build wrote");
    const auto &centre = json.at("centre_in_world_m");
    OwnerNote note;
    note.map_id = unhex(json.at("map_id").get<std::string>());
    if (centre.size() != 3)
      throw std::runtime_error("centre_in_world_m must have three numbers; build the map again");
    for (int i = 0; i < 3; ++i) note.centre_in_world_m[i] = centre.at(static_cast<size_t>(i)).get<double>();
    note.eta = json.at("eta").get<double>();
    note.strategy = json.at("strategy").get<std::string>();
    return note;
  } catch (const nlohmann::json::exception &error) {
    throw std::runtime_error("owner's note " + path + " is damaged (" + error.what() +
                             "); give the one that spherecloud build wrote beside the map");
  } catch (const std::runtime_error &error) {
    throw std::runtime_error("owner's note " + path + ": " + error.what());
  }
}

}  // namespace sphc::host
