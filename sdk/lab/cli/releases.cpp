// spherecloud-lab releases: attacks on several releases of one place.
#include <memory>

#include "host/audit/score/release_audit.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/import_recording.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/privacy_results.h"
#include "host/report/table.h"
#include "lab/cli/commands.h"
#include "lab/common/recording_name.h"

namespace sphc::host {
namespace {

struct ReleasesOptions {
  RecordingOptions recording, other, strangers;
  uint32_t more_last = 0, frames = 25;
  double eta = 1.0 / 3;
  std::string name, results, fakes = kDefaultFakes;
  bool force = false;
};

void tell(const std::vector<PrivacyRow> &rows, const Console &console) {
  std::vector<Row> table;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const PrivacyRow &row : rows) {
    table.push_back({row.attack + ", " + row.variant, fixed(row.value, 4), row.metric});
    json.push_back(
        {{"attack", row.attack}, {"variant", row.variant}, {"metric", row.metric}, {"value", row.value}});
  }
  console.say(tableText(table));
  console.give({{"rows", json}});
}

int run(ReleasesOptions options, const Console &console) {
  FileUse files(options.force);
  files.reads(options.recording);
  files.reads("--strangers", options.strangers.folder);
  files.reads("--strangers-calibration", options.strangers.calibration);
  files.writes("--results", options.results, holds(kPrivacyHead));
  files.check();
  options.other.folder = options.recording.folder;
  options.other.calibration = options.recording.calibration;
  options.other.step = options.recording.step;
  RecordingOptions more = options.recording;
  more.last = options.more_last;
  ReleaseAuditInput input;
  input.map = options.name.empty() ? recordingName(options.recording.folder).string() : options.name;
  input.first = importRecording(options.recording, "mapping   ");
  input.more = importRecording(more, "10 % more ");
  input.other = importRecording(options.other, "others    ");
  input.queries = importFrames(options.other, options.frames, "querying  ", console);
  input.strangers = importFrames(options.strangers, options.frames, "strangers ", console);
  const auto strategy = makeFakes(options.fakes);
  const std::vector<PrivacyRow> rows = auditReleases(input, *strategy, options.eta);
  tell(rows, console);
  if (!options.results.empty()) updatePrivacyResults(options.results, rows);
  return kExitDone;
}

const char kReleasesHelp[] =
    "Publishes one place several times, carelessly and through the release discipline, runs the attacks on\n"
    "several releases on both, and scores them by what the owner knows.";
const char kReleasesExample[] =
    "Example:\n"
    "  spherecloud-lab releases --recording kitchen --last 537 --step 3 --more-last 597 \\\n"
    "              --other-first 620 --other-last 799 --strangers corridor\n"
    "More: docs/release.md";

}  // namespace

Command releasesCommand(CLI::App *root) {
  auto options = std::make_shared<ReleasesOptions>();
  CLI::App *app = root->add_subcommand("releases");
  app->description("Attacks on several releases of one place.\n\n" + std::string(kReleasesHelp));
  app->footer(kReleasesExample);
  addRecordingOptions(app, &options->recording);
  app->add_option("--more-last", options->more_last, "Last frame of the update")
      ->required()
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX));
  app->add_option("--other-first", options->other.first, "First of the other frames of the place")
      ->required()
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX));
  app->add_option("--other-last", options->other.last, "Last of them")
      ->required()
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX));
  app->add_option("--strangers", options->strangers.folder, "Recording of another place")
      ->required()
      ->type_name("PATH");
  app->add_option("--strangers-calibration", options->strangers.calibration, "Its calibration")->type_name("FILE");
  app->add_option("--frames", options->frames, "Single frames of each that attackers have")
      ->capture_default_str()
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  app->add_option("--eta", options->eta, "Share of points that stay real")
      ->capture_default_str()
      ->check(between(0.01, 1))
      ->type_name("X");
  app->add_option("--fakes", options->fakes, "How fakes are made")
      ->capture_default_str()
      ->check(CLI::IsMember(fakeNames()))
      ->type_name("NAME");
  app->add_option("--name", options->name, "Of the map, in the results [the recording's]")->type_name("NAME");
  app->add_option("--results", options->results, "Update these attacks' rows here")->type_name("CSV");
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
