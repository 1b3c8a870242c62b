#include "writer.h"

#include <zlib.h>

#include <algorithm>
#include <string>

#include "summary.h"

namespace sphc::recording {

namespace {
constexpr size_t kMostMessages = 4096;  // in a chunk
constexpr size_t kIndexEntryBytes = 16;
const std::string kLibrary =
    "spherecloud " + std::to_string(SPHC_VERSION_MAJOR) + "." + std::to_string(SPHC_VERSION_MINOR);
}  // namespace

McapWriter::McapWriter(const std::filesystem::path &path) : path_(path), file_(File::create(path)) {}

// Delegates, so that the destructor removes the file when there is no memory.
McapWriter::McapWriter(const std::filesystem::path &path, size_t chunk_bytes, size_t most_message_bytes)
    : McapWriter(path) {
  chunk_bytes_ = chunk_bytes;
  File::syncFolder(path);
  chunk_.reserve(chunk_bytes + most_message_bytes + kRecordHeadBytes + kMessageHeadBytes);
  head_.reserve(256);
  index_.reserve(kMostMessages * kIndexEntryBytes + 1024);
  entries_.reserve(kMostMessages);
}

McapWriter::~McapWriter() {
  std::error_code ignored;
  if (!is_begun_) std::filesystem::remove(path_, ignored);
}

void McapWriter::begin(const Bytes &records) {
  Bytes start(std::begin(kMcapMagic), std::end(kMcapMagic));
  putHeader(start, "ros2", kLibrary);
  append({viewOf(start), viewOf(records)});
  file_.sync();
  is_begun_ = true;
}

void McapWriter::append(std::initializer_list<ByteView> parts) {
  file_.append(parts);
  for (const ByteView &part : parts) crc_ = static_cast<uint32_t>(crc32_z(crc_, part.data, part.size));
}

Bytes &McapWriter::beginMessage(Kind kind, uint32_t sequence, int64_t time_ns) {
  const uint64_t time = static_cast<uint64_t>(time_ns);
  entries_.push_back({static_cast<uint16_t>(kind), time, chunk_.size()});
  putMessage(chunk_, static_cast<uint16_t>(kind), sequence, time, {});
  return chunk_;
}

void McapWriter::endMessage() {
  const size_t start = entries_.back().offset;
  storeLittle(chunk_.data() + start + 1, uint64_t{chunk_.size() - start - kRecordHeadBytes});
  if (chunk_.size() >= chunk_bytes_ || entries_.size() == kMostMessages) endChunk();
}

void McapWriter::putMessageIndexes() {
  index_.clear();
  for (uint16_t channel = 1; channel <= static_cast<uint16_t>(Kind::kLast); ++channel) {
    const auto count = std::count_if(entries_.begin(), entries_.end(),
                                     [channel](const Entry &entry) { return entry.channel == channel; });
    if (count == 0) continue;
    putRecord(index_, Op::kMessageIndex, [&] {
      putLittle(index_, channel);
      putLittle(index_, static_cast<uint32_t>(count * static_cast<ptrdiff_t>(kIndexEntryBytes)));
      for (const Entry &entry : entries_) {
        if (entry.channel != channel) continue;
        putLittle(index_, entry.time_ns);
        putLittle(index_, entry.offset);
      }
    });
  }
}

void McapWriter::endChunk() {
  if (entries_.empty()) return;
  const auto [first, last] = std::minmax_element(
      entries_.begin(), entries_.end(), [](const Entry &a, const Entry &b) { return a.time_ns < b.time_ns; });
  const uint32_t crc = static_cast<uint32_t>(crc32_z(0, chunk_.data(), chunk_.size()));
  head_.clear();
  head_.push_back(static_cast<uint8_t>(Op::kChunk));
  putLittle(head_, uint64_t{kChunkHeadBytes + chunk_.size()});
  putChunkHead(head_, {first->time_ns, last->time_ns, chunk_.size(), crc, "", chunk_.size()});
  putMessageIndexes();
  file_.append({viewOf(head_), viewOf(chunk_), viewOf(index_)});
  const uLong with_head = crc32_z(crc_, head_.data(), head_.size());
  const uLong with_chunk = crc32_combine(with_head, crc, static_cast<z_off_t>(chunk_.size()));  // is not read again
  crc_ = static_cast<uint32_t>(crc32_z(with_chunk, index_.data(), index_.size()));
  chunk_.clear();
  entries_.clear();
}

void McapWriter::finish(const Bytes &records) {
  endChunk();
  const uint64_t recorded = file_.size();
  try {
    append({viewOf(records)});
    Bytes end;
    putDataEnd(end, crc_);
    file_.append({viewOf(end)});
    writeSummary(file_);
    file_.sync();
  } catch (...) {
    file_.truncate(recorded);  // a reader takes it for one that was cut there
    throw;
  }
}

}  // namespace sphc::recording
