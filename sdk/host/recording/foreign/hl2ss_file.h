// One stream of a recording of hl2ss (https://github.com/jdibenes/hl2ss): a head, and packets.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "host/recording/pose_track.h"

namespace sphc::recording {

constexpr uint16_t kHl2ssLongThrowPort = 3805, kHl2ssVideoPort = 3810;
// How images are encoded: of the colour camera by H.264 (0 to 2), H.265 or not at all, of the depth camera as PNG
// (0 to 6) or not at all.
constexpr uint32_t kHl2ssH265 = 3, kHl2ssUncoded = 255;

// Said behind the name of a file.
constexpr const char *kHl2ssTooOld =
    ": was written by an older hl2ss, whose files are laid out otherwise; update hl2ss and record again";

struct Hl2ssPacket {
  int64_t time_ns;                 // since the headset was started
  uint64_t start, bytes;           // of what it holds, in the file
  std::optional<sphc_rigid> pose;  // the sensor's own axes; none where the headset did not know its place
};

struct Hl2ssFile {
  uint16_t port = 0;  // which stream it is
  uint32_t profile = 0;
  std::vector<Hl2ssPacket> packets;  // in the file's order
  bool is_cut = false;               // what is whole is there
};

// Reads the streams of colour and of depth ("Long Throw") only.  Throws Failure with the name: DEVICE when it is no
// such file, UNSUPPORTED when it is another stream or of another version.
Hl2ssFile readHl2ss(const std::filesystem::path &path);

// A 4 x 4 matrix of floats as hl2ss has it, for points that are rows: the transpose of ours.  None where it is no
// rigid transform.
std::optional<sphc_rigid> hl2ssRigidFrom(const uint8_t *floats);
constexpr size_t kHl2ssMatrixBytes = 16 * sizeof(float);

}  // namespace sphc::recording
