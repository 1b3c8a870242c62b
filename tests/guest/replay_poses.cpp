// Localizes the frames that the cameras play through the replay driver; writes the answers that the guest must
// give:
//
//     replay_poses FOLDER
#include <cstdio>
#include <exception>

#include "drivers/replay/replay.h"
#include "pose_log.h"

namespace sphc::guest {

namespace {

void check(sphc_status status, const sphc_message &message) {
  if (status < 0) throw std::runtime_error(message.text);
}

void writePoses(const std::string &folder) {
  sphc_message message = {};
  sphc_replay_config config;
  sphc_replay_config_init(&config, sizeof config);
  config.first = 1;
  config.step = 2;
  sphc_replay *replay = nullptr;
  check(sphc_replay_open((folder + kWalkFolder).c_str(), nullptr, &config, &replay, &message), message);
  PoseLog log(folder);
  for (uint32_t i = 0; i < sphc_replay_frame_count(replay); ++i) {
    sphc_localizer_frame frame;
    check(sphc_replay_read_frame(replay, i, &frame, &message), message);
    log.add(frame);
  }
  sphc_replay_close(&replay);
  std::printf("%u of %u frames localized\n", log.localized(), kFrames);
  if (log.localized() < kFrames - 2) throw std::runtime_error("too few poses to compare with");
  writeFile(folder + kPosesFile, log.data(), log.bytes());
}

}  // namespace

}  // namespace sphc::guest

int main(int argc, char **argv) try {
  if (argc != 2) return 2;
  sphc::guest::writePoses(argv[1]);
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
