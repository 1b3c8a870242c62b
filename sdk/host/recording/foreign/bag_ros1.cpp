// Bags of ROS 1, version 2.0 (http://wiki.ros.org/Bags/Format/2.0).  A record is a header of fields, "name=value",
// and data, each behind its length.
#include <map>

#include "host/recording/failure.h"
#include "host/recording/foreign/bag_walk.h"

namespace sphc::recording {

namespace {

enum class Ros1Op : uint8_t { kNone = 0, kMessage = 2, kBagHeader = 3, kChunk = 5, kConnection = 7 };

ByteView fieldOf(ByteView header, std::string_view name) {
  ByteReader reader(header);
  while (reader.left() > 0) {
    const ByteView field = reader.take(reader.little<uint32_t>());
    const size_t equals = textOf(field).find('=');
    if (!reader.ok() || equals == std::string_view::npos) break;
    if (textOf(field).substr(0, equals) == name) return {field.data + equals + 1, field.size - equals - 1};
  }
  return {};
}

// 0 where there is no such field.
template <typename Unsigned>
Unsigned numberOf(ByteView header, std::string_view name) {
  const ByteView field = fieldOf(header, name);
  return field.size == sizeof(Unsigned) ? loadLittle<Unsigned>(field.data) : Unsigned{0};
}

Ros1Op opOf(ByteView header) { return static_cast<Ros1Op>(numberOf<uint8_t>(header, "op")); }

class Ros1BagWalk {
 public:
  Ros1BagWalk(BagFile &bag, const BagVisitor &visit) : bag_(bag), visit_(visit), window_(bag.file()) {}

  BagWalk run() {
    uint64_t at = kRos1Magic.size();
    if (window_.fileSize() < at || textOf(window_.at(0, kRos1Magic.size())) != kRos1Magic)
      throw Failure(SPHC_E_DEVICE, bag_.file().name() + ": is no bag of ROS 1; copy it again");
    while (at < window_.fileSize()) at = readRecord(at);
    return std::move(walk_);
  }

 private:
  // A length, and whether so many bytes follow it.
  bool takeLength(uint64_t at, uint32_t *length) {
    const uint64_t left = window_.fileSize() - at;
    if (left < sizeof *length) return false;
    *length = loadLittle<uint32_t>(window_.at(at, sizeof *length).data);
    return *length <= left - sizeof *length;
  }

  // Where the next one begins.
  uint64_t readRecord(uint64_t at) {
    constexpr uint32_t kMostHeaderBytes = FileWindow::kMostBytes;  // topics are names
    uint32_t header_bytes = 0, data_bytes = 0;
    const bool has_header = takeLength(at, &header_bytes) && header_bytes > 0 && header_bytes <= kMostHeaderBytes;
    const uint64_t data_at = at + sizeof header_bytes + header_bytes;
    if (!has_header || !takeLength(data_at, &data_bytes)) {
      walk_.is_cut = true;
      return window_.fileSize();
    }
    const ByteView shown = window_.at(at + sizeof header_bytes, header_bytes);
    const Bytes header(shown.data, shown.data + shown.size);
    const uint64_t content = data_at + sizeof data_bytes;
    if (opOf(viewOf(header)) == Ros1Op::kChunk)
      readChunkOf(viewOf(header), content, data_bytes);
    else
      readOther(viewOf(header), content, data_bytes);
    return content + data_bytes;
  }

  void readOther(ByteView header, uint64_t content, uint32_t bytes) {
    const Ros1Op op = opOf(header);
    // The recorder writes where the index is when it closes the file.
    if (op == Ros1Op::kBagHeader && numberOf<uint64_t>(header, "index_pos") == 0) walk_.is_cut = true;
    if ((op != Ros1Op::kMessage && op != Ros1Op::kConnection) || bytes > kMostMessageBytes) return;
    Bytes data(bytes);
    bag_.file().read(content, data.data(), data.size());
    showRecord(header, viewOf(data), {BagPlace::kNoChunk, content, bytes});
  }

  void readChunkOf(ByteView header, uint64_t content, uint32_t bytes) {
    const BagCompression compression =
        bag_.compression(textOf(fieldOf(header, "compression")), "write it again by \"rosbag decompress\"");
    const BagChunk chunk = {content, bytes, numberOf<uint32_t>(header, "size"), 0, compression};
    if (!bag_.loadChunk(chunk)) {
      ++walk_.bad_chunk_count;
      return;
    }
    walk_.chunks.push_back(chunk);
    ByteReader reader(bag_.records());
    while (reader.left() > 0) {
      const ByteView record = reader.take(reader.little<uint32_t>());
      const ByteView data = reader.take(reader.little<uint32_t>());
      if (!reader.ok()) break;
      const uint32_t index = static_cast<uint32_t>(walk_.chunks.size() - 1);
      showRecord(record, data, {index, reader.position() - data.size, data.size});
    }
  }

  void showRecord(ByteView header, ByteView data, const BagPlace &place) {
    const uint32_t number = numberOf<uint32_t>(header, "conn");
    if (opOf(header) == Ros1Op::kConnection)
      channels_[number] = {std::string(textOf(fieldOf(header, "topic"))),
                           std::string(textOf(fieldOf(data, "type"))), RosEncoding::kRos1};
    const auto channel = channels_.find(number);
    if (opOf(header) != Ros1Op::kMessage || channel == channels_.end()) return;
    const uint64_t time = numberOf<uint64_t>(header, "time");  // nanoseconds above seconds
    visit_({channel->second, (time & UINT32_MAX) * 1000000000 + (time >> 32), place, data});
  }

  BagFile &bag_;
  const BagVisitor &visit_;
  FileWindow window_;
  std::map<uint32_t, BagChannel> channels_;
  BagWalk walk_;
};

}  // namespace

BagWalk walkRos1Bag(BagFile &bag, const BagVisitor &visit) { return Ros1BagWalk(bag, visit).run(); }

}  // namespace sphc::recording
