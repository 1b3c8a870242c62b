// spherecloud-lab rig: what do further cameras bring, grey ones and of depth?
#include <memory>

#include "host/base/checked_call.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/progress.h"
#include "lab/cli/commands.h"
#include "lab/rig/table.h"

namespace sphc::host {
namespace {

constexpr uint32_t kPlaces = 200;  // of the walk

struct RigOptions {
  std::string map, with = "bare";
  uint64_t seed = 1;
  uint32_t views = 20, keypoints = 1600, threads = 0;
};

Simulated openRoom(const RigOptions &options) {
  sphc_simulated_config config;
  sphc_simulated_config_init(&config, sizeof config);
  config.seed = config.walk_seed = options.seed;
  config.walk_start_s = config.lap_s;  // lap two
  config.frame_count = kPlaces;
  config.frame_rate_hz = kPlaces / config.lap_s;
  config.threads = options.threads;
  orThrow("--with", [&](sphc_message *message) {
    return sphc_simulated_parse_with(options.with.c_str(), &config.with, message);
  });
  sphc_simulated *room = nullptr;
  orThrow("cannot make the simulated room",
          [&](sphc_message *message) { return sphc_simulated_open(&config, &room, message); });
  return Simulated(room);
}

int run(const RigOptions &options, const Console &console) {
  std::vector<MapFile> maps;
  maps.push_back(openMapFile(options.map));
  const Simulated room = openRoom(options);
  RigInput input;
  input.room = room.get();
  input.maps = &maps;
  input.centre_in_world_m = centreByNote({options.map + ".owner.json"}, maps[0], options.map);
  input.views = options.views;
  input.keypoints = options.keypoints;
  ProgressBar bar("views ");
  const std::vector<RigRow> rows = runRig(input, [&bar](uint32_t done, uint32_t total) { bar.show(done, total); });
  console.say(rigText(rows));
  console.give(rigJson(rows));
  return kExitDone;
}

const char kRigHelp[] =
    "Looks around in a simulated room with four grey cameras (ahead, left, right, down) and a wide ToF camera, as "
    "the\n"
    "walk's second lap does and with nothing but a wall ahead, and localizes each frame alone by the first "
    "camera, by\n"
    "two, by three and by all, with as many keypoints in all; by all also with a narrow ToF camera ahead in place "
    "of\n"
    "the wide one, and with that and another to the left, which says 1 cm too much.";
const char kRigExample[] =
    "Example:\n"
    "  spherecloud-lab rig --seed 7 --map room.sphc\n"
    "The map is of lap one:\n"
    "  spherecloud simulate --out walk --seed 7 --walk-seed 7 --with bare --frames 100 --rate 6.25\n"
    "  spherecloud build --recording walk --map room.sphc\n"
    "What comes out: a table; with --json rows.  The owner's note is sought beside the map.";

}  // namespace

Command rigCommand(CLI::App *root) {
  auto options = std::make_shared<RigOptions>();
  CLI::App *app = root->add_subcommand("rig");
  app->description("What do further cameras bring?\n\n" + std::string(kRigHelp));
  app->footer(kRigExample);
  app->add_option("-m,--map", options->map, "Map file, with its owner's note beside it")
      ->required()
      ->type_name("FILE");
  app->add_option("--seed", options->seed, "Room and walk that the map was made of")->capture_default_str();
  app->add_option("--with", options->with, "What else it was made with")->capture_default_str();
  app->add_option("--views", options->views, "Frames of each kind, at most")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u));
  app->add_option("--keypoints", options->keypoints, "Of all cameras together, at most")
      ->capture_default_str()
      ->check(CLI::Range(64u, 4096u));
  app->add_option("--threads", options->threads, "That draw the room; 0: as many as there are cores")
      ->capture_default_str()
      ->check(CLI::Range(0u, 64u));
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
