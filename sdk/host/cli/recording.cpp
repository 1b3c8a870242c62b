#include "host/cli/recording.h"

#include "host/cli/door.h"
#include "host/cli/exit_code.h"

namespace sphc::host {
namespace {

std::string ordinal(uint32_t n) {
  const uint32_t tens = n / 10 % 10, ones = n % 10;
  const char *ending = tens == 1 || ones > 3 || ones == 0 ? "th" : ones == 1 ? "st" : ones == 2 ? "nd" : "rd";
  return std::to_string(n) + ending;
}

}  // namespace

CLI::Option *addRecordingOptions(CLI::App *app, RecordingOptions *options) {
  const char *group = "Recording";
  CLI::Option *recording = app->add_option("-r,--recording", options->folder,
                                           "Recording: a folder (7-Scenes or TUM layout) or a .mcap file")
                               ->required()
                               ->type_name("PATH")
                               ->group(group);
  app->add_option("-c,--calibration", options->calibration, "Calibration file [the recording's own]")
      ->type_name("FILE")
      ->group(group);
  app->add_option("--first", options->first, "Number of the first frame [0]")->type_name("N")->group(group);
  app->add_option("--last", options->last, "Number of the last frame [all]")->type_name("N")->group(group);
  app->add_option("--step", options->step, "Take every N-th: first, first + N, ... [1]")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->group(group);
  return recording;
}

Replay openRecording(const RecordingOptions &options) {
  if (options.last < options.first) throw UsageError("--last lies before --first; swap them");
  sphc_replay_config config;
  orThrow("replay", [&](sphc_message *) { return sphc_replay_config_init(&config, sizeof config); });
  config.first = options.first;
  config.last = options.last;
  config.step = options.step;
  sphc_replay *replay = nullptr;
  const char *calibration = options.calibration.empty() ? nullptr : options.calibration.c_str();
  orThrow("cannot open the recording", [&](sphc_message *message) {
    return sphc_replay_open(options.folder.c_str(), calibration, &config, &replay, message);
  });
  Replay owned(replay);
  if (sphc_replay_frame_count(replay) == 0) {
    throw std::runtime_error("no frame of colour and depth in " + options.folder + " for " +
                             describeSelection(options) +
                             ": check --first, --last, --step, and that depth images are there");
  }
  return owned;
}

std::string describeSelection(const RecordingOptions &options) {
  const bool all = options.first == 0 && options.last == UINT32_MAX;
  std::string text = all ? "all frames" : "frames " + std::to_string(options.first) + " to ";
  if (!all) text += options.last == UINT32_MAX ? "the end" : std::to_string(options.last);
  if (options.step > 1) text += ", every " + ordinal(options.step);
  return text;
}

sphc_calibration calibrationOf(const sphc_replay *replay) {
  sphc_calibration calibration;
  orThrow("calibration", [&](sphc_message *) { return sphc_calibration_init(&calibration, sizeof calibration); });
  orThrow("calibration", [&](sphc_message *) { return sphc_replay_calibration(replay, &calibration); });
  return calibration;
}

}  // namespace sphc::host
