// What a ledger tells of its own soundness: a checksum over every value that it holds.
#pragma once
#include <cstdint>

struct sqlite3;

namespace sphc::host {

// Its table, with one row; the statements of a ledger that gets it.
extern const char kChecksumSchema[];
// CRC-32 of all values of the other tables, each with its type.  Throws SqliteFailure, as do those below.
uint32_t checksumOfContent(sqlite3 *database);
void writeChecksum(sqlite3 *database);
// Whether it has the table at all.
bool hasChecksum(sqlite3 *database);
bool isAsChecksumSays(sqlite3 *database);

}  // namespace sphc::host
