// spherecloud build: from a recording with poses to a sphere-cloud file.
#include <chrono>
#include <memory>

#include "host/build/map_writer.h"
#include "host/build/secret_random.h"
#include "host/build/sphere_cloud.h"
#include "host/cli/command.h"
#include "host/cli/exit_code.h"
#include "host/cli/map_file.h"
#include "host/cli/progress.h"
#include "host/cli/recording.h"
#include "host/import/rgbd_import.h"

namespace sphc::host {
namespace {

struct Options {
  RecordingOptions recording;
  std::string map, key, new_key;
  SphereCloudOptions cloud;
  std::string fakes = "patchwork";
  double sigma2 = 0.1, patch_deg = 12;
  RgbdImportOptions import;
};

SecretKey chooseKey(const Options &options) {
  if (!options.key.empty()) return readSecretKey(options.key);
  const SecretKey key = newSecretKey();
  if (!options.new_key.empty()) writeSecretKey(options.new_key, key);
  return key;
}

PointModel importModel(const Options &options, RgbdImportSummary *summary) {
  const Replay replay = openRecording(options.recording);
  ProgressBar bar("mapping   ");
  return importRgbd(
      replay.get(), options.import, [&bar](uint32_t done, uint32_t total) { bar.show(done, total); }, summary);
}

MapId drawMapId(SecretRandom *random) {
  MapId id;
  for (uint8_t &byte : id) byte = static_cast<uint8_t>(random->below(256));
  return id;
}

struct Outcome {
  RgbdImportSummary import;
  size_t points = 0, bytes = 0;
  MapId map_id = {};
  std::string note;
  double seconds = 0;
};

Outcome build(const Options &options) {
  const auto start = std::chrono::steady_clock::now();
  Outcome outcome;
  // The key first: a key that cannot be read or written must not cost minutes of mapping.
  SecretRandom random(chooseKey(options));
  const PointModel model = importModel(options, &outcome.import);
  const auto strategy =
      options.fakes == "gaussian" ? gaussianFakes(options.sigma2) : patchworkFakes(options.patch_deg);
  OwnerNote note;
  const SphereCloud cloud = makeSphereCloud(model, options.cloud, *strategy, &random, &note.centre_in_world_m);
  note.map_id = drawMapId(&random);  // from the key too: the same recording, options and key give the same bytes
  note.eta = options.cloud.eta;
  note.strategy = strategy->name();
  const auto bytes = encodeMap(cloud, note.map_id);
  outcome.note = options.map + ".owner.json";
  writeFile(options.map, bytes);
  writeOwnerNote(outcome.note, note);
  outcome.map_id = note.map_id;
  outcome.points = cloud.points.size();
  outcome.bytes = bytes.size();
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

void warnOfFrames(const RgbdImportSummary &import, const Console &console) {
  const auto warn = [&console](uint32_t count, const char *what) {
    if (count) console.warn("note: " + std::to_string(count) + " frames " + what);
  };
  warn(import.frames_without_pose, "have no pose and took no part");
  warn(import.frames_unreadable, "could not be read and took no part");
}

void tell(const Options &options, const Outcome &outcome, const Console &console) {
  const RgbdImportSummary &import = outcome.import;
  console.say("Mapped " + std::to_string(import.frames_used) + " frames (" + describeSelection(options.recording) +
              ") in " + fixed(outcome.seconds, 1) + " s: " + std::to_string(import.points_kept) + " points kept, " +
              std::to_string(import.points_dropped) + " dropped.");
  console.say("Wrote " + options.map + ": " + std::to_string(outcome.points) + " directions, " +
              fixed(100 * options.cloud.eta, 0) + " % of them real, " +
              humanBytes(static_cast<double>(outcome.bytes)) + ".");
  console.say("Wrote " + outcome.note + ": where the centre is. Keep it, never ship it with the map.");
  if (!options.new_key.empty())
    console.say("Wrote " + options.new_key + ": the secret key. Keep it, never ship it.");
}

int run(const Options &options, const Console &console) {
  const Outcome outcome = build(options);
  warnOfFrames(outcome.import, console);
  tell(options, outcome, console);
  const RgbdImportSummary &import = outcome.import;
  console.give({{"map", options.map},
                {"map_id", hexText(outcome.map_id.data(), outcome.map_id.size())},
                {"owner_note", outcome.note},
                {"points", outcome.points},
                {"eta", options.cloud.eta},
                {"bytes", outcome.bytes},
                {"frames_used", import.frames_used},
                {"frames_without_pose", import.frames_without_pose},
                {"frames_unreadable", import.frames_unreadable},
                {"keypoints", import.keypoints},
                {"lifted", import.lifted},
                {"merged", import.merged},
                {"points_kept", import.points_kept},
                {"points_dropped", import.points_dropped},
                {"seconds", outcome.seconds}});
  return kExitDone;
}

const char kHelp[] =
    "Makes a sphere cloud, the map that a device carries, from frames with known poses: finds points seen in\n"
    "several frames, keeps of each only its direction from one centre, turns most of them into fakes, shuffles.";
const char kExample[] =
    "Example:\n"
    "  spherecloud build --recording walk --last 99 --map room.sphc\n"
    "  spherecloud build --recording kitchen --last 597 --map kitchen.sphc --eta 0.25 --new-key kitchen.key\n"
    "What comes out:\n"
    "  room.sphc               the map: ship it\n"
    "  room.sphc.owner.json    where the centre is in the recording's world: keep it, never ship it\n"
    "Without --key or --new-key the randomness is forgotten: nobody can make the same map again, you neither.";

void addOptions(CLI::App *app, Options *options) {
  addRecordingOptions(app, &options->recording);
  app->add_option("-m,--map", options->map, "Map file to write")->required()->type_name("FILE");
  app->add_option("--eta", options->cloud.eta, "Share of points that keep their true direction, (0, 1]")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 1.0))
      ->type_name("X");
  app->add_option("--fakes", options->fakes, "How fakes are made; gaussian is the paper's way")
      ->capture_default_str()
      ->check(CLI::IsMember({"patchwork", "gaussian"}))
      ->type_name("NAME");
  app->add_option("--patch-deg", options->patch_deg, "Width of a patch of patchwork, degrees")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 60.0))
      ->type_name("DEG");
  app->add_option("--sigma2", options->sigma2, "Variance of the noise that makes gaussian fakes")
      ->capture_default_str()
      ->check(CLI::Range(1e-9, 100.0))
      ->type_name("X");
  auto *key =
      app->add_option("--key", options->key, "Secret key to use (64 hexadecimal digits)")->type_name("FILE");
  app->add_option("--new-key", options->new_key, "Make a secret key, use it and write it here")
      ->type_name("FILE")
      ->excludes(key);
  const char *group = "Mapping";
  RgbdImportOptions &import = options->import;
  app->add_option("--max-keypoints", import.max_keypoints, "Strongest keypoints of a frame")
      ->capture_default_str()
      ->group(group);
  app->add_option("--min-observations", import.min_observations, "Frames that must agree on a point")
      ->capture_default_str()
      ->group(group);
  app->add_option("--depth-min", import.depth_min_m, "Nearest depth used, metres")
      ->capture_default_str()
      ->group(group);
  app->add_option("--depth-max", import.depth_max_m, "Farthest depth used, metres")
      ->capture_default_str()
      ->group(group);
}

}  // namespace

Command buildCommand(CLI::App *root) {
  auto options = std::make_shared<Options>();
  CLI::App *app = root->add_subcommand("build");
  app->description("Make a map from a recording with poses.\n\n" + std::string(kHelp));
  app->footer(kExample);
  addOptions(app, options.get());
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
