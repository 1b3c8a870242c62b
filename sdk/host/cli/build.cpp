// spherecloud build: from a recording with poses to a sphere-cloud file.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "host/base/counted.h"
#include "host/base/hex_text.h"
#include "host/base/usage_error.h"
#include "host/base/write_file.h"
#include "host/cli/commands.h"
#include "host/cli/common/contradictions.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/light_options.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/point_source.h"
#include "host/evaluate/map_file.h"
#include "host/import/model_file.h"
#include "host/live/interrupt.h"
#include "host/publish/ledger.h"
#include "host/publish/map_writer.h"
#include "host/publish/release.h"
#include "host/report/file.h"

namespace sphc::host {
namespace {

struct BuildOptions {
  PointSource source;
  sphc_band band = SPHC_BAND_VISIBLE;  // of a recording or a COLMAP model
  std::string map, key, ledger, save_model;
  std::vector<std::string> against;
  std::optional<double> eta;
  std::string fakes;
  FakeOptions fake_options;
  bool new_place = false, understood = false, anyway = false, force = false;
};

std::string ledgerBesideMap(const BuildOptions &options) {
  return (std::filesystem::path(options.map).parent_path() / "spherecloud.ledger").string();
}

std::string ledgerPath(const BuildOptions &options) {
  if (!options.ledger.empty()) return options.ledger;
  return ledgerBesideMap(options);
}

// The ledger beside the map, of which this build knows nothing, is a second one of maybe the same places.
void warnOfOtherLedger(const BuildOptions &options, const Console &console) {
  const std::string beside = ledgerBesideMap(options);
  std::error_code error;
  const auto is_beside = [&](const std::string &path) { return std::filesystem::equivalent(path, beside, error); };
  const bool is_heeded = std::any_of(options.against.begin(), options.against.end(), is_beside);
  if (options.ledger.empty() || !std::filesystem::exists(beside, error) || is_beside(options.ledger) || is_heeded)
    return;
  console.warn(
      "Warning: " + beside +
      " lies beside the map, and --ledger names another: what it released is not "
      "heeded, and two maps of one place expose its points. Leave out --ledger for an update of a place of "
      "it, or give it by --against");
}

std::string notePath(const BuildOptions &options) { return options.map + ".owner.json"; }

std::optional<MapId> notedRelease(const std::string &note) {
  try {
    return readOwnerNote(note).map_id;
  } catch (const std::runtime_error &) {  // no note
    return {};
  }
}

// Whether a place, where that is known, released the map file or the map of the note.
bool didRelease(const Place &place, const std::string &map) { return releaseOf(place, readBytes(map)) != nullptr; }
bool didReleaseNoted(const Place &place, const std::string &note) {
  const std::optional<MapId> id = notedRelease(note);
  return id && std::any_of(place.releases.begin(), place.releases.end(),
                           [&id](const Release &release) { return release.map_id == *id; });
}
using DidRelease = bool(const Place &place, const std::string &path);
bool didAnyRelease(const std::vector<Place> &places, DidRelease *did_release, const std::string &path) {
  return std::any_of(places.begin(), places.end(), [&](const Place &place) { return did_release(place, path); });
}

// By any place of the ledger, which is not made for this.
IsOurs releasedByLedger(const BuildOptions &options, DidRelease *did_release) {
  return [ledger = ledgerPath(options), did_release](const std::string &path) {
    return std::filesystem::exists(ledger) && didAnyRelease(Ledger::openToRead(ledger).places(), did_release, path);
  };
}

FileUse fileUse(const BuildOptions &options) {
  FileUse files(options.force);
  files.reads(options.source.recording);
  files.reads("--colmap", options.source.colmap.model);
  files.reads("--images", options.source.colmap.images);
  files.reads("--database", options.source.colmap.database);
  files.reads("--depth", options.source.colmap.depth);
  files.reads("--model", options.source.model);
  files.reads("--key", options.key);
  for (const std::string &ledger : options.against) files.reads("--against", ledger);
  files.writes("--map", options.map, releasedByLedger(options, didRelease));
  files.writes("the owner's note", notePath(options), releasedByLedger(options, didReleaseNoted));
  files.writes("--save-model", options.save_model, isModelFile);
  files.keeps("--ledger", ledgerPath(options));
  return files;
}

std::vector<Place> placesOfOthers(const BuildOptions &options) {
  std::vector<Place> places;
  for (const std::string &path : options.against)
    for (Place &place : Ledger::openToRead(path).places()) places.push_back(std::move(place));
  return places;
}

// Where the ledger was lost, or an old copy of it came back, nothing else would stop a second map of the place.
void checkLedgerIsHere(const BuildOptions &options) {
  const std::string ledger = ledgerPath(options), note = notePath(options);
  if (options.understood || !notedRelease(note)) return;
  if (releasedByLedger(options, didReleaseNoted)(note)) return;
  if (didAnyRelease(placesOfOthers(options), didReleaseNoted, note)) return;
  const std::string why = std::filesystem::exists(ledger)
                              ? ledger + " does not know that release, being another ledger or an older one"
                              : "there is no " + ledger;
  throw std::runtime_error(options.map + " was released, as " + note +
                           " says, by a ledger that is not here: " + why +
                           ". A second, independent map of one place exposes the points that both have. Restore "
                           "the newest backup of the ledger, or give the right one by --ledger; for a map of "
                           "another place choose another name; or, if no copy of the map left the house, say "
                           "--i-understand, with --force to replace it");
}

// Releases of one place replace each other; those of another place are another map.
void checkSamePlace(const BuildOptions &options, const Place &place) {
  const auto check = [&](const std::string &path, DidRelease *did_release) {
    std::error_code error;
    const bool is_file =
        std::filesystem::is_regular_file(path, error) && std::filesystem::file_size(path, error) > 0;
    if (is_file && !options.force && !did_release(place, path))
      throw std::runtime_error(path + " belongs to another place of the ledger than this recording shows, place " +
                               std::to_string(place.number) + "; choose another name for its map");
  };
  check(options.map, didRelease);
  check(notePath(options), didReleaseNoted);
}

// Said before anything is recorded: what is, cannot be taken back.
void warnOfBarePoints(double eta, const std::string &fakes, const Console &console) {
  if (eta >= 1)
    console.warn(
        "Warning: at --eta 1 nothing is faked: every direction of the map shows a real point. Ship it only where "
        "anybody may know the place; else build without --eta, and if the ledger has this map already and no copy "
        "left the house, with --i-understand and another name for the map");
  else if (eta > 0.5 && fakes != "gaussian")
    console.warn("Warning: at --eta " + fixed(eta, 2) + " about " + fixed(100 * (2 - 1 / eta), 0) +
                 " % of the patches that are real have no fake on them, and show the place as it is; give an --eta "
                 "of at most 0.5");
}

// What is published cannot be taken back.
void checkContradictions(const BuildOptions &options, const ImportedPoints &imported) {
  if (imported.contradictions.empty() || options.anyway) return;
  throw std::runtime_error("this recording contradicts itself:" + contradictionLines(imported.contradictions) +
                           "\nNothing was published, since that could not be taken back. Correct it; "
                           "`spherecloud doctor --device replay:RECORDING` says more of the images. Or publish it "
                           "all the same with --anyway");
}

Ledger openLedger(const BuildOptions &options) {
  if (options.key.empty()) return Ledger::openOrMake(ledgerPath(options), nullptr);
  const SecretKey key = readSecretKey(options.key);
  return Ledger::openOrMake(ledgerPath(options), &key);
}

ReleaseRequest requestOf(const BuildOptions &options, const Ledger &ledger, const FakeStrategy *strategy) {
  ReleaseRequest request;
  request.own = ledger.places();
  request.foreign = placesOfOthers(options);
  request.key = ledger.key();
  request.strategy = strategy;
  request.eta = options.eta;
  request.new_place = options.new_place;
  request.understood = options.understood;
  request.time_s =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  return request;
}

struct Outcome {
  ImportedPoints import;
  Place place;
  ReleaseSummary release;
  size_t bytes = 0;
  std::string note, ledger;
  double seconds = 0;
};

Outcome build(const BuildOptions &options, const Console &console) {
  const auto start = std::chrono::steady_clock::now();
  Outcome outcome;
  // What can be refused at once must not cost minutes of mapping, or leave a ledger.
  checkPointSource(options.source);
  checkLedgerIsHere(options);
  fileUse(options).check();
  warnOfOtherLedger(options, console);
  const auto strategy = options.fakes.empty() ? nullptr : makeFakes(options.fakes, options.fake_options);
  if (options.eta) warnOfBarePoints(*options.eta, options.fakes.empty() ? kDefaultFakes : options.fakes, console);
  const Interrupt interrupt;  // from before there is a ledger
  Ledger ledger = openLedger(options);
  const ReleaseRequest request = requestOf(options, ledger, strategy.get());
  outcome.import = importPoints(options.source, interrupt, console);
  interrupt.throwIfCame();  // after the last frame
  for (const std::string &doubt : outcome.import.doubts) console.warn("Warning: " + doubt);
  checkContradictions(options, outcome.import);
  if (options.source.model.empty()) outcome.import.model.band = options.band;
  if (!options.save_model.empty()) writeModelFile(options.save_model, outcome.import.model);
  NewRelease made = makeRelease(std::move(outcome.import.model), request);
  checkSamePlace(options, made.place);
  if (!options.eta) warnOfBarePoints(made.place.eta, made.place.strategy, console);
  interrupt.throwIfCame();  // the last time: what is recorded is brought to its end
  // The ledger first: what it does not know was never published.
  ledger.record(made.place);
  outcome.note = notePath(options);
  writeFile(options.map, made.file);
  writeOwnerNote(outcome.note,
                 {made.place.releases.back().map_id, made.place.centre_m, made.place.eta, made.place.strategy});
  outcome.place = std::move(made.place);
  outcome.release = made.summary;
  outcome.ledger = ledgerPath(options);
  outcome.bytes = made.file.size();
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

std::string releaseText(const Outcome &outcome) {
  const ReleaseSummary &release = outcome.release;
  const auto count = [](size_t n, const char *what) { return std::to_string(n) + what; };
  std::string text = "Place " + std::to_string(outcome.place.number) + " of the ledger, release " +
                     std::to_string(outcome.place.releases.size());
  if (release.is_same) text += ", as it was";
  text += ": " + counted(release.added, "new point");
  if (release.is_update) text += ", " + count(release.known, " known, ") + count(release.ambiguous, " doubtful");
  if (release.elsewhere) text += ", " + count(release.elsewhere, " published in other maps and left out");
  if (release.held_back) text += ", " + count(release.held_back, " held back, too few to hide among each other");
  return text + "; " + counted(release.near_duplicates, "near-duplicate") + " merged.";
}

void tell(const BuildOptions &options, const Outcome &outcome, const Console &console) {
  for (const std::string &warning : outcome.import.warnings) console.warn("note: " + warning);
  console.say(outcome.import.told + " " + fixed(outcome.seconds, 1) + " s.");
  console.say(releaseText(outcome));
  console.say("Wrote " + options.map + ": " + counted(outcome.place.points.size(), "direction") + ", " +
              fixed(100 * outcome.place.eta, 0) + " % of them real, " +
              humanBytes(static_cast<double>(outcome.bytes)) + ".");
  if (!options.save_model.empty())
    console.say("Wrote " + options.save_model + ": where every point is. Keep it, never ship it.");
  console.say("Wrote " + outcome.note + ": where the centre is. Keep it, never ship it with the map.");
  console.say("Wrote " + outcome.ledger +
              ": the secret key and all that was released. Keep it and back it up, never ship it.");
}

nlohmann::ordered_json releaseJson(const Outcome &outcome) {
  const ReleaseSummary &release = outcome.release;
  const Similarity &place_from_world = release.place_from_world;
  double q_wxyz[4];
  quaternionFromRotation(place_from_world.rotation, q_wxyz);
  const Vector3 &t = place_from_world.translation_m;
  return {{"place", outcome.place.number},
          {"release", outcome.place.releases.size()},
          {"update", release.is_update},
          {"same_as_before", release.is_same},
          {"near_duplicates", release.near_duplicates},
          {"known", release.known},
          {"doubtful", release.ambiguous},
          {"elsewhere", release.elsewhere},
          {"held_back", release.held_back},
          {"added", release.added},
          {"place_from_world",
           {{"scale", place_from_world.scale},
            {"q_wxyz", {q_wxyz[0], q_wxyz[1], q_wxyz[2], q_wxyz[3]}},
            {"t_m", {t.x(), t.y(), t.z()}}}}};
}

void checkFakes(const CLI::App &app, const std::string &fakes) {
  const bool is_gaussian = fakes == "gaussian";
  const char *stray = is_gaussian ? "--patch-deg" : "--sigma2";
  if (app.count(stray) > 0)
    throw UsageError(std::string(stray) + " says nothing of --fakes " + fakes + "; leave it out, or give " +
                     (is_gaussian ? "--sigma2" : "--patch-deg"));
}

int run(const CLI::App &app, const BuildOptions &options, const Console &console) {
  checkFakes(app, options.fakes);
  const Outcome outcome = build(options, console);
  const MapId &map_id = outcome.place.releases.back().map_id;
  if (options.understood) console.warn("note: --i-understand: points that other maps hold too are now exposed");
  tell(options, outcome, console);
  nlohmann::ordered_json json = {{"map", options.map},
                                 {"map_id", hexText(map_id.data(), map_id.size())},
                                 {"owner_note", outcome.note},
                                 {"ledger", outcome.ledger},
                                 {"points", outcome.place.points.size()},
                                 {"eta", outcome.place.eta},
                                 {"band", bandName(outcome.place.band)},
                                 {"bytes", outcome.bytes},
                                 {"release", releaseJson(outcome)}};
  if (!options.save_model.empty()) json["saved_model"] = options.save_model;
  json.update(outcome.import.facts);
  json["seconds"] = outcome.seconds;
  console.give(json);
  return kExitDone;
}

const char kBuildHelp[] =
    "Makes a sphere cloud, the map that a device carries, from frames with known poses: finds points seen in\n"
    "several frames, keeps of each only its direction from one centre, turns most of them into fakes, shuffles.\n"
    "A place that the ledger knows is updated: what was published of it stays as it is, new points are added.";
const char kBuildExample[] =
    "Example:\n"
    "  spherecloud build --recording walk --last 99 --map room.sphc\n"
    "  spherecloud build --colmap sparse/0 --images images --depth depth --calibration kinect.json --map "
    "room.sphc\n"
    "  spherecloud build --recording kitchen --last 597 --map kitchen.sphc --eta 0.25\n"
    "  spherecloud build --recording walk --map room.sphc --save-model room.model\n"
    "  spherecloud build --model room.model --map room.sphc   the same map, without mapping again\n"
    "What comes out:\n"
    "  room.sphc               the map: ship it\n"
    "  room.sphc.owner.json    where the centre is in the recording's world: keep it, never ship it\n"
    "  spherecloud.ledger      the secret key, and what was ever released: keep it, back it up, never ship it\n"
    "Never publish two independent maps of one place: docs/release.md.";

void addReleaseOptions(CLI::App *app, BuildOptions *options) {
  const char *group = "Release";
  app->add_option("--ledger", options->ledger, "What was released [spherecloud.ledger in the map's folder]")
      ->type_name("FILE")
      ->group(group);
  app->add_option("--key", options->key, "Secret key for a new ledger (64 hexadecimal digits) [drawn]")
      ->type_name("FILE")
      ->group(group);
  app->add_option("--against", options->against,
                  "Ledger of others whose places must not be published again; repeat")
      ->expected(1)
      ->take_all()
      ->type_name("FILE")
      ->group(group);
  app->add_flag("--new-place", options->new_place, "No update: a new map, of what was never published")
      ->group(group);
  app->add_flag("--i-understand", options->understood, "Publish known points anew, which exposes them")
      ->group(group);
  app->add_flag("--anyway", options->anyway, "Publish a recording that contradicts itself")->group(group);
  addForceOption(app, &options->force);
}

void addOptions(CLI::App *app, BuildOptions *options) {
  addPointSourceOptions(app, &options->source);
  app->add_option("-m,--map", options->map, "Map file to write")->required()->type_name("FILE");
  addBandOption(app, &options->band, "The light of the images; a camera must see the same to localize in the map")
      ->excludes(app->get_option("--model"));
  app->add_option("--save-model", options->save_model,
                  "Private file for the points, to make a map of them again with --model")
      ->excludes(app->get_option("--model"))
      ->type_name("FILE");
  app->add_option("--eta", options->eta, "Share of points that keep their true direction, (0, 1] [1/3]")
      ->check(between(1e-6, 1))
      ->type_name("X");
  CLI::Option *fakes =
      app->add_option("--fakes", options->fakes,
                      std::string("Fakes: patchwork and warped are hard to tell, gaussian is the paper's way [") +
                          kDefaultFakes + ", or as the place was released]")
          ->check(CLI::IsMember(fakeNames()))
          ->type_name("NAME");
  app->add_option("--patch-deg", options->fake_options.patch_deg,
                  "Width of a patch of patchwork and warped, degrees")
      ->capture_default_str()
      ->check(between(2, 60))
      ->needs(fakes)
      ->type_name("DEG");
  app->add_option("--sigma2", options->fake_options.sigma2, "Variance of the noise that makes gaussian fakes")
      ->capture_default_str()
      ->check(between(1e-9, 100))
      ->needs(fakes)
      ->type_name("X");
  addReleaseOptions(app, options);
}

}  // namespace

Command buildCommand(CLI::App *root) {
  auto options = std::make_shared<BuildOptions>();
  CLI::App *app = root->add_subcommand("build");
  app->description("Make a map from a recording with poses.\n\n" + std::string(kBuildHelp));
  app->footer(kBuildExample);
  addOptions(app, options.get());
  return {app, [app, options](const Console &console) { return run(*app, *options, console); }};
}

}  // namespace sphc::host
