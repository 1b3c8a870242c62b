#include "drivers.h"
#include "tests/support/temp_folder.h"
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
  test::TempFolder folder;
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
  std::vector<Driver> drivers = {
      {"Replay", [] { return openReplay(SPHC_REPLAY_FAST, false); }},
      {"ReplayInRealTime", [] { return openReplay(SPHC_REPLAY_REAL_TIME, false); }},
      {"ReplayOfMcap", [] { return openReplay(SPHC_REPLAY_FAST, true); }},
      {"ReplayOfMcapInRealTime", [] { return openReplay(SPHC_REPLAY_REAL_TIME, true); }}};
  for (Driver &driver : drivers) {
    driver.captures_until_end = 2 * kFrames;
    driver.is_live = false;
  }
  return drivers;
}

}  // namespace sphc::contract
