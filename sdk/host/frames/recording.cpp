#include "host/frames/recording.h"

#include <stdexcept>

namespace sphc::host {

Replay openReplay(const RecordingOptions &options) {
  sphc_replay_config config;
  sphc_replay_config_init(&config, sizeof config);
  config.first = options.first;
  config.last = options.last;
  config.step = options.step;
  const char *calibration = options.calibration.empty() ? nullptr : options.calibration.c_str();
  sphc_replay *replay = nullptr;
  sphc_message why = {};
  if (sphc_replay_open(options.folder.c_str(), calibration, &config, &replay, &why) != SPHC_OK)
    throw std::runtime_error(std::string("cannot open the recording: ") + why.text);
  return Replay(replay);
}

sphc_calibration calibrationOf(const sphc_replay *replay) {
  sphc_calibration calibration;
  sphc_calibration_init(&calibration, sizeof calibration);
  if (sphc_replay_calibration(replay, &calibration) != SPHC_OK)
    throw std::runtime_error("the recording's calibration cannot be read; check the calibration file");
  return calibration;
}

}  // namespace sphc::host
