#include "records.h"

#include <zlib.h>

namespace sphc::recording {

namespace {

uint32_t crcOf(const uint8_t *data, size_t size) { return static_cast<uint32_t>(crc32_z(0, data, size)); }

void putMap(Bytes &out, const TextMap &map) {
  size_t bytes = 0;
  for (const auto &[key, value] : map) bytes += 8 + key.size() + value.size();
  putLittle(out, static_cast<uint32_t>(bytes));
  for (const auto &[key, value] : map) {
    putText(out, key);
    putText(out, value);
  }
}

}  // namespace

void putText(Bytes &out, std::string_view text) {
  putLittle(out, static_cast<uint32_t>(text.size()));
  append(out, text.data(), text.size());
}

std::string_view takeText(ByteReader &reader) {
  const uint32_t size = reader.little<uint32_t>();
  return textOf(reader.take(size));
}

void putHeader(Bytes &out, std::string_view profile, std::string_view library) {
  putRecord(out, Op::kHeader, [&] {
    putText(out, profile);
    putText(out, library);
  });
}

void putSchema(Bytes &out, uint16_t id, std::string_view name, std::string_view encoding, std::string_view text) {
  putRecord(out, Op::kSchema, [&] {
    putLittle(out, id);
    putText(out, name);
    putText(out, encoding);
    putText(out, text);
  });
}

void putChannel(Bytes &out, uint16_t id, uint16_t schema, std::string_view topic, std::string_view encoding,
                const TextMap &metadata) {
  putRecord(out, Op::kChannel, [&] {
    putLittle(out, id);
    putLittle(out, schema);
    putText(out, topic);
    putText(out, encoding);
    putMap(out, metadata);
  });
}

void putMessage(Bytes &out, uint16_t channel, uint32_t sequence, uint64_t time_ns, ByteView data) {
  putRecord(out, Op::kMessage, [&] {
    putLittle(out, channel);
    putLittle(out, sequence);
    putLittle(out, time_ns);
    putLittle(out, time_ns);
    append(out, data.data, data.size);
  });
}

void putAttachment(Bytes &out, std::string_view name, std::string_view media_type, ByteView data) {
  putRecord(out, Op::kAttachment, [&] {
    const size_t start = out.size();
    putLittle(out, uint64_t{0});
    putLittle(out, uint64_t{0});
    putText(out, name);
    putText(out, media_type);
    putLittle(out, uint64_t{data.size});
    append(out, data.data, data.size);
    putLittle(out, crcOf(out.data() + start, out.size() - start));
  });
}

void putMetadata(Bytes &out, std::string_view name, const TextMap &metadata) {
  putRecord(out, Op::kMetadata, [&] {
    putText(out, name);
    putMap(out, metadata);
  });
}

void putDataEnd(Bytes &out, uint32_t crc) {
  putRecord(out, Op::kDataEnd, [&] { putLittle(out, crc); });
}

bool readSchema(ByteView content, Schema &schema) {
  ByteReader reader(content);
  schema.id = reader.little<uint16_t>();
  schema.name = takeText(reader);
  return reader.ok();
}

bool readChannel(ByteView content, Channel &channel) {
  ByteReader reader(content);
  channel.id = reader.little<uint16_t>();
  channel.schema = reader.little<uint16_t>();
  channel.topic = takeText(reader);
  channel.encoding = takeText(reader);
  return reader.ok();
}

bool readAttachment(ByteView content, Attachment &attachment) {
  ByteReader reader(content);
  reader.take(16);  // times
  attachment.name = takeText(reader);
  attachment.media_type = takeText(reader);
  attachment.data = reader.take(reader.little<uint64_t>());
  const size_t checked = reader.position();
  const uint32_t crc = reader.little<uint32_t>();
  return reader.ok() && (crc == 0 || crc == crcOf(content.data, checked));
}

uint32_t readDataEnd(ByteView content) { return ByteReader(content).little<uint32_t>(); }

bool readMessageHead(ByteView content, MessageHead &head) {
  ByteReader reader(content);
  head.channel = reader.little<uint16_t>();
  head.sequence = reader.little<uint32_t>();
  head.time_ns = reader.little<uint64_t>();
  reader.little<uint64_t>();  // publish time: the same
  return reader.ok();
}

void putChunkHead(Bytes &out, const ChunkHead &head) {
  putLittle(out, head.first_ns);
  putLittle(out, head.last_ns);
  putLittle(out, head.uncompressed_bytes);
  putLittle(out, head.crc);
  putText(out, head.compression);
  putLittle(out, head.bytes);
}

bool readChunkHead(ByteView content, ChunkHead &head, size_t &head_bytes) {
  ByteReader reader(content);
  head.first_ns = reader.little<uint64_t>();
  head.last_ns = reader.little<uint64_t>();
  head.uncompressed_bytes = reader.little<uint64_t>();
  head.crc = reader.little<uint32_t>();
  head.compression = takeText(reader);
  head.bytes = reader.little<uint64_t>();
  head_bytes = reader.position();
  return reader.ok();
}

}  // namespace sphc::recording
