// What SQLite says of its last failure.
#pragma once
#include <sqlite3.h>

#include <new>
#include <string>

namespace sphc::host {

// Throws std::bad_alloc where memory was the cause: SQLite then also says "unable to open a temporary database
// file".
inline std::string sqliteError(sqlite3 *database) {
  if (sqlite3_errcode(database) == SQLITE_NOMEM) throw std::bad_alloc();
  return sqlite3_errmsg(database);
}

}  // namespace sphc::host
