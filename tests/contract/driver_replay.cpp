#include "drivers.h"
#include "tests/support/temp_folder.h"
#include "tiny_mcap.h"

namespace sphc::contract {

namespace {

constexpr uint32_t kFrames = 10;

enum class Recorded { kFolder, kMcap, kMcapWithAmplitudes };

struct ReplayOfTempFolder {
  ReplayOfTempFolder(sphc_replay_mode mode, Recorded recorded) {
    const std::string path = recorded == Recorded::kFolder ? folder.path().string() : folder / "walk.mcap";
    if (recorded == Recorded::kFolder)
      writeTinyRecording(path, kFrames);
    else
      writeTinyMcap(path, kFrames, recorderConfig(), recorded == Recorded::kMcapWithAmplitudes);
    sphc_replay_config config = replayConfig();
    config.mode = mode;
    replay = std::make_unique<OpenReplay>(path, nullptr, &config);
  }
  test::TempFolder folder;
  std::unique_ptr<OpenReplay> replay;
};

OpenedDriver openReplay(sphc_replay_mode mode, Recorded recorded) {
  auto opened = std::make_shared<ReplayOfTempFolder>(mode, recorded);
  OpenedDriver driver{{}, opened};
  sphc_replay_source(opened->replay->get(), &driver.source);
  return driver;
}

}  // namespace

std::vector<Driver> replayDrivers() {
  std::vector<Driver> drivers = {
      {"Replay", [] { return openReplay(SPHC_REPLAY_FAST, Recorded::kFolder); }},
      {"ReplayInRealTime", [] { return openReplay(SPHC_REPLAY_REAL_TIME, Recorded::kFolder); }},
      {"ReplayOfMcap", [] { return openReplay(SPHC_REPLAY_FAST, Recorded::kMcap); }},
      {"ReplayOfMcapInRealTime", [] { return openReplay(SPHC_REPLAY_REAL_TIME, Recorded::kMcap); }},
      {"ReplayOfAmplitudes", [] { return openReplay(SPHC_REPLAY_FAST, Recorded::kMcapWithAmplitudes); }}};
  drivers.back().gives_amplitudes = true;
  for (Driver &driver : drivers) {
    driver.captures_until_end = 2 * kFrames;
    driver.is_live = false;
  }
  return drivers;
}

}  // namespace sphc::contract
