// spherecloud inspect: a map file in detail.
#include <memory>
#include <stdexcept>

#include "host/base/counted.h"
#include "host/base/usage_error.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/trust_options.h"
#include "host/evaluate/map_anatomy.h"
#include "host/report/direction_picture.h"
#include "host/report/picture_file.h"
#include "host/report/table.h"

namespace sphc::host {
namespace {

struct InspectOptions {
  std::string map, picture;
  TrustOptions trust;
  bool no_picture = false, force = false;
};

std::string percentText(double value) { return fixed(value, 1) + " %"; }

void tell(const MapFacts &facts, const MapAnatomy &anatomy, const Console &console) {
  console.say(facts.path + ": a valid sphere cloud of " + counted(facts.points, "point") + ", id " + facts.id);
  std::vector<Row> parts;
  for (const BytePart &part : anatomy.parts) {
    parts.push_back({part.name, std::to_string(part.bytes),
                     percentText(100.0 * static_cast<double>(part.bytes) / static_cast<double>(facts.file_bytes))});
  }
  console.say("\nBytes\n" + tableText(parts));
  console.say(
      "Directions\n" +
      tableText(
          {{"nearest neighbour", fixed(anatomy.nearest_median_deg, 2) + " deg",
            "median; for 10 % it is within " + fixed(anatomy.nearest_p10_deg, 2) + " deg"},
           {"sky covered", percentText(anatomy.covered_percent), "of 800 cells of equal area hold a direction"},
           {"lopsidedness", fixed(anatomy.lopsidedness, 2), "0: all around the centre; 1: all the same way"}}));
  console.say(
      "Descriptors\n" +
      tableText({{"length", fixed(anatomy.length_mean, 1), "mean; sigma " + fixed(anatomy.length_sigma, 1)},
                 {"bytes that are 0", percentText(anatomy.zero_percent), ""},
                 {"bytes at the 255 limit", percentText(anatomy.saturated_percent), ""},
                 {"doubles", std::to_string(anatomy.doubles), "descriptors that are there more than once"}}));
}

nlohmann::ordered_json json(const MapFacts &facts, const MapAnatomy &anatomy) {
  nlohmann::ordered_json value = {{"map", facts.path},
                                  {"valid", true},
                                  {"points", facts.points},
                                  {"bytes", facts.file_bytes},
                                  {"map_id", facts.id},
                                  {"format_version", facts.format_version},
                                  {"extractor", facts.extractor},
                                  {"band", bandName(facts.band)},
                                  {"parts", nlohmann::ordered_json::object()}};
  for (const BytePart &part : anatomy.parts) value["parts"][part.name] = part.bytes;
  value["directions"] = {{"nearest_median_deg", anatomy.nearest_median_deg},
                         {"nearest_p10_deg", anatomy.nearest_p10_deg},
                         {"covered_percent", anatomy.covered_percent},
                         {"lopsidedness", anatomy.lopsidedness}};
  value["descriptors"] = {{"length_mean", anatomy.length_mean},
                          {"length_sigma", anatomy.length_sigma},
                          {"zero_percent", anatomy.zero_percent},
                          {"saturated_percent", anatomy.saturated_percent},
                          {"doubles", anatomy.doubles}};
  return value;
}

std::string picturePath(const InspectOptions &options) {
  if (options.no_picture) return "";
  return options.picture.empty() ? options.map + ".directions.png" : options.picture;
}

// One that nobody asked for is left out where it cannot be.
std::string checkedPicture(const InspectOptions &options, const Console &console) {
  const std::string path = picturePath(options);
  FileUse files(options.force);
  files.reads("the map", options.map);
  readsTrust(options.trust, &files);
  files.writes("--picture", path, holds(kPictureMark));
  try {
    files.check();
  } catch (const UsageError &) {
    throw;
  } catch (const std::runtime_error &error) {
    if (!options.picture.empty()) throw;
    console.warn(std::string("note: no picture is made. ") + error.what());
    return "";
  }
  return path;
}

int inspect(const InspectOptions &options, const Console &console) {
  const std::string path = checkedPicture(options, console);
  const MapFile file = openMapFile(options.map, trustOf(options.trust));
  const MapFacts facts = mapFacts(file, options.map);
  const MapAnatomy anatomy = dissect(file, facts);
  double peak = 0;
  if (!path.empty()) writePicture(path, drawDirections(facts.directions, &peak));  // before words, as in localize
  tell(facts, anatomy, console);
  nlohmann::ordered_json value = json(facts, anatomy);
  if (!path.empty()) {
    console.say("Picture of the directions, as a map of the sky: " + path + "\n  (the brightest spot is " +
                fixed(peak, 1) + " times denser than an even spread)");
    value["picture"] = path;
    value["directions"]["peak_density"] = peak;
  }
  console.give(value);
  return kExitDone;
}

}  // namespace

Command inspectCommand(CLI::App *root) {
  auto options = std::make_shared<InspectOptions>();
  CLI::App *app = root->add_subcommand("inspect");
  app->description(
      "Show a map file in detail, with a picture.\n\nChecks a map file and shows what an outsider can see in it: "
      "where its bytes go, how its directions\n"
      "are spread, what its descriptors are like, and a picture of the sky of directions.");
  app->footer(
      "Example:\n  spherecloud inspect room.sphc\nWhat comes out: three small tables, and "
      "room.sphc.directions.png.");
  app->add_option("map", options->map, "Map file")->required()->type_name("FILE");
  auto *picture = app->add_option("--picture", options->picture, "Where the picture goes [FILE.directions.png]")
                      ->type_name("PNG");
  app->add_flag("--no-picture", options->no_picture, "No picture")->excludes(picture);
  addTrustOptions(app, &options->trust);
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return inspect(*options, console); }};
}

}  // namespace sphc::host
