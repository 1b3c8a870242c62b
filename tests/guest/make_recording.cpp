// Records what the guest's cameras will play, with the simulated headset:
//
//     make_recording FOLDER
//
// Colour goes through YUYV, as a camera sends it, before it comes into the recording, so that a driver that
// captures the YUYV and a player of the recording give the same bytes.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "drivers/pixels/convert.h"
#include "drivers/simulated/simulated.h"
#include "host/recording/recording_writer.h"
#include "recorded.h"

namespace sphc::guest {

namespace {

void check(sphc_status status, const sphc_message &message) {
  if (status < 0) throw std::runtime_error(message.text);
}

uint8_t clampByte(double value) { return static_cast<uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); }

// BT.601, limited range; the colour of a pair is that of its left pixel.
std::vector<uint8_t> yuyvFromRgb(const std::vector<uint8_t> &rgb) {
  std::vector<uint8_t> yuyv(kColorBytes);
  const auto luma = [&rgb](size_t pixel) {
    const uint8_t *c = &rgb[3 * pixel];
    return clampByte(16 + 0.2568 * c[0] + 0.5041 * c[1] + 0.0979 * c[2]);
  };
  for (size_t pixel = 0; pixel < rgb.size() / 3; pixel += 2) {
    const uint8_t *c = &rgb[3 * pixel];
    uint8_t *out = &yuyv[2 * pixel];
    out[0] = luma(pixel);
    out[1] = clampByte(128 - 0.1482 * c[0] - 0.2910 * c[1] + 0.4392 * c[2]);
    out[2] = luma(pixel + 1);
    out[3] = clampByte(128 + 0.4392 * c[0] - 0.3678 * c[1] - 0.0714 * c[2]);
  }
  return yuyv;
}

std::vector<uint8_t> bgrFromYuyv(const std::vector<uint8_t> &yuyv) {
  std::vector<uint8_t> bgr(kColorWidth * kColorHeight * 3);
  sphc_message message = {};
  check(pixels::convert(pixels::contiguous(pixels::Layout::Yuyv, pixels::YuvRange::Limited, kColorWidth,
                                           kColorHeight, kColorWidth * 2, yuyv.data(), yuyv.size()),
                        {bgr.data(), bgr.size(), kColorWidth, kColorHeight, kColorWidth * 3, SPHC_FORMAT_BGR8},
                        &message),
        message);
  return bgr;
}

// Frames of even number are for the map, those of odd number are played.
void record(const std::string &folder) {
  sphc_message message = {};
  sphc_simulated_config config;
  sphc_simulated_config_init(&config, sizeof config);
  config.frame_rate_hz = 6.25;
  config.frame_count = 2 * kFrames;
  sphc_simulated *headset = nullptr;
  check(sphc_simulated_open(&config, &headset, &message), message);

  Cameras cameras{};
  sphc_simulated_rig(headset, &cameras.rig);
  std::filesystem::remove_all(folder + kWalkFolder);
  sphc_recording_writer *writer = nullptr;
  check(sphc_recording_create((folder + kWalkFolder).c_str(), &cameras.rig, &writer, &message), message);

  std::vector<uint8_t> rgb(kColorWidth * kColorHeight * 3), all_color, all_depth;
  std::vector<uint16_t> depth(kDepthWidth * kDepthHeight);
  for (uint32_t i = 0; i < config.frame_count; ++i) {
    sphc_simulated_render_color(headset, i, rgb.data());
    sphc_simulated_render_depth(headset, i, depth.data());
    const std::vector<uint8_t> yuyv = yuyvFromRgb(rgb), bgr = bgrFromYuyv(yuyv);
    sphc_localizer_frame frame{};
    frame.struct_size = sizeof frame;
    frame.sequence = i;
    sphc_simulated_frame_times(headset, i, &frame.color_time_ns, &frame.depth_time_ns);
    frame.color = {bgr.data(), kColorWidth, kColorHeight, kColorWidth * 3, SPHC_FORMAT_BGR8};
    frame.depth = {depth.data(), kDepthWidth, kDepthHeight, kDepthWidth * 2, SPHC_FORMAT_DEPTH16};
    sphc_rigid world_from_camera;
    sphc_simulated_pose_at(headset, frame.color_time_ns, &world_from_camera);
    check(sphc_recording_add_frame(writer, &frame, &message), message);
    check(sphc_recording_add_pose(writer, frame.color_time_ns, &world_from_camera, &message), message);
    if (i % 2 == 0) continue;
    cameras.sequence[i / 2] = i;
    cameras.color_time_ns[i / 2] = frame.color_time_ns;
    cameras.depth_time_ns[i / 2] = frame.depth_time_ns;
    all_color.insert(all_color.end(), yuyv.begin(), yuyv.end());
    const auto *depth_bytes = reinterpret_cast<const uint8_t *>(depth.data());
    all_depth.insert(all_depth.end(), depth_bytes, depth_bytes + kDepthBytes);
  }
  check(sphc_recording_close(&writer, &message), message);
  sphc_simulated_close(&headset);
  writeFile(folder + kColorFile, all_color.data(), all_color.size());
  writeFile(folder + kDepthFile, all_depth.data(), all_depth.size());
  writeFile(folder + kCamerasFile, &cameras, sizeof cameras);
}

}  // namespace

}  // namespace sphc::guest

int main(int argc, char **argv) try {
  if (argc != 2) return 2;
  sphc::guest::record(argv[1]);
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
