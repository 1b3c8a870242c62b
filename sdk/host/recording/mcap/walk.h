// Walks over the records of an MCAP file, or of one chunk, without reading what it can jump over.
#pragma once

#include "file.h"
#include "records.h"

namespace sphc::recording {

struct RecordPlace {
  Op op;
  uint64_t start;    // in the file
  uint64_t content;  // likewise
  uint64_t bytes;    // of the content
  uint64_t end() const { return content + bytes; }
};

enum class WalkEnd {
  kDataEnd,  // came to the end of the data section: the recording was closed
  kEdge,     // used all bytes up
  kTorn      // what is there next is no whole record
};

// Shows every whole record from `at` up to `end`, or to the end of the data section, to visit(const RecordPlace &).
template <typename Visit>
WalkEnd walkRecords(FileWindow &window, uint64_t at, uint64_t end, Visit &&visit) {
  while (at < end) {
    if (end - at < kRecordHeadBytes) return WalkEnd::kTorn;
    const ByteView head = window.at(at, kRecordHeadBytes);
    const RecordPlace record{static_cast<Op>(head.data[0]), at, at + kRecordHeadBytes,
                             loadLittle<uint64_t>(head.data + 1)};
    if (head.data[0] == 0 || record.bytes > end - record.content) return WalkEnd::kTorn;
    visit(record);
    if (record.op == Op::kDataEnd) return WalkEnd::kDataEnd;
    at = record.end();
  }
  return WalkEnd::kEdge;
}

// The CRC-32 of the first `bytes` of the file.
uint32_t crcOfStart(const File &file, uint64_t bytes);

// True when there is a recording's beginning.
bool hasMagic(FileWindow &window, uint64_t at);

// Where a chunk's records are.
struct ChunkPlace {
  uint64_t start;  // of their bytes, in the file
  uint64_t bytes;
  uint32_t crc;  // 0: none
};
// False when the chunk is malformed, compressed, or over 1 GiB.
bool readChunk(FileWindow &window, const RecordPlace &record, ChunkHead &head, ChunkPlace &place);

// One chunk in memory, checked by its checksum.
class ChunkReader {
 public:
  explicit ChunkReader(const File &file) : file_(file) {}
  // Null when the checksum is wrong.  Valid until the next call.
  const uint8_t *load(const ChunkPlace &place);

 private:
  const File &file_;
  Bytes bytes_;  // grows to the largest chunk
  uint64_t loaded_ = 0;
};

}  // namespace sphc::recording
