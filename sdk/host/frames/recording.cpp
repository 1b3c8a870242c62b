#include "host/frames/recording.h"

#include <stdexcept>

#include "host/base/usage_error.h"

namespace sphc::host {
namespace {

std::string ordinal(uint32_t n) {
  const uint32_t tens = n / 10 % 10, ones = n % 10;
  const char *ending = tens == 1 || ones > 3 || ones == 0 ? "th" : ones == 1 ? "st" : ones == 2 ? "nd" : "rd";
  return std::to_string(n) + ending;
}

Replay open(const RecordingOptions &options) {
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

}  // namespace

sphc_calibration calibrationOf(const sphc_replay *replay) {
  sphc_calibration calibration;
  sphc_calibration_init(&calibration, sizeof calibration);
  if (sphc_replay_calibration(replay, &calibration) != SPHC_OK)
    throw std::runtime_error("the recording's calibration cannot be read; check the calibration file");
  return calibration;
}

Replay openRecording(const RecordingOptions &options) {
  if (options.last < options.first) throw UsageError("--last lies before --first; swap them");
  Replay replay = open(options);
  if (sphc_replay_frame_count(replay.get()) == 0) {
    throw std::runtime_error("no frame of colour and depth in " + options.folder + " for " +
                             describeSelection(options) +
                             ": check --first, --last, --step, and that depth images are there");
  }
  return replay;
}

std::string describeSelection(const RecordingOptions &options) {
  const bool all = options.first == 0 && options.last == UINT32_MAX;
  std::string text = all ? "all frames" : "frames " + std::to_string(options.first) + " to ";
  if (!all) text += options.last == UINT32_MAX ? "the end" : std::to_string(options.last);
  if (options.step > 1) text += ", every " + ordinal(options.step);
  return text;
}

}  // namespace sphc::host
