#include "walk.h"

#include <zlib.h>

#include <algorithm>

namespace sphc::recording {

namespace {
constexpr uint64_t kMostChunkBytes = uint64_t{1} << 30;
constexpr size_t kMostHeadBytes = 128;   // the compression's name is a word
constexpr size_t kPieceBytes = 1 << 18;  // of a file that is read through
}  // namespace

bool hasMagic(FileWindow &window, uint64_t at) {
  return window.fileSize() >= sizeof kMcapMagic && at <= window.fileSize() - sizeof kMcapMagic &&
         std::memcmp(window.at(at, sizeof kMcapMagic).data, kMcapMagic, sizeof kMcapMagic) == 0;
}

uint32_t crcOfStart(const File &file, uint64_t bytes) {
  Bytes piece(static_cast<size_t>(std::min<uint64_t>(bytes, kPieceBytes)));
  uLong crc = 0;
  for (uint64_t at = 0; at < bytes; at += piece.size()) {
    piece.resize(static_cast<size_t>(std::min<uint64_t>(bytes - at, piece.size())));
    file.read(at, piece.data(), piece.size());
    crc = crc32_z(crc, piece.data(), piece.size());
  }
  return static_cast<uint32_t>(crc);
}

bool readChunk(FileWindow &window, const RecordPlace &record, ChunkHead &head, ChunkPlace &place) {
  const size_t shown = static_cast<size_t>(std::min<uint64_t>(record.bytes, kMostHeadBytes));
  size_t head_bytes = 0;
  if (!readChunkHead(window.at(record.content, shown), head, head_bytes)) return false;
  place = {record.content + head_bytes, head.bytes, head.crc};
  return head.compression.empty() && head.bytes <= record.bytes - head_bytes && head.bytes <= kMostChunkBytes &&
         head.bytes > 0;
}

const uint8_t *ChunkReader::load(const ChunkPlace &place) {
  if (loaded_ == place.start) return bytes_.data();
  loaded_ = 0;
  bytes_.resize(static_cast<size_t>(place.bytes));
  file_.read(place.start, bytes_.data(), bytes_.size());
  if (place.crc != 0 && crc32_z(0, bytes_.data(), bytes_.size()) != place.crc) return nullptr;
  loaded_ = place.start;
  return bytes_.data();
}

}  // namespace sphc::recording
