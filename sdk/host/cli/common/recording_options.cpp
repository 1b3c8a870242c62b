#include "host/cli/common/recording_options.h"

namespace sphc::host {
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

}  // namespace sphc::host
