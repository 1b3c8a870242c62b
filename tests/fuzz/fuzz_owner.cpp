// What the owner of a map keeps: the note beside the map, and the ledger of releases.
#include <sqlite3.h>

#include <cmath>

#include "host/publish/ledger.h"
#include "host/publish/map_writer.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/refuse_or_do.h"
#include "tests/fuzz/targets.h"
#include "tests/support/made_up_model.h"

namespace sphc::fuzz {
namespace {

using namespace sphc::host;

host::Place smallPlace() {
  Random random(5);
  host::Place place;
  place.number = 1;
  place.centre_m = {1.5, -2, 0.25};
  place.eta = 0.5;
  place.strategy = "gaussian";
  for (const ModelPoint &point : test::madeUpRoom(3, 5).points)
    place.points.push_back({point, {1, 65535}, test::randomDescriptor(&random), true, 1});
  place.releases.push_back({{1, 2, 3}, 7, 3, 1234567890});
  return place;
}

std::vector<uint8_t> bytesAt(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

void ownerNote(const uint8_t *data, size_t bytes) {
  const MemoryFile file(data, bytes);
  refuseOrDo([&file] {
    const OwnerNote note = readOwnerNote(file.path());
    if (!note.centre_in_world_m.allFinite() || !(note.eta > 0 && note.eta <= 1))
      broken("a note that is read makes sense");
    accept();
  });
}

std::vector<std::vector<uint8_t>> ownerNoteSeeds() {
  const NamedFile file(nullptr, 0);
  writeOwnerNote(file.path(), {{1, 2, 3}, {1.5, -2, 0.25}, 0.5, "patchwork"});
  return {bytesAt(file.path())};
}

void ledger(const uint8_t *data, size_t bytes) {
  const NamedFile file(data, bytes);
  refuseOrDo([&file] {
    for (const host::Place &place : Ledger::openToRead(file.path()).places())
      for (const PlacePoint &point : place.points)
        if (!point.seen.position_m.allFinite()) broken("points that are read have positions");
    accept();
  });
  refuseOrDo([&file] {
    Ledger opened = Ledger::openOrMake(file.path(), nullptr);
    const size_t places = opened.places().size();
    host::Place further = smallPlace();
    further.number = static_cast<uint32_t>(places + 1);
    opened.record(further);
    if (opened.places().size() != places + 1) broken("a place that was recorded is there");
  });
}

// Behind a checksum a changed byte is seen by nothing else, so one is as it was before there was any.
std::vector<std::vector<uint8_t>> ledgerSeeds() {
  const NamedFile file(nullptr, 0);
  const SecretKey key = {9};
  Ledger::openOrMake(file.path(), &key).record(smallPlace());
  const std::vector<uint8_t> newest = bytesAt(file.path());
  sqlite3 *database = nullptr;
  sqlite3_open(file.path().c_str(), &database);
  sqlite3_exec(database, "DROP TABLE checksum; PRAGMA user_version = 3", nullptr, nullptr, nullptr);
  sqlite3_close(database);
  return {newest, bytesAt(file.path()), {}};
}

}  // namespace sphc::fuzz
