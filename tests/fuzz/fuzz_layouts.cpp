// Files of recordings in folders: the lists of TUM, the poses of 7-Scenes, the streams of hl2ss.
#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "drivers/replay/replay.h"
#include "tests/fuzz/recording_seeds.h"
#include "tests/fuzz/targets.h"
#include "tests/support/hl2ss.h"
#include "tests/support/temp_folder.h"

namespace sphc::fuzz {
namespace {

// Of a recording without images: what is asked of them fails.
const char *const kCalibration = R"({"format": "spherecloud-calibration", "version": 1, "pixel_center": 0.5,
  "color_camera": {"model": "pinhole", "width": 16, "height": 16, "params": [20, 20, 8, 8]},
  "depth_camera": {"model": "pinhole", "width": 16, "height": 16, "params": [20, 20, 8, 8]},
  "color_from_depth": {"q_wxyz": [1, 0, 0, 0], "t_m": [0, 0, 0]}, "depth_unit_m": 0.001})";

std::string takeFile(std::string *rest) {
  const size_t end = rest->find('\0');
  const std::string file = rest->substr(0, end);
  *rest = end == std::string::npos ? "" : rest->substr(end + 1);
  return file;
}

void openFolder(const test::TempFolder &folder, bool has_images = false) {
  sphc_replay *replay = nullptr;
  sphc_message message = {};
  const sphc_status status = sphc_replay_open(folder.path().c_str(), nullptr, nullptr, &replay, &message);
  if (status != SPHC_OK) {
    if (status > 0 || !message.text[0] || replay) broken("a refusal is a failure that explains itself");
    return;
  }
  accept();
  for (uint32_t i = 0; i < std::min(sphc_replay_frame_count(replay), 20u); ++i) {
    sphc_localizer_frame frame;
    const sphc_status read = sphc_replay_read_frame(replay, i, &frame, &message);
    if (read > 0 || (read < 0 && !message.text[0]) || (read == SPHC_OK && !has_images))
      broken("an image that is missing is a failure that explains itself");
  }
  sphc_replay_close(&replay);
}

// The calibration of a recording of hl2ss: a pinhole camera's rays.
void writeHl2ssCalibration(const test::TempFolder &folder) {
  const auto write = [&](const char *name, const std::vector<float> &values) {
    folder.write(std::string("rm_depth_longthrow/") + name,
                 {reinterpret_cast<const char *>(values.data()), values.size() * sizeof(float)});
  };
  std::vector<float> points;
  for (int v = 0; v < 288; ++v)
    for (int u = 0; u < 320; ++u)
      for (const int offset : {u - 160, v - 144}) points.push_back(static_cast<float>(offset) / 200);
  write("uv2xy.bin", points);
  write("scale.bin", {1000});
  const test::Hl2ssMatrix still = test::hl2ssMatrixOf({{1, 0, 0, 0}, {0, 0, 0}});
  write("extrinsics.bin", {still.begin(), still.end()});
}

std::string hl2ssColor(uint8_t profile) {
  test::Hl2ssBytes file = test::Hl2ssBytes::ofVideo(16, 16, profile);
  for (const uint64_t ticks : {1000u, 301000u})
    file.addColor(ticks, std::string(64 * 24, 'c'), {20, 20, 8, 8}, 16, 16,
                  test::hl2ssMatrixOf({{1, 0, 0, 0}, {}}));
  return file.bytes();
}

std::string hl2ssDepth() {
  std::vector<uint8_t> png;
  cv::imencode(".png", cv::Mat(288, 320, CV_8UC4, cv::Scalar(200, 7, 200, 7)), png);
  test::Hl2ssBytes file = test::Hl2ssBytes::ofDepth(0);
  for (const uint64_t ticks : {1000u, 301000u})
    file.addDepth(ticks, {png.begin(), png.end()}, test::hl2ssMatrixOf({{1, 0, 0, 0}, {}}));
  return file.bytes();
}

}  // namespace

void tum(const uint8_t *data, size_t bytes) {
  static const test::TempFolder folder;
  std::string rest(data, data + bytes);
  folder.write("calibration.json", kCalibration);
  for (const char *name : {"rgb.txt", "depth.txt", "groundtruth.txt"}) folder.write(name, takeFile(&rest));
  openFolder(folder);
}

std::vector<std::vector<uint8_t>> tumSeeds() {
  const std::string images = "# time file\n1305031102.175304 rgb/1.png\n1305031102.211214 rgb/2.png\n",
                    poses = "1305031102.17 1.3 0.6 1.6 0.65 0.61 -0.29 -0.32\n1305031103 0 0 0 0 0 0 1\n",
                    all = images + '\0' + images + '\0' + poses;
  return {{all.begin(), all.end()}};
}

void sevenScenes(const uint8_t *data, size_t bytes) {
  static const test::TempFolder folder;
  std::string rest(data, data + bytes);
  folder.write("calibration.json", kCalibration);
  for (const char *name : {"frame-000000", "frame-000001"}) {
    folder.write(std::string(name) + ".color.png", "");
    folder.write(std::string(name) + ".depth.png", "");
    folder.write(std::string(name) + ".pose.txt", takeFile(&rest));
  }
  openFolder(folder);
}

std::vector<std::vector<uint8_t>> sevenScenesSeeds() {
  const std::string pose = "1 0 0 0.5\n0 1 0 -2\n0 0 1 1e-3\n0 0 0 1\n", lost = "nan nan\n",
                    all = pose + '\0' + lost;
  return {{all.begin(), all.end()}};
}

void hl2ssFolder(const uint8_t *data, size_t bytes) {
  if (bytes == 0) return;
  static const test::TempFolder folder;
  static const std::string color = hl2ssColor(255), depth = hl2ssDepth();
  if (!std::filesystem::exists(folder.path() / "rm_depth_longthrow")) writeHl2ssCalibration(folder);
  const std::string file(data + 1, data + bytes);
  folder.write("personal_video.bin", data[0] % 2 == 0 ? file : color);
  folder.write("rm_depth_longthrow.bin", data[0] % 2 == 0 ? depth : file);
  openFolder(folder, true);
}

std::vector<std::vector<uint8_t>> hl2ssFolderSeeds() {
  std::vector<std::vector<uint8_t>> seeds;
  for (const std::string &file : {"0" + hl2ssColor(255), "0" + hl2ssColor(2), "1" + hl2ssDepth()})
    seeds.emplace_back(file.begin(), file.end());
  return seeds;
}

}  // namespace sphc::fuzz
