// spherecloud audit: attacks a map before others do.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "host/audit/report/networks.h"
#include "host/audit/report/page.h"
#include "host/audit/score/centre_views.h"
#include "host/audit/score/map_audit.h"
#include "host/base/usage_error.h"
#include "host/base/write_file.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/import_recording.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/privacy_results.h"
#include "host/cli/common/progress.h"
#include "host/evaluate/map_file.h"
#include "host/publish/ledger.h"
#include "host/publish/recognition.h"
#include "host/report/table.h"

namespace sphc::host {
namespace {

// Of what the mapping recording's frames show, the map has several times as much.
constexpr double kLeastKnown = 0.05;

struct AuditOptions {
  std::string map, truth, report, figures, name, networks;
  RecordingOptions recording, photos;
  bool has_photos = false;
  std::vector<std::string> releases, limits, allow_unmeasured, only;
  uint32_t queries = 10;
  bool quick = false, force = false;
};

FileUse fileUse(const AuditOptions &options) {
  FileUse files(options.force);
  files.reads("the map", options.map);
  files.reads("--truth", options.truth);
  files.reads(options.recording);
  files.reads("--photos", options.photos.folder);
  for (const std::string &release : options.releases) files.reads("--release", release);
  files.reads("--networks", options.networks);
  files.writesFolder("--report", options.report, holds("<title>Audit of "));
  files.writes("--figures", options.figures, holds(kPrivacyHead));
  return files;
}

// The place of the ledger that released this file, as it was then, and what else shows its points.
void readTruth(const AuditOptions &options, AuditInput *input) {
  const std::vector<Place> places = Ledger::openToRead(options.truth).places();
  for (const Place &place : places) {
    const Release *released = releaseOf(place, input->file);
    if (!released) continue;
    input->place = place;
    input->place->points.resize(released->points);
    for (const Place &other : places)
      if (other.number != place.number && shareAPoint(other, *input->place))
        input->other_releases.insert(input->other_releases.end(), other.releases.begin(), other.releases.end());
    return;
  }
  throw std::runtime_error("ledger " + options.truth + " did not release " + options.map +
                           "; give the ledger it was built with, and the file as it was built");
}

std::vector<InversionView> viewsOf(const AuditOptions &options, const Place &place) {
  ProgressBar bar("looking   ");
  return viewsFromCentre(openRecording(options.recording).get(), place.centre_m,
                         [&bar](uint32_t done, uint32_t total) { bar.show(done, total); });
}

// What is no map is refused by its name, and before the attacks.
std::vector<uint8_t> readMap(const std::string &path) {
  std::vector<uint8_t> bytes = readMapFile(path);
  checkIsNotEncrypted(path, bytes.data(), bytes.size());
  try {
    publishedIn(bytes);
  } catch (const std::runtime_error &error) {
    throw std::runtime_error(path + ": " + error.what());
  }
  return bytes;
}

// Beside itself a map gives nothing away, so every limit would hold.
std::vector<std::vector<uint8_t>> readReleases(const AuditOptions &options, const std::vector<uint8_t> &map) {
  std::vector<std::vector<uint8_t>> releases;
  for (const std::string &path : options.releases) {
    releases.push_back(readMap(path));
    if (releases.back() == map)
      throw std::runtime_error(
          "--release " + path +
          " is the map that is audited; give the other releases of the place, or leave it out");
  }
  return releases;
}

// In another world, or of another place, it says nothing of the map, and pictures would not be told.
void checkWorld(const std::string &option, const std::string &folder, const Place &place,
                const std::vector<PointModel> &frames, const char *cure) {
  size_t seen = 0, known = 0;
  for (const PointModel &frame : frames) {
    seen += frame.points.size();
    known += knownInPlaceFrame(place, frame);
  }
  if (seen > 0 && static_cast<double>(known) >= kLeastKnown * static_cast<double>(seen)) return;
  throw std::runtime_error(option + ": of " + std::to_string(seen) + " points that " + folder + " shows, " +
                           std::to_string(known) + " lie where the ledger has them; " + cure);
}

std::string networksOf(const AuditOptions &options) {
  if (!options.networks.empty() && !std::filesystem::is_directory(options.networks))
    throw std::runtime_error("--networks " + options.networks +
                             " is not a folder; give the one with *.onnx and *.json");
  return options.networks.empty() ? auditNetworks() : options.networks;
}

bool isRun(const std::string &attack, const AuditOptions &options) {
  return options.only.empty() || std::find(options.only.begin(), options.only.end(), attack) != options.only.end();
}

// By the recording's camera, and where nothing else is said, of the recording itself.
RecordingOptions photosOf(const AuditOptions &options) {
  RecordingOptions photos = options.photos;
  if (photos.folder.empty()) {
    photos.folder = options.recording.folder;
    photos.poses = options.recording.poses;
  }
  photos.calibration = options.recording.calibration;
  photos.pose_gap_ms = options.recording.pose_gap_ms;
  return photos;
}

std::vector<PointModel> readPhotos(const AuditOptions &options, const Place &place, const Console &console) {
  const RecordingOptions photos = photosOf(options);
  std::vector<PointModel> frames;
  try {
    frames = importFrames(photos, options.queries, "photos    ", console);
  } catch (const std::runtime_error &error) {
    throw std::runtime_error(std::string("--photos: ") + error.what());
  }
  checkWorld("--photos", photos.folder, place, frames, "give frames of the place, posed in the recording's world");
  return frames;
}

AuditInput inputOf(const AuditOptions &options, const Console &console) {
  AuditInput input;
  input.file = readMap(options.map);
  input.quick = options.quick;
  input.releases = readReleases(options, input.file);
  input.networks = networksOf(options);
  if (options.truth.empty()) return input;
  readTruth(options, &input);
  if (options.recording.folder.empty()) return input;
  std::vector<PointModel> frames = importFrames(options.recording, options.queries, "querying  ", console);
  checkWorld("--recording", options.recording.folder, *input.place, frames,
             "give the first recording of the place, whose world the ledger has, and the frames that were mapped; "
             "where spherecloud map found their poses, give these by --poses-from");
  if (isRun("inversion", options)) input.views = viewsOf(options, *input.place);
  for (PointModel &frame : frames) input.queries.push_back(std::move(frame.points));
  if (options.has_photos)
    for (PointModel &frame : readPhotos(options, *input.place, console))
      input.photos.push_back(std::move(frame.points));
  return input;
}

AuditRules rulesOf(const AuditOptions &options) {
  AuditRules rules;
  rules.allow_unmeasured = options.allow_unmeasured;
  rules.only = options.only;
  for (const std::string &text : options.limits) {
    const size_t equals = text.find('=');
    try {
      size_t used = 0;
      const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
      const double value = std::stod(number, &used);
      if (used != number.size() || !std::isfinite(value)) throw std::invalid_argument(number);
      if (!rules.limits.emplace(text.substr(0, equals), value).second)
        throw UsageError("--limit " + text + ": this limit is given twice");
    } catch (const std::logic_error &) {
      throw UsageError("--limit " + text + " is not NAME=NUMBER, as in --limit real_or_fake.auc=0.55");
    }
  }
  try {
    checkRules(rules);
  } catch (const std::runtime_error &error) {
    throw UsageError(error.what());
  }
  return rules;
}

std::string nameOf(const AuditOptions &options) {
  return options.name.empty() ? std::filesystem::path(options.map).stem().string() : options.name;
}

// A row of the table is a line.
void checkName(const AuditOptions &options) {
  const std::string name = nameOf(options);
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' '; }))
    throw UsageError(
        "--name: the name of the map in the table has no line's end and no other control character; "
        "give another");
}

