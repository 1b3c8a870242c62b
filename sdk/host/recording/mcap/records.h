// The records of an MCAP file, version 0 (https://mcap.dev/spec): those that we write, and what we read of them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bytes.h"

namespace sphc::recording {

constexpr uint8_t kMcapMagic[8] = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class Op : uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F
};

constexpr size_t kRecordHeadBytes = 9;    // operation, length
constexpr size_t kMessageHeadBytes = 22;  // channel, sequence, log time, publish time
constexpr size_t kChunkHeadBytes = 40;    // up to the records, when they are not compressed

// Appends one record: its head, what `put_content` appends, and then the length into its head.
template <typename PutContent>
void putRecord(Bytes &out, Op op, PutContent &&put_content) {
  const size_t start = out.size();
  out.push_back(static_cast<uint8_t>(op));
  putLittle(out, uint64_t{0});
  put_content();
  storeLittle(out.data() + start + 1, uint64_t{out.size() - start - kRecordHeadBytes});
}

void putText(Bytes &out, std::string_view text);
// Gives a view into what is read.
std::string_view takeText(ByteReader &reader);

using TextMap = std::vector<std::pair<std::string, std::string>>;

void putHeader(Bytes &out, std::string_view profile, std::string_view library);
void putSchema(Bytes &out, uint16_t id, std::string_view name, std::string_view encoding, std::string_view text);
void putChannel(Bytes &out, uint16_t id, uint16_t schema, std::string_view topic, std::string_view encoding,
                const TextMap &metadata);
void putMessage(Bytes &out, uint16_t channel, uint32_t sequence, uint64_t time_ns, ByteView data);
void putAttachment(Bytes &out, std::string_view name, std::string_view media_type, ByteView data);
void putMetadata(Bytes &out, std::string_view name, const TextMap &metadata);
// crc: of all bytes of the file before this record; 0: none.
void putDataEnd(Bytes &out, uint32_t crc);

struct Schema {
  uint16_t id;
  std::string_view name;
};
struct Channel {
  uint16_t id, schema;
  std::string_view topic, encoding;
};
struct Attachment {
  std::string_view name, media_type;
  ByteView data;
};
struct MessageHead {
  uint16_t channel;
  uint32_t sequence;
  uint64_t time_ns;
};
struct ChunkHead {
  uint64_t first_ns, last_ns;
  uint64_t uncompressed_bytes;
  uint32_t crc;
  std::string_view compression;
  uint64_t bytes;  // of the records
};

// Each reads a record's content; false when it is malformed.  Attachments are checked by their checksum.
bool readSchema(ByteView content, Schema &schema);
bool readChannel(ByteView content, Channel &channel);
bool readAttachment(ByteView content, Attachment &attachment);
// The checksum of a Data End; 0: none.
uint32_t readDataEnd(ByteView content);
// The first kMessageHeadBytes of a message.
bool readMessageHead(ByteView content, MessageHead &head);
void putChunkHead(Bytes &out, const ChunkHead &head);
// The content up to the records; head_bytes says how long that was.
bool readChunkHead(ByteView content, ChunkHead &head, size_t &head_bytes);

}  // namespace sphc::recording
