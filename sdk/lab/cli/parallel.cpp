// spherecloud-lab parallel: how much sooner is a frame answered by several cores?
#include <memory>

#include "host/cli/common/exit_code.h"
#include "host/cli/common/recording_options.h"
#include "lab/cli/commands.h"
#include "lab/parallel/table.h"

namespace sphc::host {
namespace {

struct ParallelOptions {
  RecordingOptions recording;
  std::string map;
  std::vector<uint32_t> threads = {2};
  uint32_t repeats = 9;
};

int runParallelCommand(const ParallelOptions &options, const Console &console) {
  std::vector<MapFile> maps;
  maps.push_back(openMapFile(options.map));
  const auto reader = openRecording(options.recording);
  const ParallelInput input = {readFrames(reader.get()), &maps, options.threads, options.repeats};
  const std::vector<ParallelRow> rows = runParallel(input);
  console.say(parallelText(rows));
  console.give(parallelJson(rows));
  return kExitDone;
}

const char kParallelHelp[] =
    "Localizes every frame of a recording cold, by one thread and by several in turn, and says how much sooner a\n"
    "frame is answered, by the medians of wall time, and whether results are the same to the last bit.";
const char kParallelExample[] =
    "Example:\n"
    "  spherecloud-lab parallel --recording kitchen --first 620 --map room.sphc --repeat 15\n"
    "What comes out: a table; with --json rows.  Nothing else should run on the machine.";

}  // namespace

Command parallelCommand(CLI::App *root) {
  auto options = std::make_shared<ParallelOptions>();
  CLI::App *app = root->add_subcommand("parallel");
  app->description("A frame on several cores.\n\n" + std::string(kParallelHelp));
  app->footer(kParallelExample);
  addRecordingOptions(app, &options->recording);
  app->add_option("-m,--map", options->map, "Map file")->required()->type_name("FILE");
  app->add_option("--threads", options->threads, "Threads for a frame; repeat for more")
      ->capture_default_str()
      ->check(CLI::Range(2u, SPHC_PARALLEL_MAX))
      ->expected(1)
      ->take_all()
      ->type_name("N");
  app->add_option("--repeat", options->repeats, "Runs of a frame of which the median time counts")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
  return {app, [options](const Console &console) { return runParallelCommand(*options, console); }};
}

}  // namespace sphc::host
