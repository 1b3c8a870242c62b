// Bags of ROS 2 in MCAP, by any writer.
#include <algorithm>
#include <map>

#include "host/recording/failure.h"
#include "host/recording/foreign/bag_walk.h"
#include "host/recording/mcap/walk.h"

namespace sphc::recording {

namespace {

constexpr size_t kMostBagHeadBytes = 128;  // of a chunk; the compression's name is a word

// ROS 2 names a type "sensor_msgs/msg/Image", and ROS 1 the same one "sensor_msgs/Image".
std::string ros1TypeOf(std::string type) {
  const size_t found = type.find("/msg/");
  return found == std::string::npos ? type : type.erase(found, 4);
}

RosEncoding encodingOf(std::string_view name) {
  return name == "cdr" ? RosEncoding::kCdr : name == "ros1" ? RosEncoding::kRos1 : RosEncoding::kOther;
}

class McapBagWalk {
 public:
  McapBagWalk(BagFile &bag, const BagVisitor &visit) : bag_(bag), visit_(visit), window_(bag.file()) {}

  BagWalk run() {
    if (!hasMagic(window_, 0))
      throw Failure(SPHC_E_DEVICE, bag_.file().name() + ": is no MCAP file; copy it again");
    const WalkEnd end = walkRecords(window_, sizeof kMcapMagic, window_.fileSize(),
                                    [&](const RecordPlace &record) { readRecord(record); });
    walk_.is_cut = end != WalkEnd::kDataEnd;
    return std::move(walk_);
  }

 private:
  void readRecord(const RecordPlace &record) {
    if (record.op == Op::kChunk) return readChunkOf(record);
    const bool is_message = record.op == Op::kMessage;
    if ((!is_message && record.op != Op::kSchema && record.op != Op::kChannel) || record.bytes > kMostMessageBytes)
      return;
    Bytes content(static_cast<size_t>(record.bytes));
    bag_.file().read(record.content, content.data(), content.size());
    if (is_message)
      showMessage(viewOf(content), BagPlace::kNoChunk, record.content);
    else
      readChannelRecord(record.op, viewOf(content));
  }

  void readChannelRecord(Op op, ByteView content) {
    Schema schema;
    Channel channel;
    if (op == Op::kSchema && readSchema(content, schema)) types_[schema.id] = ros1TypeOf(std::string(schema.name));
    if (op == Op::kChannel && readChannel(content, channel))
      channels_[channel.id] = {std::string(channel.topic), types_[channel.schema], encodingOf(channel.encoding)};
  }

  void showMessage(ByteView content, uint32_t chunk, uint64_t start) const {
    MessageHead head;
    if (!readMessageHead(content, head)) return;
    const auto channel = channels_.find(head.channel);
    if (channel == channels_.end()) return;
    const ByteView data{content.data + kMessageHeadBytes, content.size - kMessageHeadBytes};
    visit_({channel->second, head.time_ns, {chunk, start + kMessageHeadBytes, data.size}, data});
  }

  void readChunkOf(const RecordPlace &record) {
    const size_t shown = static_cast<size_t>(std::min<uint64_t>(record.bytes, kMostBagHeadBytes));
    ChunkHead head;
    size_t head_bytes = 0;
    if (!readChunkHead(window_.at(record.content, shown), head, head_bytes) ||
        head.bytes > record.bytes - head_bytes) {
      ++walk_.bad_chunk_count;
      return;
    }
    const BagCompression compression =
        bag_.compression(head.compression, "write it again by \"mcap compress --compression zstd\"");
    const BagChunk chunk = {record.content + head_bytes, head.bytes, head.uncompressed_bytes, head.crc,
                            compression};
    if (!bag_.loadChunk(chunk)) {
      ++walk_.bad_chunk_count;
      return;
    }
    walk_.chunks.push_back(chunk);
    readChunkRecords(static_cast<uint32_t>(walk_.chunks.size() - 1));
  }

  void readChunkRecords(uint32_t chunk) {
    ByteReader reader(bag_.records());
    while (reader.left() > 0) {
      const Op op = static_cast<Op>(reader.little<uint8_t>());
      const ByteView content = reader.take(reader.little<uint64_t>());
      if (!reader.ok()) break;
      if (op == Op::kMessage)
        showMessage(content, chunk, reader.position() - content.size);
      else
        readChannelRecord(op, content);
    }
  }

  BagFile &bag_;
  const BagVisitor &visit_;
  FileWindow window_;
  std::map<uint16_t, std::string> types_;
  std::map<uint16_t, BagChannel> channels_;
  BagWalk walk_;
};

}  // namespace

BagWalk walkMcapBag(BagFile &bag, const BagVisitor &visit) { return McapBagWalk(bag, visit).run(); }

}  // namespace sphc::recording
