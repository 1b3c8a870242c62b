// spherecloud-lab hints: is a frame without a pose told why?
#include <memory>

#include "host/cli/common/exit_code.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/hints/table.h"

namespace sphc::host {
namespace {

struct HintOptions {
  RecordingOptions recording;
  std::string map;
  std::vector<std::string> only;
  uint32_t sequences = 4;
};

int run(const HintOptions &options, const Console &console) {
  const std::vector<HintCondition> conditions = chosenByName(options.only, hintConditions());
  const auto reader = openRecording(options.recording);
  std::vector<MapFile> maps;
  maps.push_back(openMapFile(options.map));
  const HintInput input = {readSequences(reader.get(), options.sequences), &maps};
  ProgressBar bar("conditions ");
  const std::vector<HintRow> rows =
      runHints(input, conditions, [&bar](uint32_t done, uint32_t total) { bar.show(done, total); });
  console.say(hintText(rows));
  console.give(hintJson(rows));
  return kExitDone;
}

const char kHintsHelp[] =
    "Makes sequences of 30 frames dark, blurred, plain or without depth, localizes them in a map, frame by frame\n"
    "alone and tracking, and counts frames without a pose, those that are told why, and those with each hint.  Of\n"
    "healthy frames those are counted that are told nothing.";
const char kHintsExample[] =
    "Example:\n"
    "  spherecloud-lab hints --recording walk --first 100 --map room.sphc\n"
    "  spherecloud-lab hints --recording other --map room.sphc --only healthy      not in the map\n"
    "What comes out: a table; with --json rows.";

}  // namespace

Command hintsCommand(CLI::App *root) {
  auto options = std::make_shared<HintOptions>();
  CLI::App *app = root->add_subcommand("hints");
  app->description("Is a frame without a pose told why?\n\n" + std::string(kHintsHelp));
  app->footer(kHintsExample);
  addRecordingOptions(app, &options->recording);
  app->add_option("-m,--map", options->map, "Map file")->required()->type_name("FILE");
  app->add_option("--sequences", options->sequences, "At most so many, spread over the recording")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
  addOnlyOption(app, &options->only, "condition");
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
