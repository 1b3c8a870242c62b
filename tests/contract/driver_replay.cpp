#include "drivers.h"
#include "temp_folder.h"
#include "tiny_mcap.h"

namespace sphc::contract {

namespace {

constexpr uint32_t kFrames = 10;

struct ReplayOfTempFolder {
  ReplayOfTempFolder(sphc_replay_mode mode, bool is_mcap) {
    const std::string path = is_mcap ? folder / "walk.mcap" : folder.path().string();
    if (is_mcap)
      writeTinyMcap(path, kFrames, recorderConfig());
    else
      writeTinyRecording(path, kFrames);
    sphc_replay_config config = replayConfig();
    config.mode = mode;
    replay = std::make_unique<OpenReplay>(path, nullptr, &config);
  }
  TempFolder folder;
  std::unique_ptr<OpenReplay> replay;
};

OpenedDriver openReplay(sphc_replay_mode mode, bool is_mcap) {
  auto opened = std::make_shared<ReplayOfTempFolder>(mode, is_mcap);
  OpenedDriver driver{{}, opened};
  sphc_replay_source(opened->replay->get(), &driver.source);
  return driver;
}

}  // namespace

std::vector<Driver> replayDrivers() {
  return {{"Replay", [] { return openReplay(SPHC_REPLAY_FAST, false); }, 2 * kFrames},
          {"ReplayInRealTime", [] { return openReplay(SPHC_REPLAY_REAL_TIME, false); }, 2 * kFrames},
          {"ReplayOfMcap", [] { return openReplay(SPHC_REPLAY_FAST, true); }, 2 * kFrames},
          {"ReplayOfMcapInRealTime", [] { return openReplay(SPHC_REPLAY_REAL_TIME, true); }, 2 * kFrames}};
}

}  // namespace sphc::contract