std::string strategyOf(const AuditInput &input) { return input.place ? input.place->strategy : "unknown"; }

// For a table of results.
std::vector<PrivacyRow> rowsOf(const AuditOptions &options, const MapAudit &audit, const AuditInput &input) {
  const std::string name = nameOf(options), strategy = strategyOf(input);
  const double eta = input.place ? input.place->eta : 0;
  std::vector<PrivacyRow> rows = realOrFakeRows(audit.real_or_fake, name, strategy, eta);
  for (const AuditFigure &figure : audit.figures) {
    if (!figure.value) continue;
    rows.push_back({"audit", name, strategy, eta, figure.remark, figure.kind.name, *figure.value});
  }
  for (const InversionResult &result : audit.inversions) {
    rows.push_back({"audit", name, strategy, eta, result.name, "retrieval_coarse", result.coarse.top1});
    rows.push_back({"audit", name, strategy, eta, result.name, "retrieval_fine", result.fine.top1});
    rows.push_back(
        {"audit", name, strategy, eta, result.name, "views", static_cast<double>(result.pictures.size())});
  }
  return rows;
}

// What is there and no table of ours may go: it is empty, or --force was given.
void writeFigures(const AuditOptions &options, const MapAudit &audit, const AuditInput &input) {
  const std::string &path = options.figures;
  if (std::filesystem::is_regular_file(path) && !holds(kPrivacyHead)(path))
    writeFile(path, std::string(kPrivacyHead) + "\n");
  const std::vector<PrivacyRow> rows = rowsOf(options, audit, input);
  // Of an attack that was not run now the table would have the figures of another time.
  for (const char *attack : {"real_or_fake", "audit"})
    replacePrivacyResults(path, keyOf({attack, nameOf(options), strategyOf(input), 0, "", "", 0}), rows);
}

