#include "host/recording/foreign/bag_file.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>

#include "host/recording/failure.h"

namespace sphc::recording {

namespace {

constexpr uint64_t kMostMessageBytes = uint64_t{1} << 28;
constexpr uint64_t kMostRecordsBytes = uint64_t{1} << 28;
constexpr size_t kMostBagHeadBytes = 128;  // of a chunk; the compression's name is a word

bool decompress(ByteView stored, BagCompression compression, Bytes &records) {
  if (compression == BagCompression::kNone) {
    if (stored.size != records.size()) return false;
    std::copy(stored.data, stored.data + stored.size, records.begin());
    return true;
  }
  return ZSTD_decompress(records.data(), records.size(), stored.data, stored.size) == records.size();
}

}  // namespace

BagFile::BagFile(const std::filesystem::path &path) : file_(path), window_(file_) {
  if (!hasMagic(window_, 0)) throw Failure(SPHC_E_DEVICE, file_.name() + ": is no MCAP file; copy it again");
}

BagFile::BagFile(const std::filesystem::path &path, std::shared_ptr<const std::vector<BagChunk>> chunks)
    : file_(path), window_(file_), chunks_(std::move(chunks)) {}

void BagFile::forEachMessage(const Visitor &visit) {
  const WalkEnd end = walkRecords(window_, sizeof kMcapMagic, window_.fileSize(),
                                  [&](const RecordPlace &record) { readRecord(record, visit); });
  is_cut_ = end != WalkEnd::kDataEnd;
  chunks_ = std::make_shared<const std::vector<BagChunk>>(std::move(found_));
}

void BagFile::readRecord(const RecordPlace &record, const Visitor &visit) {
  if (record.op == Op::kChunk) return readChunkOf(record, visit);
  const bool is_message = record.op == Op::kMessage;
  if ((!is_message && record.op != Op::kSchema && record.op != Op::kChannel) || record.bytes > kMostMessageBytes)
    return;
  Bytes content(static_cast<size_t>(record.bytes));
  file_.read(record.content, content.data(), content.size());
  if (is_message)
    showMessage(viewOf(content), BagPlace::kNoChunk, record.content, visit);
  else
    readChannelRecord(record.op, viewOf(content));
}

void BagFile::readChannelRecord(Op op, ByteView content) {
  Schema schema;
  Channel channel;
  if (op == Op::kSchema && readSchema(content, schema)) schemas_[schema.id] = schema.name;
  if (op == Op::kChannel && readChannel(content, channel))
    channels_[channel.id] = {std::string(channel.topic), schemas_[channel.schema], channel.encoding == "cdr"};
}

void BagFile::showMessage(ByteView content, uint32_t chunk, uint64_t start, const Visitor &visit) const {
  MessageHead head;
  if (!readMessageHead(content, head)) return;
  const auto channel = channels_.find(head.channel);
  if (channel == channels_.end()) return;
  const ByteView data{content.data + kMessageHeadBytes, content.size - kMessageHeadBytes};
  visit({head.channel, channel->second, head.time_ns, {chunk, start + kMessageHeadBytes, data.size}, data});
}

void BagFile::readChunkOf(const RecordPlace &record, const Visitor &visit) {
  const size_t shown = static_cast<size_t>(std::min<uint64_t>(record.bytes, kMostBagHeadBytes));
  ChunkHead head;
  size_t head_bytes = 0;
  if (!readChunkHead(window_.at(record.content, shown), head, head_bytes) ||
      head.bytes > record.bytes - head_bytes || head.bytes > kMostRecordsBytes ||
      head.uncompressed_bytes > kMostRecordsBytes) {
    ++bad_chunk_count_;
    return;
  }
  if (!head.compression.empty() && head.compression != "zstd")
    throw Failure(SPHC_E_UNSUPPORTED, file_.name() + ": its chunks are compressed by " +
                                          std::string(head.compression.substr(0, 16)) +
                                          "; write it again by \"mcap compress --compression zstd\"");
  const BagChunk chunk = {record.content + head_bytes, head.bytes, head.uncompressed_bytes, head.crc,
                          head.compression.empty() ? BagCompression::kNone : BagCompression::kZstd};
  if (!loadChunk(chunk)) {
    ++bad_chunk_count_;
    return;
  }
  found_.push_back(chunk);
  ByteReader reader(viewOf(records_));
  while (reader.left() > 0) {
    const Op op = static_cast<Op>(reader.little<uint8_t>());
    const ByteView content = reader.take(reader.little<uint64_t>());
    if (!reader.ok()) break;
    if (op == Op::kMessage)
      showMessage(content, static_cast<uint32_t>(found_.size() - 1), reader.position() - content.size, visit);
    else
      readChannelRecord(op, content);
  }
}

bool BagFile::loadChunk(const BagChunk &chunk) {
  if (loaded_ == chunk.start) return true;
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
