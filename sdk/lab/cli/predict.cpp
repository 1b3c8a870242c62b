// spherecloud-lab predict: where will the camera be, and is the stated error honest?
#include <memory>

#include "host/cli/common/exit_code.h"
#include "host/cli/common/recording_options.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/cli/words.h"
#include "lab/predict/table.h"

namespace sphc::host {
namespace {

struct PredictOptions {
  RecordingOptions recording;
  std::string map;
  std::vector<double> ahead_ms = {0, 5, 11, 16, 33, 50};
};

int run(const PredictOptions &options, const Console &console) {
  std::vector<MapFile> maps;
  maps.push_back(openMapFile(options.map));
  const Vector3 centre = centreByNote({options.map + ".owner.json"}, maps[0], options.map);
  const auto reader = openRecordingWithPoses(options.recording);
  PredictInput input;
  input.reader = reader.get();
  input.maps = &maps;
  input.centre_in_world_m = {centre.x(), centre.y(), centre.z()};
  for (const double ms : options.ahead_ms) input.ahead_ns.push_back(static_cast<int64_t>(1e6 * ms));
  std::vector<PredictRow> rows = runPredict(input, false, saidBy(console));
  for (const PredictRow &row : runPredict(input, true, [](const std::string &) {})) rows.push_back(row);
  console.say(predictText(rows));
  console.give(predictJson(rows));
  return kExitDone;
}

const char kPredictHelp[] =
    "Tracks a recording, without odometry and with the one that `localize --odometry` plays, and asks after every\n"
    "tracked frame for poses ahead of it.  They are compared with the recording's poses, and with the frame's own\n"
    "pose in their place.";
const char kPredictExample[] =
    "Example:\n"
    "  spherecloud-lab predict --recording walk --first 480 --map room.sphc --ahead-ms 16 --ahead-ms 33\n"
    "What comes out: a table; with --json rows.  The owner's note is sought beside the map.";

}  // namespace

Command predictCommand(CLI::App *root) {
  auto options = std::make_shared<PredictOptions>();
  CLI::App *app = root->add_subcommand("predict");
  app->description("Are predicted poses right, and honest?\n\n" + std::string(kPredictHelp));
  app->footer(kPredictExample);
  addRecordingOptions(app, &options->recording);
  app->add_option("-m,--map", options->map, "Map file, with its owner's note beside it")
      ->required()
      ->type_name("FILE");
  app->add_option("--ahead-ms", options->ahead_ms, "Time after a frame; repeat for more")
      ->capture_default_str()
      ->check(CLI::Range(-100.0, 1000.0))
      ->expected(1)
      ->take_all();
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
