#include "host/publish/ledger.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "host/base/private_file.h"
#include "host/base/regular_file.h"
#include "host/base/shell_word.h"
#include "host/publish/ledger_checksum.h"
#include "host/publish/sqlite_statement.h"
#include "runtime/map/crc32.h"

namespace sphc::host {
namespace {

constexpr int64_t kApplication = 0x53504C47, kFirstVersion = 1, kVersion = 4;  // "SPLG"
constexpr int64_t kFirstWithChecksum = 4;

const char kSchema[] = R"(
CREATE TABLE owner (secret_key BLOB NOT NULL);
CREATE TABLE place (number INTEGER PRIMARY KEY, centre_x REAL NOT NULL, centre_y REAL NOT NULL, centre_z REAL NOT NULL,
                    eta REAL NOT NULL, strategy TEXT NOT NULL, band INTEGER NOT NULL,
                    fake_option REAL NOT NULL);
CREATE TABLE release (place INTEGER NOT NULL, number INTEGER NOT NULL, map_id BLOB NOT NULL, crc32 INTEGER NOT NULL,
                      points INTEGER NOT NULL, time_s INTEGER NOT NULL, PRIMARY KEY (place, number));
CREATE TABLE point (place INTEGER NOT NULL, number INTEGER NOT NULL, x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
                    sigma REAL NOT NULL, observations INTEGER NOT NULL, descriptor BLOB NOT NULL, u INTEGER NOT NULL,
                    v INTEGER NOT NULL, shown BLOB NOT NULL, real INTEGER NOT NULL, release INTEGER NOT NULL,
                    PRIMARY KEY (place, number));
)";

// Of `place`.  Earlier ledgers lack it, and mean 0: before there were bands, all was visible.
struct AddedColumn {
  int64_t version;  // the first that has it
  const char *name, *type;
};
const AddedColumn kBand = {2, "band", "INTEGER"}, kFakeOption = {3, "fake_option", "REAL"};

[[noreturn]] void refuse(const std::string &path, const std::string &why) {
  throw std::runtime_error("ledger " + path + ": " + why);
}

// `what` failed with this code of SQLite's, which tells the cure.
[[noreturn]] void refuseByCode(const std::string &path, const std::string &what, int code) {
  switch (code) {
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_READONLY:
      refuse(
          path,
          what + "; allow yourself to write the ledger and in its folder, or choose another place with --ledger");
    case SQLITE_BUSY:
      refuse(path, what + "; another program is using it: wait until that ends");
    case SQLITE_ERROR:  // a table is not there
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      refuse(path, what + "; give a ledger that spherecloud build made, or take the backup");
    default:
      refuse(path, what + "; is the disk full, or failing?");
  }
}

// SQLite gives its journal the mode of the file, so the file is made first.
// True where it was not there.
bool makeFile(const std::string &path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file >= 0) close(file);
  if (file < 0 && errno != EEXIST && errno != EISDIR)
    refuse(path, std::string("cannot be made: ") + std::strerror(errno) + "; choose another place with --ledger");
  return file >= 0;
}

void checkMode(const std::string &path) {
  checkMayRead(path);
  struct stat facts = {};
  if (stat(path.c_str(), &facts) != 0)
    refuse(path,
           std::string(std::strerror(errno)) + "; is the file there? Its name is the ledger's, not the map's");
  if (!S_ISREG(facts.st_mode))
    refuse(path, std::string(S_ISDIR(facts.st_mode) ? "this is a folder" : "this is a device or a pipe") +
                     "; give the ledger itself, a file");
  // Of an empty file a ledger is made, in its mode.
  if ((facts.st_size == 0 || isLedger(path)) && isForOthers(facts.st_mode))
    refuse(path, "others may read it, and it tells real points from fake ones; run: chmod 600 " + shellWord(path));
}

int64_t valueOf(sqlite3 *database, const char *statement) {
  SqliteStatement query(database, statement);
  return query.step() ? query.integer(0) : 0;
}

int64_t versionOf(sqlite3 *database) { return valueOf(database, "PRAGMA user_version"); }

std::string setVersion() { return "PRAGMA user_version = " + std::to_string(kVersion) + ";"; }

std::string orZero(const AddedColumn &column, int64_t version) {
  return version < column.version ? "0" : column.name;
}

