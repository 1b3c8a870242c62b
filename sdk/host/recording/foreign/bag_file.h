// The messages of an MCAP file that any program wrote: in chunks, compressed or not, or outside of them.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "host/recording/mcap/walk.h"

namespace sphc::recording {

struct BagChannel {
  std::string topic, type;  // type: the schema's name, "sensor_msgs/msg/Image"
  bool is_cdr;
};

// Where a message's bytes are: in a chunk as it is without compression, or in the file where there is no chunk.
struct BagPlace {
  static constexpr uint32_t kNoChunk = UINT32_MAX;
  uint32_t chunk;
  uint64_t start, bytes;
};

struct BagMessage {
  uint16_t channel_id;
  const BagChannel &channel;
  uint64_t log_ns;
  BagPlace place;
  ByteView data;  // valid during the visit
};

enum class BagCompression { kNone, kZstd };

struct BagChunk {
  uint64_t start, bytes;  // as stored, in the file
  uint64_t records_bytes;
  uint32_t crc;  // of the records; 0: none
  BagCompression compression;
};

class BagFile {
 public:
  using Visitor = std::function<void(const BagMessage &)>;

  // Throws Failure when it is no MCAP file.
  explicit BagFile(const std::filesystem::path &path);
  // Another reader of the same file, by the chunks of one that has walked over it.
  BagFile(const std::filesystem::path &path, std::shared_ptr<const std::vector<BagChunk>> chunks);

  // Every whole message, in the order of the file.  Throws Failure for a compression that is not read here.
  void forEachMessage(const Visitor &visit);
  // Of that walk.
  bool isCut() const { return is_cut_; }
  uint32_t badChunkCount() const { return bad_chunk_count_; }
  std::shared_ptr<const std::vector<BagChunk>> chunks() const { return chunks_; }

  // Valid until the next call.  Throws Failure (DEVICE) without a name when the bytes have changed.
  ByteView load(const BagPlace &place);
  const std::string &name() const { return file_.name(); }

 private:
  void readRecord(const RecordPlace &record, const Visitor &visit);
  void readChunkOf(const RecordPlace &record, const Visitor &visit);
  void readChannelRecord(Op op, ByteView content);
  void showMessage(ByteView content, uint32_t chunk, uint64_t start, const Visitor &visit) const;
  bool loadChunk(const BagChunk &chunk);

  File file_;
  FileWindow window_;
  std::shared_ptr<const std::vector<BagChunk>> chunks_;
  std::vector<BagChunk> found_;  // while walking
  std::map<uint16_t, std::string> schemas_;
  std::map<uint16_t, BagChannel> channels_;
  Bytes stored_, records_;  // of the chunk in memory
  uint64_t loaded_ = 0;     // its start
  bool is_cut_ = false;
  uint32_t bad_chunk_count_ = 0;
};

}  // namespace sphc::recording
