// Writes an MCAP file: messages gathered into chunks, each written at once and whole.
#pragma once

#include "file.h"
#include "messages.h"
#include "records.h"

namespace sphc::recording {

class McapWriter {
 public:
  // Makes the file and all memory: for chunks of about `chunk_bytes` and messages of at most `most_message_bytes`.
  McapWriter(const std::filesystem::path &path, size_t chunk_bytes, size_t most_message_bytes);
  // Removes a file that was not begun.
  ~McapWriter();
  McapWriter(const McapWriter &) = delete;
  McapWriter &operator=(const McapWriter &) = delete;

  // Magic and header, then `records`; on the disk when it returns.
  void begin(const Bytes &records);
  // What the caller appends to the bytes it gets is the message; end it with endMessage, which writes a full chunk.
  Bytes &beginMessage(Kind kind, uint32_t sequence, int64_t time_ns);
  void endMessage();

  bool chunkIsEmpty() const { return entries_.empty(); }
  // Writes what is gathered.
  void endChunk();
  void sync() { file_.sync(); }
  // The last chunk, `records`, and the summary; on the disk when it returns.
  void finish(const Bytes &records);

  uint64_t bytesWritten() const { return file_.size(); }

 private:
  struct Entry {
    uint16_t channel;
    uint64_t time_ns, offset;
  };
  explicit McapWriter(const std::filesystem::path &path);  // makes the file alone
  void putMessageIndexes();
  void append(std::initializer_list<ByteView> parts);

  std::filesystem::path path_;
  File file_;
  bool is_begun_ = false;
  uint32_t crc_ = 0;  // of all that is in the file
  size_t chunk_bytes_ = 0;
  Bytes chunk_, head_, index_;
  std::vector<Entry> entries_;  // of the messages in the chunk
};

}  // namespace sphc::recording