// Statements that bring a ledger of this version to the newest.
std::string upgradeFrom(int64_t version) {
  std::string statements;
  for (const AddedColumn &column : {kBand, kFakeOption})
    if (version < column.version)
      statements +=
          std::string("ALTER TABLE place ADD COLUMN ") + column.name + " " + column.type + " NOT NULL DEFAULT 0;";
  if (version < kFirstWithChecksum) statements += kChecksumSchema;
  return statements + setVersion();
}

// Tables alone, since a view can hold more rows than any file.
void checkContent(sqlite3 *database) {
  SqliteStatement check(database, "PRAGMA quick_check(1)");
  if (!check.step() || check.text(0) != "ok") throw std::runtime_error("it is damaged; take the backup");
  if (valueOf(database, "SELECT count(*) FROM sqlite_master WHERE type NOT IN ('table', 'index')") != 0)
    throw std::runtime_error("this is not a ledger; give a ledger that spherecloud build made");
}

// An earlier ledger has none; in one that has it all the same the version is damaged.
void checkChecksum(sqlite3 *database, int64_t version) {
  const bool is_kept = version >= kFirstWithChecksum;
  if (hasChecksum(database) != is_kept || (is_kept && !isAsChecksumSays(database)))
    throw std::runtime_error("it is damaged: what it holds does not fit its checksum; take the backup");
}

bool isPacked(int64_t coordinate) { return coordinate >= 1 && coordinate <= 65535; }

PlacePoint pointOf(SqliteStatement *row) {
  PlacePoint point = {};
  point.seen.position_m = {row->real(0), row->real(1), row->real(2)};
  point.seen.sigma_m = row->real(3);
  point.seen.observations = static_cast<uint32_t>(row->integer(4));
  const int64_t u = row->integer(6), v = row->integer(7);
  point.direction = {static_cast<uint16_t>(u), static_cast<uint16_t>(v)};
  point.real = row->integer(9) != 0;
  point.release = static_cast<uint32_t>(row->integer(10));
  const bool valid = row->blob(5, point.seen.descriptor.bytes, kDescriptorBytes) &&
                     row->blob(8, point.descriptor.bytes, kDescriptorBytes) && isInRange(point.seen) &&
                     isPacked(u) && isPacked(v);
  if (!valid) throw std::runtime_error("a point is damaged; take the backup");
  return point;
}

bool isSound(const Place &place) {
  return isInRange(place.centre_m) && place.eta > 0 && place.eta <= 1 && place.fake_option >= 0;
}

std::vector<PlacePoint> readPoints(sqlite3 *database, uint32_t place) {
  SqliteStatement rows(database,
                       "SELECT x, y, z, sigma, observations, descriptor, u, v, shown, real, release FROM point "
                       "WHERE place = ? ORDER BY number");
  rows.bind(int64_t{place});
  std::vector<PlacePoint> points;
  while (rows.step()) points.push_back(pointOf(&rows));
  return points;
}

std::vector<Release> readReleases(sqlite3 *database, const Place &place) {
  SqliteStatement rows(database,
                       "SELECT map_id, crc32, points, time_s FROM release WHERE place = ? ORDER BY number");
  rows.bind(int64_t{place.number});
  std::vector<Release> releases;
  while (rows.step()) {
    Release release = {
        {}, static_cast<uint32_t>(rows.integer(1)), static_cast<uint32_t>(rows.integer(2)), rows.integer(3)};
    if (!rows.blob(0, release.map_id.data(), release.map_id.size()) || release.points > place.points.size())
      throw std::runtime_error("a release is damaged; take the backup");
    releases.push_back(release);
  }
  return releases;
}

void writePoints(sqlite3 *database, const Place &place) {
  SqliteStatement known(database, "SELECT count(*) FROM point WHERE place = ?");
  known.bind(int64_t{place.number}).step();
  SqliteStatement insert(database, "INSERT INTO point VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (size_t i = static_cast<size_t>(known.integer(0)); i < place.points.size(); ++i) {
    const PlacePoint &point = place.points[i];
    const Vector3 &p = point.seen.position_m;
    insert.bind(int64_t{place.number}).bind(static_cast<int64_t>(i + 1)).bind(p.x()).bind(p.y()).bind(p.z());
    insert.bind(point.seen.sigma_m).bind(int64_t{point.seen.observations});
    insert.bind(point.seen.descriptor.bytes, kDescriptorBytes);
    insert.bind(int64_t{point.direction.u}).bind(int64_t{point.direction.v});
    insert.bind(point.descriptor.bytes, kDescriptorBytes);
    insert.bind(int64_t{point.real}).bind(int64_t{point.release}).run();
  }
}

