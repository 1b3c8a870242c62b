#include "host/cli/common/recording_options.h"

#include "host/cli/common/number_checks.h"

namespace sphc::host {
namespace {

const char kGroup[] = "Recording";

}  // namespace

void addFrameOptions(CLI::App *app, RecordingOptions *options) {
  app->add_option("-c,--calibration", options->calibration, "Calibration file [the recording's own]")
      ->type_name("FILE")
      ->group(kGroup);
  app->add_option("--first", options->first, "Number of the first frame [0]")
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX))
      ->group(kGroup);
  app->add_option("--last", options->last, "Number of the last frame [all]")
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX))
      ->group(kGroup);
  app->add_option("--step", options->step, "Take every N-th: first, first + N, ... [1]")
      ->type_name("N")
      ->transform(wholeFrom(1, UINT32_MAX))
      ->group(kGroup);
  app->add_option("--pose-gap-ms", options->pose_gap_ms,
                  "Poses are interpolated between recorded ones at most so far apart")
      ->capture_default_str()
      ->type_name("MS")
      ->transform(wholeFrom(0, kMostPoseGapMs))
      ->group(kGroup);
}

CLI::Option *addRecordingOptions(CLI::App *app, RecordingOptions *options) {
  CLI::Option *recording = app->add_option("-r,--recording", options->folder,
                                           "Recording: a folder, a .mcap or .raw file, or another program's")
                               ->required()
                               ->type_name("PATH")
                               ->group(kGroup);
  addFrameOptions(app, options);
  return recording;
}

CLI::Option *addPosesOption(CLI::App *app, RecordingOptions *options) {
  return app
      ->add_option(
          "--poses-from", options->poses,
          "File of poses in TUM format, in place of the recording's: world_from_camera of the colour camera")
      ->type_name("FILE")
      ->group(kGroup);
}

void addRecordingsOptions(CLI::App *app, std::vector<std::string> *recordings, RecordingOptions *of_each) {
  app->add_option(
         "-r,--recording", *recordings,
         "Recording: a folder, a .mcap or .raw file, or another program's; once for each of several, the oldest "
         "first")
      ->required()
      ->expected(1)
      ->take_all()
      ->type_name("PATH")
      ->group(kGroup);
  addFrameOptions(app, of_each);
}

void noteDamage(const std::string &recording, const Damage &damage, const Console &console) {
  for (const std::string &sentence : sentencesOf(damage)) console.warn("note: " + recording + ": " + sentence);
}

void noteDamage(const RecordingReader &reader, const Console &console) {
  noteDamage(reader.recording().path.string(), damageOf(reader.recording()), console);
}

}  // namespace sphc::host
