// Files as hl2ss writes them, in memory.
#pragma once

#include <spherecloud/spherecloud.h>

#include <array>
#include <string>

#include "host/recording/mcap/bytes.h"

namespace sphc::test {

// Row by row for points that are rows: the last row is where it is.
using Hl2ssMatrix = std::array<float, 16>;
constexpr Hl2ssMatrix kHl2ssUnknownPose = {};

inline Hl2ssMatrix hl2ssMatrixOf(const sphc_rigid &rigid) {
  Hl2ssMatrix matrix = {};
  for (size_t axis = 0; axis < 4; ++axis) {  // where the unit points are, and the origin
    const double point[3] = {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
    double moved[3];
    sphc_rigid_apply(&rigid, point, moved);
    for (size_t i = 0; i < 3; ++i)
      matrix[4 * axis + i] = static_cast<float>(moved[i] - (axis < 3 ? rigid.t_m[i] : 0));
  }
  matrix[15] = 1;
  return matrix;
}

class Hl2ssBytes {
 public:
  static Hl2ssBytes ofVideo(uint16_t width, uint16_t height, uint8_t profile, uint8_t mode = 1) {
    Hl2ssBytes file(3810);
    file.put(mode);
    file.put(width);
    file.put(height);
    for (const uint8_t each : {uint8_t{30}, uint8_t{1}, profile, uint8_t{255}}) file.put(each);
    file.put(uint32_t{5000000});
    file.put(uint8_t{1});  // an option
    file.put(uint64_t{10});
    file.put(uint64_t{60});
    return file;
  }
  static Hl2ssBytes ofDepth(uint32_t profile, uint8_t mode = 1) {
    Hl2ssBytes file(3805);
    file.put(mode);
    file.put(uint8_t{1});
    file.put(profile);
    return file;
  }

  void addColor(uint64_t ticks, const std::string &image, std::array<float, 4> params, uint16_t width,
                uint16_t height, const Hl2ssMatrix &pose) {
    std::string tail(80, '\7');
    std::memcpy(tail.data(), params.data(), sizeof params);
    recording::storeLittle(reinterpret_cast<uint8_t *>(tail.data()) + 76, width);
    recording::storeLittle(reinterpret_cast<uint8_t *>(tail.data()) + 78, height);
    add(ticks, image + tail, &pose);
  }
  void addDepth(uint64_t ticks, const std::string &image, const Hl2ssMatrix &pose) {
    add(ticks, image + std::string(8, '\7'), &pose);
  }
  void add(uint64_t ticks, const std::string &held, const Hl2ssMatrix *pose) {
    put(ticks);
    put(static_cast<uint32_t>(held.size()));
    bytes_ += held;
    if (pose) bytes_.append(reinterpret_cast<const char *>(pose->data()), sizeof *pose);
  }
  const std::string &bytes() const { return bytes_; }

 private:
  explicit Hl2ssBytes(uint16_t port) : bytes_("HL2SSV23") {
    const std::string user = "made up";
    put(port);
    put(static_cast<uint32_t>(user.size()));
    bytes_ += user;
  }
  template <typename Unsigned>
  void put(Unsigned value) {
    uint8_t stored[sizeof value];
    recording::storeLittle(stored, value);
    bytes_.append(reinterpret_cast<const char *>(stored), sizeof stored);
  }

  std::string bytes_;
};

}  // namespace sphc::test
