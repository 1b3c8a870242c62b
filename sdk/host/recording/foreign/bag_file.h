// The bytes of a bag's messages, whichever program wrote it: in chunks, compressed or not, or outside of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/recording/mcap/file.h"

namespace sphc::recording {

// Where a message's bytes are: in a chunk as it is without compression, or in the file where there is no chunk.
struct BagPlace {
  static constexpr uint32_t kNoChunk = UINT32_MAX;
  uint32_t chunk;
  uint64_t start, bytes;
};

enum class BagCompression { kNone, kZstd, kLz4 };

struct BagChunk {
  uint64_t start, bytes;  // as stored, in the file
  uint64_t records_bytes;
  uint32_t crc;  // of the records; 0: none
  BagCompression compression;
};
using BagChunks = std::vector<BagChunk>;

class BagFile {
 public:
  // `chunks`: those that a walk over the file has found, for load().  Throws Failure.
  explicit BagFile(const std::filesystem::path &path, std::shared_ptr<const BagChunks> chunks = nullptr)
      : file_(path), chunks_(std::move(chunks)) {}

  // The compression of that name.  Throws Failure with the file's name and `cure` where it is not read here.
  BagCompression compression(std::string_view name, const char *cure) const;
  // False when the chunk does not hold what it says.
  bool loadChunk(const BagChunk &chunk);
  // Of the last chunk loaded; valid until the next load.
  ByteView records() const { return viewOf(records_); }
  // Valid until the next load.  Throws Failure (DEVICE) without a name when the bytes have changed.
  ByteView load(const BagPlace &place);
  const File &file() const { return file_; }

 private:
  File file_;
  std::shared_ptr<const BagChunks> chunks_;
  Bytes stored_, records_;  // of the chunk in memory
  uint64_t loaded_ = 0;     // its start
};

}  // namespace sphc::recording
