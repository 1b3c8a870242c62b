// A map file in memory, opened through the C interface.
#pragma once
#include <spherecloud/spherecloud.hpp>
#include <string>

#include "host/publish/map_writer.h"
#include "host/report/run.h"
#include "host/signing/signed_map.h"

namespace sphc::host {

struct MapFile {
  spherecloud::AlignedBuffer bytes;  // outlives the map
  spherecloud::Map map;
  sphc_signature_statement statement = {};  // where keys were trusted
};

// Throws std::runtime_error where the bytes are an encrypted map's: of them the map's reader cannot know the cause.
void checkIsNotEncrypted(const std::string &path, const void *bytes, size_t count);
// Validates every byte; where keys are trusted, first that one of them signed the map, in the file beside it.
// Throws std::runtime_error with cause and cure.
MapFile openMapFile(const std::string &path, const Trust &trust = {});
// Several, which one localizer takes: UsageError where two of them are one map.
std::vector<MapFile> openMapFiles(const std::vector<std::string> &paths, const Trust &trust);
// The same of a map that is no file.
MapFile openMapBytes(const std::vector<uint8_t> &bytes);
MapFacts mapFacts(const MapFile &file, const std::string &path);
// Where the map's centre is, as that of the notes says that was written beside it.  Throws std::runtime_error when
// they all belong to other maps.
Vector3 centreByNote(const std::vector<std::string> &note_paths, const MapFile &file, const std::string &map_path);

}  // namespace sphc::host