Row rowOf(const AuditFigure &figure) {
  const FigureKind &kind = figure.kind;
  const std::string limit = kind.limit ? (kind.at_most ? ", at most " : ", at least ") + fixed(*kind.limit, 3) : "";
  const std::string remark = figure.remark.empty() ? "" : " (" + figure.remark + ")";
  const std::string error = figure.standard_error > 0 ? " +- " + fixed(figure.standard_error, 3) : "";
  return {kind.name, figure.value ? fixed(*figure.value, 3) + error : "-",
          wordFor(figure) + limit + ": " + kind.about + remark};
}

nlohmann::ordered_json jsonOf(const AuditFigure &figure) {
  nlohmann::ordered_json json = {{"name", figure.kind.name}, {"verdict", wordFor(figure)}};
  if (figure.value) json["value"] = *figure.value;
  if (figure.standard_error > 0) json["standard_error"] = figure.standard_error;
  if (figure.kind.limit) json["limit"] = *figure.kind.limit;
  if (!figure.remark.empty()) json["remark"] = figure.remark;
  return json;
}

void tell(const MapAudit &audit, const std::string &page, const Console &console) {
  std::vector<Row> rows;
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  nlohmann::ordered_json inversions = nlohmann::ordered_json::array();
  for (const AuditFigure &figure : audit.figures) {
    rows.push_back(rowOf(figure));
    figures.push_back(jsonOf(figure));
  }
  for (const InversionResult &result : audit.inversions)
    inversions.push_back({{"points", result.name},
                          {"views", result.pictures.size()},
                          {"retrieval_coarse", result.coarse.top1},
                          {"retrieval_fine", result.fine.top1}});
  console.say(tableText(rows));
  if (!page.empty()) console.say((audit.views.empty() ? "Report: " : "Report, private: ") + page);
  console.say(outcomeText(audit));
  console.give({{"holds", audit.outcome() == AuditOutcome::kHolds},
                {"not_measured", audit.missingGates()},
                {"allowed_unmeasured", audit.allowedGates()},
                {"quick", audit.quick},
                {"figures", figures},
                {"inversions", inversions},
                {"report", page}});
}

int exitCodeOf(AuditOutcome outcome) {
  switch (outcome) {
    case AuditOutcome::kHolds:
      return kExitDone;
    case AuditOutcome::kBroken:
      return kExitAuditFailed;
    case AuditOutcome::kNotMeasured:
      break;
  }
  return kExitAuditIncomplete;
}

int run(const AuditOptions &options, const Console &console) {
  if (options.truth.empty() && !options.recording.folder.empty())
    throw UsageError("--recording tells nothing without --truth; give the ledger too");
  if (options.has_photos && options.recording.folder.empty())
    throw UsageError("--photos tell nothing without --recording; give what the map was made of too");
  if (options.photos.last < options.photos.first)
    throw UsageError("--photos-last lies before --photos-first; swap them");
  if (!options.figures.empty()) checkName(options);
  const AuditRules rules = rulesOf(options);
  fileUse(options).check();
  const AuditInput input = inputOf(options, console);
  ProgressBar bar("auditing  ");
  const MapAudit audit = auditMap(input, rules, [&bar](uint32_t done, uint32_t total) { bar.show(done, total); });
  const std::string page = options.report.empty() ? "" : writeAuditPage(options.report, options.map, audit);
  if (!options.figures.empty()) writeFigures(options, audit, input);
  tell(audit, page, console);
  return exitCodeOf(audit.outcome());
}

