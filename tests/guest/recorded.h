// What make_recording leaves in a folder: the frames that the cameras of the guest play, and what is to come of
// them.
#pragma once

#include <spherecloud/spherecloud.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace sphc::guest {

constexpr uint32_t kFrames = 8;
constexpr uint32_t kColorWidth = 640, kColorHeight = 480, kDepthWidth = 320, kDepthHeight = 288;
constexpr uint32_t kColorBytes = kColorWidth * kColorHeight * 2, kDepthBytes = kDepthWidth * kDepthHeight * 2;

constexpr const char *kColorFile = "/color.yuyv";  // kFrames, one behind the other
constexpr const char *kDepthFile = "/depth.z16";
constexpr const char *kCamerasFile = "/cameras.bin";  // a Cameras
constexpr const char *kMapFile = "/room.sphc";
constexpr const char *kPosesFile = "/poses.bin";  // kFrames times a sphc_localizer_result
constexpr const char *kWalkFolder = "/walk";      // the recording, with frames for the map between those played

// Only between programs of one build: no format for anyone else.
struct Cameras {
  sphc_rig rig;
  uint32_t sequence[kFrames];
  int64_t color_time_ns[kFrames], depth_time_ns[kFrames];
};

inline std::vector<uint8_t> readFile(const std::string &path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void writeFile(const std::string &path, const void *data, size_t bytes) {
  std::ofstream stream(path, std::ios::binary);
  stream.write(static_cast<const char *>(data), static_cast<std::streamsize>(bytes)).flush();
  if (!stream) throw std::runtime_error(path + ": cannot be written");
}

inline Cameras readCameras(const std::string &folder) {
  const std::vector<uint8_t> bytes = readFile(folder + kCamerasFile);
  if (bytes.size() != sizeof(Cameras)) throw std::runtime_error("cameras of another build");
  Cameras cameras;
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<uint8_t *>(&cameras));
  return cameras;
}

}  // namespace sphc::guest
