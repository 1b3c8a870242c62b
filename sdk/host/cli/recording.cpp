#include "host/cli/recording.h"

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
  Replay replay = openReplay(options);
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
