// A small recording of an Azure Kinect, written element by element as RFC 8794 and RFC 9559 say.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sphc::test {

// Bytes of an element: its size in eight bytes, or, where it is open, unsaid.
inline std::string ebml(uint32_t id, const std::string &content, bool is_open = false) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    if (id >> shift) bytes += static_cast<char>(id >> shift);
  bytes += '\x01';
  for (int shift = 48; shift >= 0; shift -= 8)
    bytes += is_open ? '\xFF' : static_cast<char>(uint64_t{content.size()} >> shift);
  return bytes + content;
}

inline std::string bigEndian(uint64_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i));
  return text;
}

struct KinectTrack {
  std::string name, fourcc;
  uint32_t width, height;
  std::string codec = "V_MS/VFW/FOURCC";
  std::string more = {};  // further elements of its entry
};

// Blocks go into the cluster that was begun last; times are microseconds, as k4arecorder's.
class KinectFile {
 public:
  void addTrack(const KinectTrack &track) {
    const std::string head = std::string(16, '\0') + track.fourcc + std::string(20, '\0');  // BITMAPINFOHEADER
    ++track_count_;
    tracks_ +=
        ebml(0xAE, ebml(0xD7, bigEndian(track_count_, 1)) + ebml(0x73C5, bigEndian(track_count_, 8)) +
                       ebml(0x83, track.width > 0 ? "\x01" : "\x11") + ebml(0x536E, track.name) +
                       ebml(0x86, track.codec) + ebml(0x63A2, head) + track.more +
                       ebml(0xE0, ebml(0xB0, bigEndian(track.width, 2)) + ebml(0xBA, bigEndian(track.height, 2))));
  }
  void beginCluster(uint64_t time_us) { clusters_.push_back(ebml(0xE7, bigEndian(time_us, 8))); }
  // `lacing`: of the flags.
  void addBlock(int track, int16_t relative_us, const std::string &frame, bool in_group = false, char lacing = 0) {
    const std::string block = std::string(1, static_cast<char>(0x80 | track)) +
                              bigEndian(static_cast<uint16_t>(relative_us), 2) + lacing + frame;
    clusters_.back() += in_group ? ebml(0xA0, ebml(0xA1, block)) : ebml(0xA3, block);
  }
  void attach(const std::string &name, const std::string &data) {
    after_ += ebml(0x1941A469, ebml(0x61A7, ebml(0x466E, name) + ebml(0x4660, "application/octet-stream") +
                                                ebml(0x46AE, "\x05") + ebml(0x465C, data)));
  }
  void tag(const std::string &name, const std::string &text) {
    after_ +=
        ebml(0x1254C367, ebml(0x7373, ebml(0x63C0, "") + ebml(0x67C8, ebml(0x45A3, name) + ebml(0x4487, text))));
  }

  // `is_live`: as a recorder leaves it that could not go back to write sizes.
  std::string bytes(bool is_live = false) const {
    std::string segment =
        ebml(0x1549A966, ebml(0x2AD7B1, bigEndian(1000, 4))) + ebml(0xEC, "void") + ebml(0x1654AE6B, tracks_);
    for (const std::string &cluster : clusters_) segment += ebml(0x1F43B675, cluster, is_live);
    return ebml(0x1A45DFA3, ebml(0x4282, "matroska")) + ebml(0x18538067, segment + after_, is_live);
  }

 private:
  std::string tracks_, after_;
  std::vector<std::string> clusters_;
  uint64_t track_count_ = 0;
};

}  // namespace sphc::test
