// spherecloud info: what a map file's header says.
#include <memory>

#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/evaluate/map_file.h"
#include "host/report/table.h"

namespace sphc::host {
namespace {

int info(const std::string &path, const Console &console) {
  const MapFile file = openMapFile(path);
  const MapFacts facts = mapFacts(file, path);
  console.say(path + ": a valid sphere cloud");
  console.say(
      tableText({{"points, real and fake", std::to_string(facts.points), "the file does not tell them apart"},
                 {"size", humanBytes(static_cast<double>(facts.file_bytes)),
                  fixed(static_cast<double>(facts.file_bytes) / facts.points, 1) + " bytes a point"},
                 {"format version", std::to_string(facts.format_version), ""},
                 {"extractor", std::to_string(facts.extractor), "what described the points"},
                 {"band", bandName(facts.band), "the light of its images"},
                 {"map id", facts.id, ""}}));
  console.give({{"map", path},
                {"valid", true},
                {"points", facts.points},
                {"bytes", facts.file_bytes},
                {"format_version", facts.format_version},
                {"extractor", facts.extractor},
                {"band", bandName(facts.band)},
                {"map_id", facts.id}});
  return kExitDone;
}

}  // namespace

Command infoCommand(CLI::App *root) {
  auto path = std::make_shared<std::string>();
  CLI::App *app = root->add_subcommand("info");
  app->description(
      "What a map file is, on one screen.\n\nChecks a map file, every byte of it, and prints what it is.  See "
      "also: spherecloud inspect.");
  app->footer("Example:\n  spherecloud info room.sphc\n  spherecloud info room.sphc --json");
  app->add_option("map", *path, "Map file")->required()->type_name("FILE");
  return {app, [path](const Console &console) { return info(*path, console); }};
}

}  // namespace sphc::host
