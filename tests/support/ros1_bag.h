// A small bag of ROS 1, version 2.0, written message by message.
#pragma once

#ifdef SPHC_TEST_LZ4
#include <lz4frame.h>
#endif

#include "tests/support/ros_bag.h"

namespace sphc::test {

class Ros1Bag {
 public:
  enum class Chunks { kNone, kStored, kLz4, kBz2 };

  void add(const std::string &topic, const std::string &type, uint64_t log_ns, const Bytes &message) {
    uint32_t id = 0;
    while (id < topics_.size() && topics_[id] != topic) ++id;
    if (id == topics_.size()) {
      topics_.push_back(topic);
      // As RealSense's: the topic in the record alone, not in its data.
      putRecord(records_, field("op", "\x07") + field("conn", littleText(id)) + field("topic", topic),
                field("type", type) + field("md5sum", "*"));
    }
    const uint64_t time = (log_ns % 1000000000) << 32 | log_ns / 1000000000;
    putRecord(records_, field("op", "\x02") + field("conn", littleText(id)) + field("time", littleText(time)),
              {message.begin(), message.end()});
  }

  // One that was not closed does not say where its index is.
  std::string bytes(Chunks chunks, bool is_closed = true) const {
    std::string file = "#ROSBAG V2.0\n";
    putRecord(file,
              field("op", "\x03") + field("index_pos", littleText(uint64_t{is_closed})) +
                  field("conn_count", littleText(uint32_t{1})) + field("chunk_count", littleText(uint32_t{1})),
              std::string(200, ' '));
    if (chunks == Chunks::kNone) return file + records_;
    const char *name = chunks == Chunks::kLz4 ? "lz4" : chunks == Chunks::kBz2 ? "bz2" : "none";
    putRecord(file,
              field("op", "\x05") + field("compression", name) +
                  field("size", littleText(static_cast<uint32_t>(records_.size()))),
              chunks == Chunks::kLz4 ? lz4Frame(records_) : records_);
    // The index of a connection, which nobody needs who reads from the front.
    putRecord(file, field("op", "\x04") + field("ver", littleText(uint32_t{1})), std::string(12, '\1'));
    return file;
  }

 private:
  template <typename Unsigned>
  static std::string littleText(Unsigned value) {
    Bytes bytes;
    recording::putLittle(bytes, value);
    return {bytes.begin(), bytes.end()};
  }
  static std::string field(const std::string &name, const std::string &value) {
    return littleText(static_cast<uint32_t>(name.size() + 1 + value.size())) + name + "=" + value;
  }
  static void putRecord(std::string &out, const std::string &header, const std::string &data) {
    out += littleText(static_cast<uint32_t>(header.size())) + header;
    out += littleText(static_cast<uint32_t>(data.size())) + data;
  }
  static std::string lz4Frame(const std::string &records) {
#ifdef SPHC_TEST_LZ4
    std::string frame(LZ4F_compressFrameBound(records.size(), nullptr), '\0');
    frame.resize(LZ4F_compressFrame(frame.data(), frame.size(), records.data(), records.size(), nullptr));
    return frame;
#else
    return records;
#endif
  }

  std::vector<std::string> topics_;
  std::string records_;
};

}  // namespace sphc::test
