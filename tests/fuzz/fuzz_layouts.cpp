// Text files of recordings in folders: the lists of TUM, and the poses of 7-Scenes.
#include <algorithm>
#include <string>

#include "drivers/replay/replay.h"
#include "tests/contract/temp_folder.h"
#include "tests/fuzz/recording_seeds.h"
#include "tests/fuzz/targets.h"

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

void openFolder(const contract::TempFolder &folder) {
  sphc_replay *replay = nullptr;
  sphc_message message = {};
  const sphc_status status = sphc_replay_open(folder.path().c_str(), nullptr, nullptr, &replay, &message);
  if (status != SPHC_OK) {
    if (status > 0 || !message.text[0] || replay) broken("a refusal is a failure that explains itself");
    return;
  }
  for (uint32_t i = 0; i < std::min(sphc_replay_frame_count(replay), 20u); ++i) {
    sphc_localizer_frame frame;
    if (sphc_replay_read_frame(replay, i, &frame, &message) > 0 || !message.text[0])
      broken("an image that is missing is a failure that explains itself");
  }
  sphc_replay_close(&replay);
}

}  // namespace

void tum(const uint8_t *data, size_t bytes) {
  static const contract::TempFolder folder;
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
  static const contract::TempFolder folder;
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

}  // namespace sphc::fuzz