void writeReleases(sqlite3 *database, const Place &place) {
  SqliteStatement insert(database, "INSERT INTO release VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT DO NOTHING");
  for (size_t i = 0; i < place.releases.size(); ++i) {
    const Release &release = place.releases[i];
    insert.bind(int64_t{place.number}).bind(static_cast<int64_t>(i + 1));
    insert.bind(release.map_id.data(), release.map_id.size()).bind(int64_t{release.crc32});
    insert.bind(int64_t{release.points}).bind(release.time_s).run();
  }
}

// One that is there stays; what is no number is an error, which OR IGNORE would hide.
void writePlace(sqlite3 *database, const Place &place) {
  SqliteStatement insert(database, "INSERT INTO place VALUES (?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT DO NOTHING");
  const Vector3 &c = place.centre_m;
  insert.bind(int64_t{place.number}).bind(c.x()).bind(c.y()).bind(c.z()).bind(place.eta).bind(place.strategy);
  insert.bind(int64_t{place.band}).bind(place.fake_option).run();
  writePoints(database, place);
  writeReleases(database, place);
}

}  // namespace

// Before the lock goes: nobody else can have recorded anything in it.
void Ledger::Closer::operator()(sqlite3 *database) const {
  if (!unrecorded.empty()) {
    unlink(unrecorded.c_str());
    unlink((unrecorded + "-journal").c_str());
  }
  sqlite3_close(database);
}

Ledger::Ledger(const std::string &path, int flags) : path_(path) {
  sqlite3 *database = nullptr;
  // Of its whole path, since SQLite keeps one of the name ":memory:" nowhere.
  const int result = sqlite3_open_v2(std::filesystem::absolute(path).c_str(), &database, flags, nullptr);
  database_.reset(database);
  if (result != SQLITE_OK)
    refuse(path, "cannot be opened: " + sqliteError(database) + "; give a ledger that spherecloud build made");
}

void Ledger::run(const char *statement) {
  if (sqlite3_exec(database_.get(), statement, nullptr, nullptr, nullptr) != SQLITE_OK)
    refuseByCode(path_, sqliteError(database_.get()), sqlite3_errcode(database_.get()));
}

void Ledger::make(const SecretKey &key) {
  run(kSchema);
  run(kChecksumSchema);
  SqliteStatement insert(database_.get(), "INSERT INTO owner VALUES (?)");
  insert.bind(key.data(), key.size()).run();
  run(("PRAGMA application_id = " + std::to_string(kApplication)).c_str());
  run(setVersion().c_str());
  writeChecksum(database_.get());
}

// In one transaction with its checksum; an earlier ledger is brought to the newest version by it.
void Ledger::change(const std::function<void()> &statements) {
  run("BEGIN IMMEDIATE");
  try {
    const int64_t version = versionOf(database_.get());
    if (version < kVersion) run(upgradeFrom(version).c_str());
    statements();
    writeChecksum(database_.get());
  } catch (const SqliteFailure &failure) {
    sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    refuseByCode(path_, failure.what(), failure.code);
  }
  run("COMMIT");
}

bool Ledger::isEmpty() const {
  try {
    return valueOf(database_.get(), "SELECT count(*) FROM sqlite_master") == 0;
  } catch (const SqliteFailure &failure) {
    refuseByCode(path_, failure.what(), failure.code);
  }
}

void Ledger::read(const SecretKey *expected) {
  bool is_unused = false;
  try {
    if (valueOf(database_.get(), "PRAGMA application_id") != kApplication)
      throw std::runtime_error("this is not a ledger; give a ledger that spherecloud build made");
    const int64_t version = versionOf(database_.get());
    if (version < kFirstVersion || version > kVersion)
      throw std::runtime_error("it was written by another version of this program; use that one");
    checkContent(database_.get());
    checkChecksum(database_.get(), version);
    SqliteStatement owner(database_.get(), "SELECT secret_key FROM owner");
    if (!owner.step() || !owner.blob(0, key_.data(), key_.size()))
      throw std::runtime_error("it holds no key; take the backup");
    is_unused = valueOf(database_.get(), "SELECT count(*) FROM place") == 0;
  } catch (const SqliteFailure &failure) {
    refuseByCode(path_, failure.what(), failure.code);
  } catch (const std::runtime_error &error) {
    refuse(path_, error.what());
  }
  if (expected && *expected != key_ && is_unused) return takeKey(*expected);
  if (expected && *expected != key_)
    refuse(path_, "it was made with another key. A place keeps its key: leave --key out; a ledger has its own");
}

