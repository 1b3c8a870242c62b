#include "host/publish/ledger_checksum.h"

#include <string>

#include "host/publish/sqlite_statement.h"
#include "runtime/map/crc32.h"

namespace sphc::host {
namespace {

template <typename T>
uint32_t addNumber(uint32_t crc, T value) {
  return crc32(crc, &value, sizeof value);
}

uint32_t addValue(uint32_t crc, SqliteStatement *row, int column) {
  const int type = row->type(column);
  crc = addNumber(crc, static_cast<uint8_t>(type));
  if (type == SQLITE_INTEGER) return addNumber(crc, row->integer(column));
  if (type == SQLITE_FLOAT) return addNumber(crc, row->real(column));
  const std::string bytes = row->text(column);
  return crc32(addNumber(crc, uint64_t{bytes.size()}), bytes.data(), bytes.size());
}

}  // namespace

const char kChecksumSchema[] = "CREATE TABLE checksum (crc32 INTEGER NOT NULL); INSERT INTO checksum VALUES (0);";

uint32_t checksumOfContent(sqlite3 *database) {
  uint32_t crc = 0;
  for (const char *query :
       {"SELECT * FROM owner", "SELECT * FROM place ORDER BY number",
        "SELECT * FROM release ORDER BY place, number", "SELECT * FROM point ORDER BY place, number"}) {
    SqliteStatement row(database, query);
    while (row.step())
      for (int column = 0; column < row.columns(); ++column) crc = addValue(crc, &row, column);
  }
  return crc;
}

void writeChecksum(sqlite3 *database) {
  SqliteStatement update(database, "UPDATE checksum SET crc32 = ?");
  update.bind(int64_t{checksumOfContent(database)}).run();
}

bool hasChecksum(sqlite3 *database) {
  return SqliteStatement(database, "SELECT 1 FROM sqlite_master WHERE name = 'checksum'").step();
}

bool isAsChecksumSays(sqlite3 *database) {
  SqliteStatement kept(database, "SELECT crc32 FROM checksum");
  return kept.step() && kept.integer(0) == int64_t{checksumOfContent(database)};
}

}  // namespace sphc::host
