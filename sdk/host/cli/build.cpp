// spherecloud build: from a recording with poses to a sphere-cloud file.
#include <chrono>
#include <memory>

#include "host/build/map_writer.h"
#include "host/build/secret_random.h"
#include "host/build/sphere_cloud.h"
#include "host/cli/command.h"
#include "host/cli/exit_code.h"
#include "host/cli/map_file.h"
#include "host/cli/point_source.h"

namespace sphc::host {
namespace {

struct Options {
  PointSource source;
  std::string map, key, new_key;
  SphereCloudOptions cloud;
  double sigma2 = 0.1;
};

SecretKey chooseKey(const Options &options) {
  if (!options.key.empty()) return readSecretKey(options.key);
  const SecretKey key = newSecretKey();
  if (!options.new_key.empty()) writeSecretKey(options.new_key, key);
  return key;
}

MapId drawMapId(SecretRandom *random) {
  MapId id;
  for (uint8_t &byte : id) byte = static_cast<uint8_t>(random->below(256));
  return id;
}

struct Outcome {
  ImportedPoints import;
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
  outcome.import = importPoints(options.source);
  const auto strategy = gaussianFakes(options.sigma2);
  OwnerNote note;
  const SphereCloud cloud =
      makeSphereCloud(outcome.import.model, options.cloud, *strategy, &random, &note.centre_in_world_m);
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

void tell(const Options &options, const Outcome &outcome, const Console &console) {
  for (const std::string &warning : outcome.import.warnings) console.warn("note: " + warning);
  console.say(outcome.import.told + " " + fixed(outcome.seconds, 1) + " s.");
  console.say("Wrote " + options.map + ": " + std::to_string(outcome.points) + " directions, " +
              fixed(100 * options.cloud.eta, 0) + " % of them real, " +
              humanBytes(static_cast<double>(outcome.bytes)) + ".");
  console.say("Wrote " + outcome.note + ": where the centre is. Keep it, never ship it with the map.");
  if (!options.new_key.empty())
    console.say("Wrote " + options.new_key + ": the secret key. Keep it, never ship it.");
}

int run(const Options &options, const Console &console) {
  const Outcome outcome = build(options);
  tell(options, outcome, console);
  nlohmann::ordered_json json = {
      {"map", options.map},         {"map_id", hexText(outcome.map_id.data(), outcome.map_id.size())},
      {"owner_note", outcome.note}, {"points", outcome.points},
      {"eta", options.cloud.eta},   {"bytes", outcome.bytes}};
  json.update(outcome.import.facts);
  json["seconds"] = outcome.seconds;
  console.give(json);
  return kExitDone;
}

const char kHelp[] =
    "Makes a sphere cloud, the map that a device carries, from frames with known poses: finds points seen in\n"
    "several frames, keeps of each only its direction from one centre, turns most of them into fakes, shuffles.";
const char kExample[] =
    "Example:\n"
    "  spherecloud build --recording walk --last 99 --map room.sphc\n"
    "  spherecloud build --colmap sparse/0 --images images --depth depth --calibration kinect.json --map "
    "room.sphc\n"
    "  spherecloud build --recording kitchen --last 597 --map kitchen.sphc --eta 0.25 --new-key kitchen.key\n"
    "What comes out:\n"
    "  room.sphc               the map: ship it\n"
    "  room.sphc.owner.json    where the centre is in the recording's world: keep it, never ship it\n"
    "Without --key or --new-key the randomness is forgotten: nobody can make the same map again, you neither.";

void addOptions(CLI::App *app, Options *options) {
  addPointSourceOptions(app, &options->source);
  app->add_option("-m,--map", options->map, "Map file to write")->required()->type_name("FILE");
  app->add_option("--eta", options->cloud.eta, "Share of points that keep their true direction, (0, 1]")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 1.0))
      ->type_name("X");
  app->add_option("--sigma2", options->sigma2, "Variance of the noise that makes fake directions")
      ->capture_default_str()
      ->check(CLI::Range(1e-9, 100.0))
      ->type_name("X");
  auto *key =
      app->add_option("--key", options->key, "Secret key to use (64 hexadecimal digits)")->type_name("FILE");
  app->add_option("--new-key", options->new_key, "Make a secret key, use it and write it here")
      ->type_name("FILE")
      ->excludes(key);
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
