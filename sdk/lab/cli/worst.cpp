// spherecloud-lab worst: what do hostile frames and maps cost?
#include <memory>

#include "host/cli/common/exit_code.h"
#include "host/cli/common/recording_options.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/worst/table.h"

namespace sphc::host {
namespace {

struct Options {
  RecordingOptions recording;
  std::string map, once;
  uint32_t frames = 12, repeats = 3;
  sphc_localizer_config config = spherecloud::defaultConfig();
};

int run(const Options &options, const Console &console) {
  const MapFile map = openMapFile(options.map);
  const Vector3 centre = centreByNote({options.map + ".owner.json"}, map, options.map);
  WorstInput input;
  input.sequence = readFrames(openRecordingWithPoses(options.recording).get(), options.frames);
  input.map = &map;
  input.centre_in_world_m = {centre.x(), centre.y(), centre.z()};
  input.config = options.config;
  input.config.mode = SPHC_MODE_SINGLE;
  input.repeats = options.repeats;
  const std::vector<WorstCase> cases = worstCases();
  if (options.once.empty()) {
    const std::vector<WorstRow> rows = runWorst(input, cases);
    console.say(worstText(rows));
    console.give(worstJson(rows));
    return kExitDone;
  }
  for (const WorstCase &each : cases)
    if (each.name == options.once) {
      runOnce(input, each);
      return kExitDone;
    }
  throw std::runtime_error("--once " + options.once +
                           ": there is no such case; without --once the table names all");
}

const char kWorstHelp[] =
    "Localizes frames of a recording as they are, and frames and maps that were made of them to cost the most:\n"
    "noise, patterns of equal descriptors, depth full of edges, maps whose points lie in one cell or one "
    "direction\n"
    "or whose matches are all wrong, as many keypoints as a config may have.  Cases run in turn, in a random "
    "order,\n"
    "on one core.  Time is that of the processor, over the median of a normal frame.";
const char kWorstExample[] =
    "Example:\n"
    "  spherecloud-lab worst --recording walk --first 100 --map room.sphc\n"
    "  valgrind --tool=callgrind --toggle-collect=sphc_localizer_process spherecloud-lab worst --recording walk\n"
    "      --map room.sphc --frames 1 --once \"one cell\"\n"
    "What comes out: a table; with --json rows.  The first row is of normal frames.  The owner's note is sought\n"
    "beside the map.";

}  // namespace

Command worstCommand(CLI::App *root) {
  auto options = std::make_shared<Options>();
  CLI::App *app = root->add_subcommand("worst");
  app->description("What do hostile frames and maps cost?\n\n" + std::string(kWorstHelp));
  app->footer(kWorstExample);
  addRecordingOptions(app, &options->recording);
  app->add_option("-m,--map", options->map, "Map file, with its owner's note beside it")
      ->required()
      ->type_name("FILE");
  app->add_option("--frames", options->frames, "Frames, spread over the recording")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
  app->add_option("--repeat", options->repeats, "Times that each frame is localized; the median counts")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
  app->add_option("--once", options->once, "Each frame of this case once and nothing else, to count instructions")
      ->type_name("CASE");
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
