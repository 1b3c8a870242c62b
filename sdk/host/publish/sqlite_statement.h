// A prepared statement of SQLite, with errors that are exceptions.
#pragma once
#include <sqlite3.h>

#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/import/sqlite_error.h"

namespace sphc::host {

// With the code of SQLite's.
struct SqliteFailure : std::runtime_error {
  explicit SqliteFailure(sqlite3 *database)
      : std::runtime_error(sqliteError(database)), code(sqlite3_errcode(database)) {}
  int code;
};

class SqliteStatement {
 public:
  SqliteStatement(sqlite3 *database, const char *text) : database_(database) {
    sqlite3_stmt *statement = nullptr;
    check(sqlite3_prepare_v2(database, text, -1, &statement, nullptr));
    statement_.reset(statement);
  }

  // Parameters in turn.
  SqliteStatement &bind(int64_t value) {
    check(sqlite3_bind_int64(get(), ++bound_, value));
    return *this;
  }
  SqliteStatement &bind(double value) {
    check(sqlite3_bind_double(get(), ++bound_, value));
    return *this;
  }
  SqliteStatement &bind(const std::string &value) {
    check(sqlite3_bind_text(get(), ++bound_, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT));
    return *this;
  }
  SqliteStatement &bind(const void *bytes, size_t count) {
    check(sqlite3_bind_blob(get(), ++bound_, bytes, static_cast<int>(count), SQLITE_TRANSIENT));
    return *this;
  }

  // True while there is a row.
  bool step() {
    const int result = sqlite3_step(get());
    if (result != SQLITE_ROW && result != SQLITE_DONE) check(result);
    return result == SQLITE_ROW;
  }
  // Runs a statement without rows, ready for the next parameters.
  void run() {
    step();
    check(sqlite3_reset(get()));
    bound_ = 0;
  }

  int columns() { return sqlite3_column_count(get()); }
  int type(int column) { return sqlite3_column_type(get(), column); }  // SQLITE_INTEGER and so on
  int64_t integer(int column) { return sqlite3_column_int64(get(), column); }
  double real(int column) { return sqlite3_column_double(get(), column); }
  std::string text(int column) {
    const void *bytes = sqlite3_column_blob(get(), column);
    return bytes ? std::string(static_cast<const char *>(bytes), size(column)) : std::string();
  }
  // Copies a blob of exactly `count` bytes; false when it has another size.
  bool blob(int column, void *out, size_t count) {
    const void *bytes = sqlite3_column_blob(get(), column);
    if (!bytes || size(column) != count) return false;
    std::memcpy(out, bytes, count);
    return true;
  }

 private:
  struct Finalizer {
    void operator()(sqlite3_stmt *statement) const { sqlite3_finalize(statement); }
  };
  sqlite3_stmt *get() const { return statement_.get(); }
  size_t size(int column) { return static_cast<size_t>(sqlite3_column_bytes(get(), column)); }
  void check(int result) const {
    if (result != SQLITE_OK) throw SqliteFailure(database_);
  }

  sqlite3 *database_;
  std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
  int bound_ = 0;
};

}  // namespace sphc::host
