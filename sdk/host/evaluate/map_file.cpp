#include "host/evaluate/map_file.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "host/base/hex_text.h"
#include "host/base/regular_file.h"
#include "host/base/usage_error.h"
#include "host/encryption/encrypted_map.h"

namespace sphc::host {
namespace {

constexpr size_t kMapAlignment = 64;

void checkUsable(const std::string &what, const spherecloud::Status &status) {
  if (!status.ok()) throw std::runtime_error(what + ": " + status.text() + " [" + status.name() + "]");
}

std::string idOf(const MapFile &file) {
  const sphc_map_info info = file.map.info();
  return hexText(info.map_id, sizeof info.map_id);
}

}  // namespace

void checkIsNotEncrypted(const std::string &path, const void *bytes, size_t count) {
  const std::string head = kEncryptionHead;
  if (count < head.size() || std::memcmp(bytes, head.data(), head.size()) != 0) return;
  throw std::runtime_error("cannot use the map " + path +
                           ": it is encrypted; spherecloud decrypt makes the map of it, with the key");
}

MapFile openMapFile(const std::string &path, const Trust &trust) {
  checkIsFile(path, "the map file itself, which spherecloud build wrote");
  MapFile file;
  checkUsable("cannot read the map " + path, spherecloud::readFile(path.c_str(), &file.bytes));
  checkIsNotEncrypted(path, file.bytes.data(), file.bytes.size());
  if (!trust.keys.empty()) file.statement = checkSignature(trust, path, file.bytes.data(), file.bytes.size());
  checkUsable("cannot use the map " + path,
              spherecloud::Map::open(file.bytes.data(), file.bytes.size(), &file.map));
  return file;
}

std::vector<MapFile> openMapFiles(const std::vector<std::string> &paths, const Trust &trust) {
  std::vector<MapFile> files;
  for (const std::string &path : paths) {
    files.push_back(openMapFile(path, trust));
    for (size_t i = 0; i + 1 < files.size(); ++i)
      if (idOf(files[i]) == idOf(files.back()))
        throw UsageError("--map: " + paths[i] + " and " + path + " are one map; give it once");
  }
  return files;
}

MapFile openMapBytes(const std::vector<uint8_t> &bytes) {
  MapFile file;
  file.bytes = spherecloud::AlignedBuffer(bytes.size(), kMapAlignment);
  std::memcpy(file.bytes.data(), bytes.data(), bytes.size());
  checkUsable("cannot use the map", spherecloud::Map::open(file.bytes.data(), file.bytes.size(), &file.map));
  return file;
}

MapFacts mapFacts(const MapFile &file, const std::string &path) {
  const sphc_map_info info = file.map.info();
  MapFacts facts;
  facts.path = path;
  facts.id = idOf(file);
  facts.points = info.point_count;
  facts.format_version = info.format_version;
  facts.extractor = info.extractor;
  facts.file_bytes = info.file_bytes;
  facts.band = info.band;
  facts.directions.resize(info.point_count);
  for (uint32_t i = 0; i < info.point_count; ++i) sphc_map_direction(file.map.get(), i, facts.directions[i].data());
  return facts;
}

Vector3 centreByNote(const std::vector<std::string> &note_paths, const MapFile &file, const std::string &map_path) {
  const sphc_map_info info = file.map.info();
  std::string others;
  for (const std::string &path : note_paths) {
    const OwnerNote note = readOwnerNote(path);
    if (std::equal(note.map_id.begin(), note.map_id.end(), info.map_id)) return note.centre_in_world_m;
    others += (others.empty() ? "" : ", ") + path;
  }
  throw std::runtime_error("--owner-note: no note of " + map_path + " is given, but one of another map (" + others +
                           "): their map ids differ; give the note that was written beside this map");
}

}  // namespace sphc::host
