// spherecloud-lab map: maps of wanted sizes, to measure with.
#include <iterator>
#include <memory>

#include "host/base/usage_error.h"
#include "host/base/write_file.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/import_recording.h"
#include "host/cli/common/number_checks.h"
#include "host/publish/map_writer.h"
#include "host/publish/recognition.h"
#include "host/publish/release.h"
#include "host/publish/resized_model.h"
#include "host/report/file.h"
#include "lab/cli/commands.h"
#include "runtime/map/layout.h"

namespace sphc::host {
namespace {

// The points are no secret where the place itself is at hand; every run makes the same maps.
constexpr SecretKey kKey = {'b', 'e', 'n', 'c', 'h'};

struct MapOptions {
  RecordingOptions recording;
  std::vector<std::string> foreign, foreign_calibrations;
  std::vector<uint32_t> points;
  double eta = 1.0 / 3;
  std::string out;
  bool force = false;
};

std::vector<PointModel> importForeign(const MapOptions &options) {
  if (!options.foreign_calibrations.empty() && options.foreign_calibrations.size() != options.foreign.size())
    throw UsageError("give --foreign-calibration once for each --foreign, or not at all");
  std::vector<PointModel> models;
  for (size_t i = 0; i < options.foreign.size(); ++i) {
    RecordingOptions recording;
    recording.folder = options.foreign[i];
    if (!options.foreign_calibrations.empty()) recording.calibration = options.foreign_calibrations[i];
    models.push_back(importRecording(recording, "mapping   "));
  }
  return models;
}

// The model has been merged as a whole, and is of the wanted size.
std::string writeMap(const MapOptions &options, const PointModel &model) {
  const auto strategy = gaussianFakes();
  ReleaseRequest request;
  request.key = kKey;
  request.strategy = strategy.get();
  request.eta = options.eta;
  request.merge = false;
  const NewRelease made = makeRelease(model, request);
  const std::string path = options.out + "/map_" + std::to_string(model.points.size()) + ".sphc";
  writeFile(path, made.file);
  writeOwnerNote(path + ".owner.json",
                 {made.place.releases.back().map_id, made.place.centre_m, made.place.eta, made.place.strategy});
  return path;
}

int run(const MapOptions &options, const Console &console) {
  FileUse files(options.force);
  files.reads(options.recording);
  for (const std::string &path : options.foreign) files.reads("--foreign", path);
  for (const std::string &path : options.foreign_calibrations) files.reads("--foreign-calibration", path);
  files.writesFolder("--out", options.out, holds({std::begin(kMapMagic), std::end(kMapMagic)}));
  files.check();
  makeFolder(options.out);
  const PointModel own =
      withoutNearDuplicates(importRecording(options.recording, "mapping   "), kReleaseNearDuplicates);
  const std::vector<PointModel> foreign = importForeign(options);
  nlohmann::ordered_json maps = nlohmann::ordered_json::array();
  for (const uint32_t points : options.points) {
    SecretRandom random(kKey);
    const std::string path = writeMap(options, resizedModel(own, foreign, points, &random));
    const size_t own_points = std::min<size_t>(points, own.points.size());
    console.say("Wrote " + path + ": " + std::to_string(own_points) + " points of the place, " +
                std::to_string(points - own_points) + " foreign.");
    maps.push_back({{"map", path}, {"points", points}, {"own_points", own_points}});
  }
  console.give({{"maps", maps}, {"eta", options.eta}});
  return kExitDone;
}

const char kMapHelp[] =
    "Makes maps of exactly so many points from one recording: the points that most frames saw, or all and foreign\n"
    "ones, whose descriptors come from other recordings (--foreign) and from mirror images and negatives.  For\n"
    "measuring alone: the key is known to everybody.  docs/bench.md says more.";
const char kMapExample[] =
    "Example:\n"
    "  spherecloud-lab map --recording kitchen --last 597 --step 3 --points 10000 --points 50000 --out maps\n"
    "What comes out: maps/map_10000.sphc and maps/map_50000.sphc, each with its owner's note.";

void addOptions(CLI::App *app, MapOptions *options) {
  addRecordingOptions(app, &options->recording);
  app->add_option("-n,--points", options->points, "Points of a map; repeat for more maps")
      ->required()
      ->expected(1)
      ->take_all()
      ->check(CLI::Range(100u, 4000000u))
      ->type_name("N");
  app->add_option("--foreign", options->foreign, "Recording of another place, to take foreign points from; repeat")
      ->expected(1)
      ->take_all()
      ->type_name("DIR");
  app->add_option("--foreign-calibration", options->foreign_calibrations, "Its calibration [DIR/calibration.json]")
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
  app->add_option("--eta", options->eta, "Share of points that keep their true direction, (0, 1]")
      ->capture_default_str()
      ->check(between(1e-6, 1))
      ->type_name("X");
  app->add_option("-o,--out", options->out, "Folder for the maps")->required()->type_name("DIR");
}

}  // namespace

Command mapCommand(CLI::App *root) {
  auto options = std::make_shared<MapOptions>();
  CLI::App *app = root->add_subcommand("map");
  app->description("Maps of wanted sizes, to measure with.\n\n" + std::string(kMapHelp));
  app->footer(kMapExample);
  addOptions(app, options.get());
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
