// spherecloud-lab features: keypoint extractors on the frames of a recording.
#include <filesystem>
#include <memory>

#include "host/base/usage_error.h"
#include "host/base/write_file.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/cli/words.h"
#include "lab/features/table.h"

namespace sphc::host {
namespace {

struct FeaturesCommandOptions {
  std::vector<std::string> recordings, calibrations, only;
  std::vector<uint32_t> first, last;
  uint32_t step = 1;
  FeaturesOptions bench;
  std::string python = "python3", results;
  bool no_peers = false, force = false;
};

// Present variants, of those asked for; names the absent.
std::vector<FeaturesVariant> chooseVariants(const FeaturesCommandOptions &options, const GrayRecording &recording,
                                            const Console &console) {
  std::vector<FeaturesVariant> all = ourFeatures(recording.camera.width(), recording.camera.height());
  if (!options.no_peers) {
    for (FeaturesVariant &peer : openCvFeatures()) all.push_back(std::move(peer));
    all.push_back(colmapFeatures(options.python));
  }
  all = chosenByName(options.only, std::move(all));
  for (const FeaturesVariant &variant : all)
    if (!variant.run) console.warn("note: " + variant.name + " is absent, " + variant.absent);
  return all;
}

FeaturesTable measure(const FeaturesCommandOptions &options, size_t which, const Console &console) {
  RecordingOptions source;
  source.folder = options.recordings[which];
  if (!options.calibrations.empty()) source.calibration = options.calibrations[which];
  if (!options.first.empty()) source.first = options.first[which];
  if (!options.last.empty()) source.last = options.last[which];
  source.step = options.step;
  const GrayRecording recording = readGray(openRecording(source).get(), saidBy(console));
  const auto variants = chooseVariants(options, recording, console);
  ProgressBar bar("measuring ");
  FeaturesTable table = {
      std::filesystem::path(source.folder).lexically_normal().string(), recording.frames.size(), {}};
  table.summaries = runFeaturesBench(recording, variants, options.bench,
                                     [&bar](uint32_t done, uint32_t total) { bar.show(done, total); });
  return table;
}

int run(const FeaturesCommandOptions &options, const Console &console) {
  const auto fits = [&](size_t given) { return given == 0 || given == options.recordings.size(); };
  if (!fits(options.calibrations.size()) || !fits(options.first.size()) || !fits(options.last.size()))
    throw UsageError(
        "give --calibration, --first and --last once for each --recording, in the same order, or never");
  FileUse files(options.force);
  for (const std::string &path : options.recordings) files.reads("--recording", path);
  for (const std::string &path : options.calibrations) files.reads("--calibration", path);
  files.writes("--results", options.results, holds(featuresResults({})));
  files.check();
  const int core = pinToOneCore();
  console.say(pinnedText(core, "CPU time"));
  std::vector<FeaturesTable> tables;
  for (size_t i = 0; i < options.recordings.size(); ++i) {
    tables.push_back(measure(options, i, console));
    console.say("\n" + featuresText(tables.back()));
  }
  if (!options.results.empty()) writeFile(options.results, featuresResults(tables));
  console.give({{"core", core}, {"repeats", options.bench.repeats}, {"tables", featuresJson(tables)}});
  return kExitDone;
}

const char kFeaturesHelp[] =
    "Extracts keypoints from every frame by the library and its peers in one interleaved run, on one core.  Then\n"
    "matches frames 8 and 20 apart by the ratio test and counts the matches that the recorded poses confirm.\n"
    "docs/bench.md says more.";
const char kFeaturesExample[] =
    "Example:\n"
    "  spherecloud-lab features --recording kitchen --first 620\n"
    "  spherecloud-lab features --recording kitchen --calibration kitchen.json --only 'ours 800' --no-peers\n"
    "What comes out: a table a recording.";

void addOptions(CLI::App *app, FeaturesCommandOptions *options) {
  app->add_option("-r,--recording", options->recordings, "Folder of a recording; repeat for more")
      ->required()
      ->expected(1)
      ->take_all()
      ->type_name("DIR");
  app->add_option("-c,--calibration", options->calibrations, "Its calibration file [DIR/calibration.json]")
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
  app->add_option("--first", options->first, "Number of its first frame [0]")
      ->expected(1)
      ->take_all()
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX));
  app->add_option("--last", options->last, "Number of its last frame [all]")
      ->expected(1)
      ->take_all()
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX));
  app->add_option("--step", options->step, "Take every N-th frame [1]")
      ->type_name("N")
      ->transform(wholeFrom(1, UINT32_MAX));
  addRepeatOption(app, &options->bench.repeats);
  app->add_option("--every", options->bench.every, "Frames from one pair to the next")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000000u))
      ->type_name("N");
  addOnlyOption(app, &options->only, "variant");
  app->add_flag("--no-peers", options->no_peers, "The library's own extractor only");
  app->add_option("--python", options->python, "Python that has pycolmap and numpy")
      ->capture_default_str()
      ->type_name("PATH");
  app->add_option("--results", options->results, "Write counts and ratios, no milliseconds")->type_name("FILE");
}

}  // namespace

Command featuresCommand(CLI::App *root) {
  auto options = std::make_shared<FeaturesCommandOptions>();
  CLI::App *app = root->add_subcommand("features");
  app->description("Keypoint extractors on the frames of a recording.\n\n" + std::string(kFeaturesHelp));
  app->footer(kFeaturesExample);
  addOptions(app, options.get());
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
