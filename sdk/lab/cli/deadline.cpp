// spherecloud-lab deadline: do frames end in time, and how many poses are left?
#include <memory>

#include "host/cli/common/exit_code.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/deadline/frames.h"
#include "lab/deadline/table.h"

namespace sphc::host {
namespace {

struct Options {
  RecordingOptions recording;
  std::string map;
  std::vector<uint32_t> deadlines_us = {2000, 3000, 5000, 10000};
  bool noise = false, one_cell = false, half = false, tracking = false;
  uint32_t repeats = 1;
  sphc_localizer_config config = spherecloud::defaultConfig();
  Parameters parameters;
};

DeadlineInput inputOf(const Options &options, const std::vector<MapFile> &maps, const Vector3 &centre) {
  const auto reader = openRecordingWithPoses(options.recording);
  DeadlineInput input;
  input.sequence = readFrames(reader.get());
  input.maps = &maps;
  input.centre_in_world_m = {centre.x(), centre.y(), centre.z()};
  input.config = options.config;
  input.parameters = options.parameters;
  input.config.mode = options.tracking ? SPHC_MODE_TRACKING : SPHC_MODE_SINGLE;
  input.repeats = options.repeats;
  input.deadlines_us = options.deadlines_us;
  input.half = options.half;
  uint64_t seed = 0;
  for (Shot &shot : input.sequence.shots)
    if (options.noise) makeNoise(++seed, &shot);
  return input;
}

int run(const Options &options, const Console &console) {
  std::vector<MapFile> maps;
  maps.push_back(openMapFile(options.map));
  const Vector3 centre = centreByNote({options.map + ".owner.json"}, maps[0], options.map);
  if (options.one_cell) maps[0] = inOneCell(maps[0]);
  ProgressBar bar("deadlines ");
  const std::vector<DeadlineRow> rows =
      runDeadlines(inputOf(options, maps, centre), [&](uint32_t done, uint32_t total) { bar.show(done, total); });
  console.say(deadlineText(rows));
  console.give(deadlineJson(rows));
  return kExitDone;
}

const char kDeadlineHelp[] =
    "Localizes every frame of a recording without a deadline and under several, and counts frames that end within\n"
    "their deadline and 0.3 ms, poses within 5 cm and 5 deg, poses beyond 25 cm or 10 deg, and what was cut.  Time "
    "is\n"
    "that of the processor, for the localizer too: what other programs take does not count.";
const char kDeadlineExample[] =
    "Example:\n"
    "  spherecloud-lab deadline --recording walk --first 100 --map room.sphc --half\n"
    "  spherecloud-lab deadline --recording walk --map room.sphc --noise --deadline-us 2000\n"
    "  spherecloud-lab deadline --recording walk --map room.sphc --one-cell --probes 0 --max-keypoints 4096\n"
    "What comes out: a table; with --json rows.  The first row has no deadline.  The owner's note is sought "
    "beside\n"
    "the map.";

}  // namespace

Command deadlineCommand(CLI::App *root) {
  auto options = std::make_shared<Options>();
  CLI::App *app = root->add_subcommand("deadline");
  app->description("Do frames end by their deadlines?\n\n" + std::string(kDeadlineHelp));
  app->footer(kDeadlineExample);
  addRecordingOptions(app, &options->recording);
  app->add_option("-m,--map", options->map, "Map file, with its owner's note beside it")
      ->required()
      ->type_name("FILE");
  app->add_option("--deadline-us", options->deadlines_us, "Deadline of a frame; repeat for more")
      ->capture_default_str()
      ->check(CLI::Range(1u, 100000000u))
      ->expected(1)
      ->take_all();
  app->add_flag("--half", options->half, "Half of what frames take without a deadline, in addition");
  app->add_flag("--tracking", options->tracking, "Frames follow each other; else each is looked at alone");
  app->add_flag("--noise", options->noise, "White noise in place of every colour image");
  app->add_flag("--one-cell", options->one_cell, "All points of the map in one cell of its index");
  app->add_option("--repeat", options->repeats, "Times that the recording is gone through")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
  app->add_option("--max-keypoints", options->config.max_keypoints, "Strongest keypoints of a frame, 64 to 4096")
      ->capture_default_str();
  app->add_option("--probes", options->parameters.probes,
                  "Cells of the map's index searched for each keypoint; 0: all")
      ->capture_default_str();
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
