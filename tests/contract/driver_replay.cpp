#include "drivers.h"
#include "temp_folder.h"
#include "tiny_recording.h"

namespace sphc::contract {

namespace {

constexpr uint32_t kFrames = 10;

struct ReplayOfTempFolder {
  explicit ReplayOfTempFolder(sphc_replay_mode mode) {
    writeTinyRecording(folder.path().string(), kFrames);
    sphc_replay_config config = replayConfig();
    config.mode = mode;
    replay = std::make_unique<OpenReplay>(folder.path().string(), nullptr, &config);
  }
  TempFolder folder;
  std::unique_ptr<OpenReplay> replay;
};

OpenedDriver openReplay(sphc_replay_mode mode) {
  auto opened = std::make_shared<ReplayOfTempFolder>(mode);
  OpenedDriver driver{{}, opened};
  sphc_replay_source(opened->replay->get(), &driver.source);
  return driver;
}

}  // namespace

std::vector<Driver> replayDrivers() {
  return {{"Replay", [] { return openReplay(SPHC_REPLAY_FAST); }, 2 * kFrames},
          {"ReplayInRealTime", [] { return openReplay(SPHC_REPLAY_REAL_TIME); }, 2 * kFrames}};
}

}  // namespace sphc::contract
