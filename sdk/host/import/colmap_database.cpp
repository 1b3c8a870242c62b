// COLMAP's database.db: documentation "Database Format".  Of its tables only descriptors is read; from 4.0 on that
// has a column `type`.
#include <sqlite3.h>

#include <cmath>
#include <memory>
#include <optional>

#include "host/base/regular_file.h"
#include "host/cameras/fault.h"
#include "host/import/colmap_descriptors.h"
#include "host/import/sqlite_error.h"

namespace sphc::host {
namespace {

constexpr int64_t kSift = 0;  // of the column `type`

struct Closer {
  void operator()(sqlite3 *database) const { sqlite3_close(database); }
  void operator()(sqlite3_stmt *statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Closer>;
using Statement = std::unique_ptr<sqlite3_stmt, Closer>;

[[noreturn]] void refuseDatabase(const std::string &path, sqlite3 *database) {
  refuse(path, "the database", sqliteError(database) + "; is it the database.db of this model?");
}

Database openDatabase(const std::string &path) {
  checkIsFile(path, "COLMAP's database.db itself");
  sqlite3 *opened = nullptr;
  const int status = sqlite3_open_v2(path.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  Database database(opened);
  if (status != SQLITE_OK) refuseDatabase(path, opened);
  // Tables alone: a foreign file must not run what it brings along.
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  return database;
}

// Null where the table has no such columns.
Statement prepare(sqlite3 *database, const char *sql) {
  sqlite3_stmt *statement = nullptr;
  sqlite3_prepare_v2(database, sql, -1, &statement, nullptr);
  return Statement(statement);
}

// COLMAP's are RootSIFT too, in 4 x 4 cells in our order; its orientations turn the other way.
Descriptor fromColmap(const uint8_t *bytes) {
  Descriptor descriptor;
  for (size_t i = 0; i < kDescriptorBytes; ++i) {
    const size_t cell = i / 8, orientation = i % 8;
    descriptor.bytes[i] = bytes[8 * cell + (8 - orientation) % 8];
  }
  return descriptor;
}

}  // namespace

DescriptorsOfPoints describeFromDatabase(const ColmapModel &model, const std::string &path) {
  const Database database = openDatabase(path);
  Statement row = prepare(database.get(), "SELECT rows, cols, data, type FROM descriptors WHERE image_id = ?");
  const bool typed = row != nullptr;
  if (!row) row = prepare(database.get(), "SELECT rows, cols, data FROM descriptors WHERE image_id = ?");
  if (!row) refuseDatabase(path, database.get());
  std::map<uint32_t, std::vector<std::pair<uint64_t, uint32_t>>> seen;
  for (const auto &[id, point] : model.points)
    for (const ColmapObservation &o : point.track) seen[o.image].emplace_back(id, o.keypoint);
  DescriptorsOfPoints descriptors;
  for (const auto &[image, points] : seen) {
    const std::string place = "descriptors of image " + std::to_string(image);
    sqlite3_reset(row.get());
    sqlite3_bind_int64(row.get(), 1, image);
    const int found = sqlite3_step(row.get());
    if (found == SQLITE_DONE) refuse(path, place, "are not there; is it the database of this model?");
    if (found != SQLITE_ROW) refuseDatabase(path, database.get());
    if (typed && sqlite3_column_int64(row.get(), 3) != kSift)
      refuse(path, place, "are not SIFT; describe the images again, with --images");
    const int64_t rows = sqlite3_column_int64(row.get(), 0), cols = sqlite3_column_int64(row.get(), 1);
    const void *data = sqlite3_column_blob(row.get(), 2);
    const int64_t bytes = sqlite3_column_bytes(row.get(), 2);
    if (cols != static_cast<int64_t>(kDescriptorBytes) || rows < 0 || bytes % cols != 0 || bytes / cols != rows)
      refuse(path, place, "are not rows of 128 bytes; describe the images again, with --images");
    for (const auto &[point, keypoint] : points) {
      if (keypoint >= rows)
        refuse(path, place, "are fewer than its keypoints in the model; is it the database of this model?");
      descriptors[point].push_back(fromColmap(static_cast<const uint8_t *>(data) + kDescriptorBytes * keypoint));
    }
  }
  return descriptors;
}

}  // namespace sphc::host
