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
// The same of a map that is no file.
MapFile openMapBytes(const std::vector<uint8_t> &bytes);
MapFacts mapFacts(const MapFile &file, const std::string &path);
// Where the map's centre is, as the note says that was written beside it.  Throws std::runtime_error when the note
// belongs to another map.
Vector3 centreByNote(const std::string &note_path, const MapFile &file, const std::string &map_path);

}  // namespace sphc::host
