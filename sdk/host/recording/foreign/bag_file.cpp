#include "host/recording/foreign/bag_file.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>

#include "host/recording/failure.h"
#include "host/recording/foreign/lz4_frame.h"

namespace sphc::recording {

namespace {

constexpr uint64_t kMostRecordsBytes = uint64_t{1} << 28;

bool decompress(ByteView stored, BagCompression compression, Bytes &records) {
  switch (compression) {
    case BagCompression::kZstd:
      return ZSTD_decompress(records.data(), records.size(), stored.data, stored.size) == records.size();
    case BagCompression::kLz4:
      return decodeLz4Frame(stored, records);
    case BagCompression::kNone:
      break;
  }
  if (stored.size != records.size()) return false;
  std::copy(stored.data, stored.data + stored.size, records.begin());
  return true;
}

}  // namespace

BagCompression BagFile::compression(std::string_view name, const char *cure) const {
  if (name.empty() || name == "none") return BagCompression::kNone;
  if (name == "zstd") return BagCompression::kZstd;
  if (name == "lz4" && readsLz4()) return BagCompression::kLz4;
  throw Failure(SPHC_E_UNSUPPORTED, file_.name() + ": its chunks are compressed by " +
                                        std::string(name.substr(0, 16)) + ", which this build does not read" +
                                        (name == "lz4" ? "; install liblz4-dev and build again, or " : "; ") +
                                        cure);
}

bool BagFile::loadChunk(const BagChunk &chunk) {
  if (loaded_ == chunk.start) return true;
  if (chunk.bytes > kMostRecordsBytes || chunk.records_bytes > kMostRecordsBytes) return false;
  loaded_ = 0;
  stored_.resize(static_cast<size_t>(chunk.bytes));
  records_.resize(static_cast<size_t>(chunk.records_bytes));
  file_.read(chunk.start, stored_.data(), stored_.size());
  if (!decompress(viewOf(stored_), chunk.compression, records_)) return false;
  if (chunk.crc != 0 && crc32_z(0, records_.data(), records_.size()) != chunk.crc) return false;
  loaded_ = chunk.start;
  return true;
}

ByteView BagFile::load(const BagPlace &place) {
  if (place.chunk == BagPlace::kNoChunk) {
    loaded_ = 0;
    records_.resize(static_cast<size_t>(place.bytes));
    file_.read(place.start, records_.data(), records_.size());
    return viewOf(records_);
  }
  if (!loadChunk(chunks_->at(place.chunk)))
    throw Failure(SPHC_E_DEVICE, "its chunk does not have the bytes that were written; copy the file again");
  return {records_.data() + place.start, static_cast<size_t>(place.bytes)};
}

}  // namespace sphc::recording
