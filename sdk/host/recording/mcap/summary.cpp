#include "summary.h"

#include <zlib.h>

#include <algorithm>
#include <map>

#include "walk.h"

namespace sphc::recording {

namespace {

class SummaryWriter {
 public:
  explicit SummaryWriter(File &file) : file_(file), window_(file), start_(file.size()) {}

  void write();

 private:
  void add(const RecordPlace &record);
  void addChunk(const RecordPlace &record);
  void addMessageIndex(const RecordPlace &record);
  void endChunkIndex();
  void copy(const RecordPlace &record, Bytes &group);
  void putAttachmentIndex(const RecordPlace &record);
  void putMetadataIndex(const RecordPlace &record);
  void putStatistics(Bytes &out) const;
  void putGroup(Op op, const Bytes &group);
  void endGroup(Op op, uint64_t start);
  void flush();

  File &file_;
  FileWindow window_;  // of the file as it was before the summary
  uint64_t start_;
  uint32_t crc_ = 0;
  Bytes pending_;  // to be written; small, however many chunks there are
  Bytes schemas_, channels_, attachments_, metadata_, offsets_;
  // The chunk whose message indexes are being read.
  RecordPlace chunk_ = {};
  ChunkHead head_ = {};
  uint64_t chunk_bytes_ = 0, index_end_ = 0;
  std::map<uint16_t, uint64_t> index_offsets_;
  // Statistics.
  std::map<uint16_t, uint64_t> counts_;
  uint16_t schema_count_ = 0;
  uint32_t channel_count_ = 0, attachment_count_ = 0, metadata_count_ = 0, chunk_count_ = 0;
  uint64_t first_ns_ = UINT64_MAX, last_ns_ = 0;
};

constexpr size_t kFlushBytes = 64 * 1024;

void SummaryWriter::flush() {
  crc_ = static_cast<uint32_t>(crc32_z(crc_, pending_.data(), pending_.size()));
  file_.append({viewOf(pending_)});
  pending_.clear();
}

void SummaryWriter::copy(const RecordPlace &record, Bytes &group) {
  const size_t before = group.size();
  group.resize(before + static_cast<size_t>(record.end() - record.start));
  file_.read(record.start, group.data() + before, group.size() - before);
}

void SummaryWriter::addChunk(const RecordPlace &record) {
  endChunkIndex();
  ChunkPlace place;
  if (!readChunk(window_, record, head_, place)) return;
  head_.compression = {};  // a view that ends with the window
  chunk_ = record;
  chunk_bytes_ = place.bytes;
  index_end_ = record.end();
  ++chunk_count_;
  first_ns_ = std::min(first_ns_, head_.first_ns);
  last_ns_ = std::max(last_ns_, head_.last_ns);
}

void SummaryWriter::addMessageIndex(const RecordPlace &record) {
  if (record.bytes < 6) return;
  const ByteView content = window_.at(record.content, 6);
  const uint16_t channel = loadLittle<uint16_t>(content.data);
  counts_[channel] += loadLittle<uint32_t>(content.data + 2) / 16;
  index_offsets_[channel] = record.start;
  index_end_ = record.end();
}

void SummaryWriter::endChunkIndex() {
  if (chunk_.bytes == 0) return;
  putRecord(pending_, Op::kChunkIndex, [&] {
    putLittle(pending_, head_.first_ns);
    putLittle(pending_, head_.last_ns);
    putLittle(pending_, chunk_.start);
    putLittle(pending_, chunk_.end() - chunk_.start);
    putLittle(pending_, static_cast<uint32_t>(10 * index_offsets_.size()));
    for (const auto &[channel, offset] : index_offsets_) {
      putLittle(pending_, channel);
      putLittle(pending_, offset);
    }
    putLittle(pending_, index_end_ - chunk_.end());
    putText(pending_, "");
    putLittle(pending_, chunk_bytes_);
    putLittle(pending_, head_.uncompressed_bytes);
  });
  if (pending_.size() > kFlushBytes) flush();
  index_offsets_.clear();
  chunk_ = {};
}

void SummaryWriter::putAttachmentIndex(const RecordPlace &record) {
  Bytes content;
  copy(record, content);
  Attachment attachment;
  if (!readAttachment({content.data() + kRecordHeadBytes, content.size() - kRecordHeadBytes}, attachment)) return;
  ++attachment_count_;
  putRecord(attachments_, Op::kAttachmentIndex, [&] {
    putLittle(attachments_, record.start);
    putLittle(attachments_, record.end() - record.start);
    putLittle(attachments_, uint64_t{0});
    putLittle(attachments_, uint64_t{0});
    putLittle(attachments_, uint64_t{attachment.data.size});
    putText(attachments_, attachment.name);
    putText(attachments_, attachment.media_type);
  });
}

void SummaryWriter::putMetadataIndex(const RecordPlace &record) {
  Bytes content;
  copy(record, content);
  ByteReader reader({content.data() + kRecordHeadBytes, content.size() - kRecordHeadBytes});
  ++metadata_count_;
  putRecord(metadata_, Op::kMetadataIndex, [&] {
    putLittle(metadata_, record.start);
    putLittle(metadata_, record.end() - record.start);
    putText(metadata_, takeText(reader));
  });
}

void SummaryWriter::add(const RecordPlace &record) {
  switch (record.op) {
    case Op::kSchema:
      ++schema_count_;
      return copy(record, schemas_);
    case Op::kChannel:
      ++channel_count_;
      return copy(record, channels_);
    case Op::kAttachment:
      return putAttachmentIndex(record);
    case Op::kMetadata:
      return putMetadataIndex(record);
    case Op::kChunk:
      return addChunk(record);
    case Op::kMessageIndex:
      return addMessageIndex(record);
    default:
      return;
  }
}

void SummaryWriter::putStatistics(Bytes &out) const {
  uint64_t messages = 0;
  for (const auto &[channel, count] : counts_) messages += count;
  putRecord(out, Op::kStatistics, [&] {
    putLittle(out, messages);
    putLittle(out, schema_count_);
    putLittle(out, channel_count_);
    putLittle(out, attachment_count_);
    putLittle(out, metadata_count_);
    putLittle(out, chunk_count_);
    putLittle(out, messages ? first_ns_ : 0);
    putLittle(out, last_ns_);
    putLittle(out, static_cast<uint32_t>(10 * counts_.size()));
    for (const auto &[channel, count] : counts_) {
      putLittle(out, channel);
      putLittle(out, count);
    }
  });
}

void SummaryWriter::putGroup(Op op, const Bytes &group) {
  const uint64_t start = file_.size();
  append(pending_, group.data(), group.size());
  endGroup(op, start);
}

void SummaryWriter::endGroup(Op op, uint64_t start) {
  flush();
  if (file_.size() == start) return;
  putRecord(offsets_, Op::kSummaryOffset, [&] {
    offsets_.push_back(static_cast<uint8_t>(op));
    putLittle(offsets_, start);
    putLittle(offsets_, file_.size() - start);
  });
}

void SummaryWriter::write() {
  walkRecords(window_, sizeof kMcapMagic, start_, [this](const RecordPlace &record) { add(record); });
  endChunkIndex();
  endGroup(Op::kChunkIndex, start_);
  Bytes statistics;
  putStatistics(statistics);
  putGroup(Op::kSchema, schemas_);
  putGroup(Op::kChannel, channels_);
  putGroup(Op::kAttachmentIndex, attachments_);
  putGroup(Op::kMetadataIndex, metadata_);
  putGroup(Op::kStatistics, statistics);
  const uint64_t offsets_start = file_.size();
  Bytes end = offsets_;
  end.push_back(static_cast<uint8_t>(Op::kFooter));
  putLittle(end, uint64_t{20});
  putLittle(end, start_);
  putLittle(end, offsets_start);
  crc_ = static_cast<uint32_t>(crc32_z(crc_, end.data(), end.size()));
  putLittle(end, crc_);
  append(end, kMcapMagic, sizeof kMcapMagic);
  file_.append({viewOf(end)});
}

}  // namespace

void writeSummary(File &file) { SummaryWriter(file).write(); }

}  // namespace sphc::recording