const char kAuditHelp[] =
    "Runs the attacks that are known against a map file and scores them by what its owner knows: density of\n"
    "lines, real against fake, inverted pictures, other releases, photos, querying clients.  Ends with status 4 "
    "when a\n"
    "limit is broken, and with 5 when a limit was not measured, so that a release stops there.";
const char kAuditExample[] =
    "Example:\n"
    "  spherecloud audit room.sphc --truth spherecloud.ledger --recording walk --last 99 --report audit\n"
    "  spherecloud audit room.sphc --quick --allow-unmeasured truth --allow-unmeasured releases\n"
    "  spherecloud audit room2.sphc --truth spherecloud.ledger --release room.sphc --limit real_or_fake.auc=0.55\n"
    "Without --recording the truth of pictures is what a network paints of the unprotected points.\n"
    "More: docs/audit.md";

}  // namespace

Command auditCommand(CLI::App *root) {
  auto options = std::make_shared<AuditOptions>();
  CLI::App *app = root->add_subcommand("audit");
  app->description("Attack a map before others do.\n\n" + std::string(kAuditHelp));
  app->footer(kAuditExample);
  app->add_option("map", options->map, "Map file")->required()->type_name("MAP");
  app->add_option("--truth", options->truth, "Ledger that released the map")->type_name("FILE");
  addRecordingOptions(app, &options->recording);
  addPosesOption(app, &options->recording);
  CLI::Option *recording = app->get_option("--recording")->required(false);
  for (const char *name : {"--calibration", "--first", "--last", "--step", "--poses-from", "--pose-gap-ms"})
    app->get_option(name)->needs(recording);
  app->add_option("--release", options->releases, "Another map of the place that was published; repeat")
      ->expected(1)
      ->take_all()
      ->type_name("MAP");
  app->add_option("--queries", options->queries, "Frames of a client")
      ->capture_default_str()
      ->transform(wholeFrom(1, 100000))
      ->needs(recording)
      ->type_name("N");
  auto *photos = app->add_option("--photos", options->photos.folder,
                                 "Frames of the place that the map was not made of, posed in the same world")
                     ->type_name("PATH");
  auto *first = app->add_option("--photos-first", options->photos.first, "First of them")
                    ->transform(wholeFrom(0, UINT32_MAX))
                    ->type_name("N");
  auto *last = app->add_option("--photos-last", options->photos.last, "Last of them")
                   ->transform(wholeFrom(0, UINT32_MAX))
                   ->type_name("N");
  app->add_option("--limit", options->limits, "Another limit: NAME=NUMBER; repeat")
      ->expected(1)
      ->take_all()
      ->type_name("NAME=X");
  app->add_option("--allow-unmeasured", options->allow_unmeasured,
                  "What may stay unmeasured: a figure, an attack, or truth, recording, networks, releases; repeat")
      ->expected(1)
      ->take_all()
      ->type_name("NAME");
  app->add_option("--only", options->only, "Attacks to run, the others being not measured; repeat [all]")
      ->expected(1)
      ->take_all()
      ->type_name("ATTACK");
  app->add_option("--report", options->report, "Folder for a page with pictures")->type_name("FOLDER");
  CLI::Option *figures = app->add_option("--figures", options->figures, "Write the figures into this table too");
  figures->type_name("CSV");
  app->add_option("--name", options->name, "Name of the map in that table [the file's]")
      ->needs(figures)
      ->type_name("NAME");
  app->add_option("--networks", options->networks, "Folder of the attackers' networks [the command's own]")
      ->type_name("FOLDER");
  app->add_flag("--quick", options->quick, "Fewer lines and views: within half a minute");
  addForceOption(app, &options->force);
  return {app, [options, photos, first, last](const Console &console) {
            options->has_photos = *photos || *first || *last;
            return run(*options, console);
          }};
}

}  // namespace sphc::host
