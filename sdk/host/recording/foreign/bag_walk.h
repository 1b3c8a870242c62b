// The messages of a bag, in the order of the file.
#pragma once

#include <functional>

#include "host/recording/foreign/bag_file.h"
#include "host/recording/foreign/ros_reader.h"

namespace sphc::recording {

struct BagChannel {
  std::string topic, type;  // type: "sensor_msgs/Image"
  RosEncoding encoding;
};

struct BagMessage {
  const BagChannel &channel;
  uint64_t log_ns;
  BagPlace place;
  ByteView data;  // valid during the visit
};
using BagVisitor = std::function<void(const BagMessage &)>;

struct BagWalk {
  BagChunks chunks;
  bool is_cut = false;
  uint32_t bad_chunk_count = 0;
};

constexpr std::string_view kRos1Magic = "#ROSBAG V2.0\n";

// Every whole message.  Throw Failure for a compression that is not read here, and for a file of another kind.
BagWalk walkMcapBag(BagFile &bag, const BagVisitor &visit);
BagWalk walkRos1Bag(BagFile &bag, const BagVisitor &visit);

constexpr uint64_t kMostMessageBytes = uint64_t{1} << 28;  // outside of chunks

}  // namespace sphc::recording