// Nothing was released with the old one: a build was killed before.
void Ledger::takeKey(const SecretKey &key) {
  change([this, &key] {
    SqliteStatement update(database_.get(), "UPDATE owner SET secret_key = ?");
    update.bind(key.data(), key.size()).run();
  });
  key_ = key;
}

void Ledger::lock(bool is_new) {
  try {
    run("PRAGMA locking_mode = EXCLUSIVE; PRAGMA synchronous = FULL; BEGIN EXCLUSIVE");
  } catch (const std::runtime_error &) {
    // A full disk has no room for the journal.  Reading holds a lock until the file is closed, so nobody fills it.
    if (is_new && isEmpty()) database_.get_deleter().unrecorded = path_;
    throw;
  }
}

Ledger Ledger::openOrMake(const std::string &path, const SecretKey *key) {
  const bool is_new = makeFile(path);
  checkMode(path);
  Ledger ledger(path, SQLITE_OPEN_READWRITE);
  ledger.lock(is_new);
  if (ledger.isEmpty()) {
    // Another program may have filled a new file before this one had it alone.
    if (is_new) ledger.database_.get_deleter().unrecorded = path;
    ledger.make(key ? *key : newSecretKey());
  }
  ledger.run("COMMIT");
  ledger.read(key);
  if (versionOf(ledger.database_.get()) < kVersion) ledger.change([] {});
  return ledger;
}

Ledger Ledger::openToRead(const std::string &path) {
  checkMode(path);
  // Who may only read cannot undo what a killed build left half written.
  Ledger ledger(path, SQLITE_OPEN_READWRITE);
  ledger.read(nullptr);
  return ledger;
}

std::vector<Place> Ledger::places() const {
  try {
    std::vector<Place> places;
    const int64_t version = versionOf(database_.get());
    const std::string query = "SELECT number, centre_x, centre_y, centre_z, eta, strategy, " +
                              orZero(kBand, version) + ", " + orZero(kFakeOption, version) +
                              " FROM place ORDER BY number";
    SqliteStatement rows(database_.get(), query.c_str());
    while (rows.step()) {
      Place place;
      place.number = static_cast<uint32_t>(rows.integer(0));
      place.centre_m = {rows.real(1), rows.real(2), rows.real(3)};
      place.eta = rows.real(4);
      place.strategy = rows.text(5);
      place.band = static_cast<sphc_band>(rows.integer(6));
      place.fake_option = rows.real(7);
      if (place.number != places.size() + 1 || !isSound(place) || rows.integer(6) < SPHC_BAND_VISIBLE ||
          rows.integer(6) > SPHC_BAND_INFRARED)
        throw std::runtime_error("a place is damaged; take the backup");
      place.points = readPoints(database_.get(), place.number);
      place.releases = readReleases(database_.get(), place);
      places.push_back(std::move(place));
    }
    return places;
  } catch (const SqliteFailure &failure) {
    refuseByCode(path_, failure.what(), failure.code);
  } catch (const std::runtime_error &error) {
    refuse(path_, error.what());
  }
}

void Ledger::record(const Place &place) {
  if (!isSound(place))
    refuse(path_,
           "a place's centre must lie within 1000 km of the world's origin and its eta in 0 to 1; build the map "
           "of other poses");
  for (const PlacePoint &point : place.points)
    if (!isInRange(point.seen))
      refuse(
          path_,
          "a place's points must lie, and be known, within 1000 km of the world's origin; build the map of other "
          "poses");
  change([this, &place] { writePlace(database_.get(), place); });
  database_.get_deleter().unrecorded.clear();
}

bool isLedger(const std::string &path) {
  constexpr size_t kApplicationAt = 68;  // in the header of an SQLite file
  char head[kApplicationAt + 4] = {};
  std::ifstream file(path, std::ios::binary);
  const char application[] = {kApplication >> 24, kApplication >> 16 & 0xFF, kApplication >> 8 & 0xFF,
                              kApplication & 0xFF};
  return file.read(head, sizeof head) && std::memcmp(head, "SQLite format 3", 16) == 0 &&
         std::memcmp(head + kApplicationAt, application, sizeof application) == 0;
}

const Release *releaseOf(const Place &place, const std::vector<uint8_t> &file) {
  const uint32_t crc = crc32(0, file.data(), file.size());
  const auto released = std::find_if(place.releases.begin(), place.releases.end(),
                                     [crc](const Release &release) { return release.crc32 == crc; });
  return released == place.releases.end() ? nullptr : &*released;
}

}  // namespace sphc::host
