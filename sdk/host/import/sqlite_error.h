// What SQLite says of its last failure.
#pragma once
#include <sqlite3.h>

#include <algorithm>
#include <new>
#include <string>

namespace sphc::host {

// Without control characters, which it may quote from a damaged file, and a terminal would obey.  Throws
// std::bad_alloc where memory was the cause: SQLite then also says "unable to open a temporary database file".
inline std::string sqliteError(sqlite3 *database) {
  if (sqlite3_errcode(database) == SQLITE_NOMEM) throw std::bad_alloc();
  std::string text = sqlite3_errmsg(database);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, '?');
  return text;
}

}  // namespace sphc::host
