// spherecloud audit: attacks a map before others do.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "host/audit/report/networks.h"
#include "host/audit/report/page.h"
#include "host/audit/score/look_around.h"
#include "host/audit/score/map_audit.h"
#include "host/base/usage_error.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/import_recording.h"
#include "host/cli/common/privacy_results.h"
#include "host/cli/common/progress.h"
#include "host/evaluate/map_file.h"
#include "host/publish/ledger.h"
#include "host/report/table.h"

namespace sphc::host {
namespace {

struct Options {
  std::string map, truth, report, figures, name, networks;
  RecordingOptions recording;
  std::vector<std::string> releases, limits;
  uint32_t queries = 10;
  bool quick = false, force = false;
};

FileUse fileUse(const Options &options) {
  FileUse files(options.force);
  files.reads("the map", options.map);
  files.reads("--truth", options.truth);
  files.reads(options.recording);
  for (const std::string &release : options.releases) files.reads("--release", release);
  files.reads("--networks", options.networks);
  files.writesFolder("--report", options.report, holds("<title>Audit of "));
  files.writes("--figures", options.figures, holds(kPrivacyHead));
  return files;
}

// The place of the ledger that released this file.
Place placeOf(const Options &options, const std::vector<uint8_t> &file) {
  for (const Place &place : Ledger::openToRead(options.truth).places()) {
    const Release *released = releaseOf(place, file);
    if (!released) continue;
    Place then = place;
    then.points.resize(released->points);
    return then;
  }
  throw std::runtime_error("ledger " + options.truth + " did not release " + options.map +
                           "; give the ledger it was built with, and the file as it was built");
}

std::vector<InversionView> viewsOf(const Options &options, const Place &place) {
  return viewsFromCentre(openRecording(options.recording).get(), place.centre_m);
}

std::vector<uint8_t> readMap(const std::string &path) {
  checkIsFile(path);
  return readMapFile(path);
}

MapAuditInput inputOf(const Options &options) {
  MapAuditInput input;
  input.file = readMap(options.map);
  input.quick = options.quick;
  for (const std::string &release : options.releases) input.releases.push_back(readMap(release));
  if (options.truth.empty()) return input;
  input.networks = options.networks.empty() ? auditNetworks() : options.networks;
  input.place = placeOf(options, input.file);
  if (options.recording.folder.empty()) return input;
  input.views = viewsOf(options, *input.place);
  for (PointModel &frame : importFrames(options.recording, options.queries, "querying  "))
    input.queries.push_back(std::move(frame.points));
  return input;
}

std::map<std::string, double> limitsOf(const Options &options) {
  auto limits = defaultAuditLimits();
  for (const std::string &text : options.limits) {
    const size_t equals = text.find('=');
    try {
      size_t used = 0;
      const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
      const double value = std::stod(number, &used);
      if (used != number.size() || !(value == value)) throw std::invalid_argument(number);
      limits[text.substr(0, equals)] = value;
    } catch (const std::logic_error &) {
      throw UsageError("--limit " + text + " is not NAME=NUMBER, as in --limit real_or_fake.auc=0.55");
    }
  }
  return limits;
}

// For a ledger of figures.
std::vector<PrivacyRow> rowsOf(const Options &options, const MapAudit &audit, const MapAuditInput &input) {
  const std::string name = options.name.empty() ? std::filesystem::path(options.map).stem().string() : options.name;
  std::vector<PrivacyRow> rows;
  for (const AuditFigure &figure : audit.figures) {
    if (!figure.value) continue;
    rows.push_back({"audit", name, input.place ? input.place->strategy : "unknown",
                    input.place ? input.place->eta : 0, figure.remark, figure.name, *figure.value});
  }
  return rows;
}

void tell(const MapAudit &audit, const std::string &page, const Console &console) {
  std::vector<Row> rows;
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  for (const AuditFigure &figure : audit.figures) {
    const std::string limit =
        figure.limit ? (figure.at_most ? ", at most " : ", at least ") + fixed(*figure.limit, 2) : "";
    const std::string remark = figure.remark.empty() ? "" : " (" + figure.remark + ")";
    rows.push_back({figure.name, figure.value ? fixed(*figure.value, 3) : "-",
                    wordFor(figure.verdict()) + limit + ": " + figure.about + remark});
    nlohmann::ordered_json json = {{"name", figure.name}, {"verdict", wordFor(figure.verdict())}};
    if (figure.value) json["value"] = *figure.value;
    if (figure.limit) json["limit"] = *figure.limit;
    if (!figure.remark.empty()) json["remark"] = figure.remark;
    figures.push_back(json);
  }
  console.say(tableText(rows));
  if (!page.empty()) console.say("Report: " + page);
  console.say(audit.holds() ? "Every limit that was measured holds."
                            : "A limit is broken: do not release this map.");
  nlohmann::ordered_json inversions = nlohmann::ordered_json::array();
  for (const InversionResult &result : audit.inversions)
    inversions.push_back({{"points", result.name},
                          {"views", result.pictures.size()},
                          {"retrieval_coarse", result.coarse.top1},
                          {"retrieval_fine", result.fine.top1}});
  console.give({{"holds", audit.holds()}, {"figures", figures}, {"inversions", inversions}, {"report", page}});
}

int run(const Options &options, const Console &console) {
  if (options.truth.empty() && !options.recording.folder.empty())
    throw UsageError("--recording tells nothing without --truth; give the ledger too");
  const auto limits = limitsOf(options);
  fileUse(options).check();
  const MapAuditInput input = inputOf(options);
  ProgressBar bar("auditing  ");
  uint32_t done = 0;
  const MapAudit audit = auditMap(input, limits, [&](const std::string &) {
    bar.show(done, std::max(done + 1, 6 + static_cast<uint32_t>(input.releases.size())));
    ++done;
  });
  bar.show(1, 1);
  const std::string page = options.report.empty() ? "" : writeAuditPage(options.report, options.map, audit);
  if (!options.figures.empty()) updatePrivacyResults(options.figures, rowsOf(options, audit, input));
  tell(audit, page, console);
  return audit.holds() ? kExitDone : kExitAuditFailed;
}

const char kHelp[] =
    "Runs the attacks that are known against a map file and scores them by what its owner knows: density of\n"
    "lines, real against fake, inverted pictures, other releases, a querying client.  Ends with status 4 when a\n"
    "limit is broken, so that a release stops there.";
const char kExample[] =
    "Example:\n"
    "  spherecloud audit room.sphc --truth spherecloud.ledger --recording walk --last 99 --report audit\n"
    "  spherecloud audit room.sphc --quick                    what an attacker can do without the truth\n"
    "  spherecloud audit room2.sphc --truth spherecloud.ledger --release room.sphc --limit real_or_fake.auc=0.55\n"
    "Without --recording the truth of pictures is what a network paints of the unprotected points.\n"
    "More: docs/audit.md";

}  // namespace

Command auditCommand(CLI::App *root) {
  auto options = std::make_shared<Options>();
  CLI::App *app = root->add_subcommand("audit");
  app->description("Attack a map before others do.\n\n" + std::string(kHelp));
  app->footer(kExample);
  app->add_option("map", options->map, "Map file")->required()->type_name("MAP");
  app->add_option("--truth", options->truth, "Ledger that released the map")->type_name("FILE");
  addRecordingOptions(app, &options->recording);
  app->get_option("--recording")->required(false);
  app->add_option("--release", options->releases, "Other maps of the place that were published")->type_name("MAP");
  app->add_option("--queries", options->queries, "Frames of a client")->capture_default_str()->type_name("N");
  app->add_option("--limit", options->limits, "Another limit: NAME=NUMBER")->type_name("NAME=X");
  app->add_option("--report", options->report, "Folder for a page with pictures")->type_name("FOLDER");
  app->add_option("--figures", options->figures, "Write the figures into this table too")->type_name("CSV");
  app->add_option("--name", options->name, "Of the map, in that table [the file's]")->type_name("NAME");
  app->add_option("--networks", options->networks, "Folder of the attackers' networks [the command's own]")
      ->type_name("FOLDER");
  app->add_flag("--quick", options->quick, "Fewer lines and views: within half a minute");
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
