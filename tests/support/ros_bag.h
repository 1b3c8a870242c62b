// A small recording of ROS 2 in MCAP, written message by message; the messages are those of ROS 1 too.
#pragma once

#include <spherecloud/spherecloud.h>
#include <zstd.h>

#include <string>
#include <vector>

#include "host/recording/mcap/cdr.h"
#include "host/recording/mcap/records.h"

namespace sphc::test {

using recording::Bytes;
using recording::CdrWriter;

// The records of a file between its magics; `bytes()` puts them in one chunk, or in none.
class RosBag {
 public:
  enum class Chunks { kNone, kStored, kZstd, kBrotli };

  void add(const std::string &topic, const std::string &type, uint64_t log_ns, const Bytes &message,
           const std::string &encoding = "cdr") {
    uint16_t id = 0;
    while (id < topics_.size() && topics_[id] != topic) ++id;
    if (id == topics_.size()) {
      topics_.push_back(topic);
      recording::putSchema(records_, static_cast<uint16_t>(id + 1), type, "ros2msg", "");
      recording::putChannel(records_, id, static_cast<uint16_t>(id + 1), topic, encoding, {});
    }
    recording::putMessage(records_, id, 0, log_ns, recording::viewOf(message));
  }

  std::string bytes(Chunks chunks) const {
    Bytes file(recording::kMcapMagic, recording::kMcapMagic + sizeof recording::kMcapMagic);
    recording::putHeader(file, "ros2", "test");
    if (chunks == Chunks::kNone)
      file.insert(file.end(), records_.begin(), records_.end());
    else
      putChunk(file, chunks);
    recording::putDataEnd(file, 0);
    return {file.begin(), file.end()};
  }

 private:
  void putChunk(Bytes &file, Chunks chunks) const {
    Bytes stored = records_;
    if (chunks == Chunks::kZstd) {
      stored.resize(ZSTD_compressBound(records_.size()));
      stored.resize(ZSTD_compress(stored.data(), stored.size(), records_.data(), records_.size(), 1));
    }
    const char *name = chunks == Chunks::kZstd ? "zstd" : chunks == Chunks::kBrotli ? "brotli" : "";
    recording::putRecord(file, recording::Op::kChunk, [&] {
      recording::putChunkHead(file, {0, 0, records_.size(), 0, name, stored.size()});
      recording::append(file, stored.data(), stored.size());
    });
  }

  std::vector<std::string> topics_;
  Bytes records_;
};

// The encoding of ROS 1; as CdrWriter.
class Ros1Writer {
 public:
  explicit Ros1Writer(Bytes &out) : out_(out) {}

  template <typename Number>
  void put(Number value) {
    recording::append(out_, &value, sizeof value);
  }
  void putText(const std::string &text) {
    putLength(text.size());
    recording::append(out_, text.data(), text.size());
  }
  void putLength(size_t size) { put(static_cast<uint32_t>(size)); }

 private:
  Bytes &out_;
};

inline void putRosNumber(CdrWriter &) {}
inline void putRosNumber(Ros1Writer &writer) { writer.put(uint32_t{7}); }

template <typename Writer>
void putRosHeader(Writer &writer, int64_t time_ns, const std::string &frame) {
  putRosNumber(writer);
  writer.put(static_cast<uint32_t>(time_ns / 1000000000));
  writer.put(static_cast<uint32_t>(time_ns % 1000000000));
  writer.putText(frame);
}

template <typename Writer = CdrWriter>
Bytes rosImage(int64_t time_ns, const std::string &frame, uint32_t width, uint32_t height,
               const std::string &encoding, const Bytes &pixels) {
  Bytes message;
  Writer writer(message);
  putRosHeader(writer, time_ns, frame);
  writer.put(height);
  writer.put(width);
  writer.putText(encoding);
  writer.put(uint8_t{0});
  writer.put(static_cast<uint32_t>(pixels.size() / height));
  writer.putLength(pixels.size());
  recording::append(message, pixels.data(), pixels.size());
  return message;
}

template <typename Writer = CdrWriter>
Bytes rosCompressedImage(int64_t time_ns, const std::string &frame, const std::string &format, const Bytes &data) {
  Bytes message;
  Writer writer(message);
  putRosHeader(writer, time_ns, frame);
  writer.putText(format);
  writer.putLength(data.size());
  recording::append(message, data.data(), data.size());
  return message;
}

// `k`: fx, fy, cx, cy with the centre of the first pixel at 0; the projection has twice the focal length.
template <typename Writer = CdrWriter>
Bytes rosCameraInfo(const std::string &frame, uint32_t width, uint32_t height, const std::string &model,
                    const std::vector<double> &d, const double (&k)[4], uint32_t binning = 0, uint32_t roi_x = 0) {
  Bytes message;
  Writer writer(message);
  putRosHeader(writer, 0, frame);
  writer.put(height);
  writer.put(width);
  writer.putText(model);
  writer.putLength(d.size());
  for (const double each : d) writer.put(each);
  for (const double each : {k[0], 0.0, k[2], 0.0, k[1], k[3], 0.0, 0.0, 1.0}) writer.put(each);
  for (const double each : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) writer.put(each);
  for (const double each : {2 * k[0], 0.0, k[2], 0.0, 0.0, 2 * k[1], k[3], 0.0, 0.0, 0.0, 1.0, 0.0})
    writer.put(each);
  for (const uint32_t each : {binning, binning, roi_x, 0u, 0u, 0u}) writer.put(each);
  writer.put(uint8_t{0});
  return message;
}

template <typename Writer>
void putRosPose(Writer &writer, const sphc_rigid &pose) {
  for (const double each : pose.t_m) writer.put(each);
  for (const int i : {1, 2, 3, 0}) writer.put(pose.q_wxyz[i]);
}

struct NamedTransform {
  std::string parent, child;
  sphc_rigid parent_from_child;
};

template <typename Writer = CdrWriter>
Bytes rosTransforms(int64_t time_ns, const std::vector<NamedTransform> &transforms) {
  Bytes message;
  Writer writer(message);
  writer.putLength(transforms.size());
  for (const NamedTransform &each : transforms) {
    putRosHeader(writer, time_ns, each.parent);
    writer.putText(each.child);
    putRosPose(writer, each.parent_from_child);
  }
  return message;
}

// `is_measured`: by the covariance of the acceleration, whose first number ROS has for it.
template <typename Writer = CdrWriter>
Bytes rosImu(int64_t time_ns, const std::string &frame, const double (&felt_mps2)[3], bool is_measured = true) {
  Bytes message;
  Writer writer(message);
  putRosHeader(writer, time_ns, frame);
  for (int i = 0; i < 4 + 9 + 3 + 9; ++i) writer.put(0.5);
  for (const double each : felt_mps2) writer.put(each);
  writer.put(is_measured ? 0.0 : -1.0);
  for (int i = 1; i < 9; ++i) writer.put(0.0);
  return message;
}

// Without the covariances and the twist, which nobody reads.
template <typename Writer = CdrWriter>
Bytes rosOdometry(int64_t time_ns, const NamedTransform &pose) {
  Bytes message;
  Writer writer(message);
  putRosHeader(writer, time_ns, pose.parent);
  writer.putText(pose.child);
  putRosPose(writer, pose.parent_from_child);
  return message;
}

}  // namespace sphc::test
