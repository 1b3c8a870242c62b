// spherecloud-lab compare: the systems of the paper's table 2 side by side, and the density attack on their clouds.
#include <memory>

#include "host/base/usage_error.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/privacy_results.h"
#include "host/cli/common/progress.h"
#include "host/report/file.h"
#include "host/report/results.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/cli/words.h"
#include "lab/compare/attack.h"
#include "lab/compare/input.h"
#include "lab/compare/systems.h"
#include "lab/compare/table.h"

namespace sphc::host {
namespace {

struct CompareOptions {
  CompareRecordingOptions recording;
  std::vector<std::string> correspondences;
  PoseRunOptions runs;
  std::string name, out, results, privacy_results;
  bool attack = false, force = false;
};

CompareInput readInput(CompareOptions options) {
  const bool recording = !options.recording.mapping.folder.empty();
  if (recording == !options.correspondences.empty())
    throw UsageError("give either --recording or --correspondences");
  CompareInput input;
  if (recording) {
    options.recording.queries.folder = options.recording.mapping.folder;
    options.recording.queries.calibration = options.recording.mapping.calibration;
    input = recordCompareInput(options.recording);
  } else {
    input = readCompareInput(options.correspondences, options.runs.every);
  }
  if (!options.name.empty()) input.name = options.name;
  return input;
}

// Whose time is 1: the library on the last sphere cloud given.
std::string referenceName(const CompareInput &input) {
  return input.spheres.empty() ? "" : sphereName(input.spheres.back().queries.eta_percent);
}

CompareTable compareAll(const CompareInput &input, DepthSource depth, const CompareOptions &options) {
  const std::vector<PoseCase> cases = compareCases(input, depth);
  const std::vector<PoseVariant> systems = chosenByName(options.runs.only, compareSystems(input, depth));
  CompareTable table = {input.name, depth, cases.size(), referenceName(input), {}};
  ProgressBar bar("comparing ");
  for (const VariantRuns &runs : runPoseBench(cases, systems, options.runs.bench,
                                              [&bar](uint32_t done, uint32_t total) { bar.show(done, total); }))
    table.systems.push_back(summarizeVariant(runs));
  return table;
}

nlohmann::ordered_json runTables(const CompareInput &input, const CompareOptions &options, const Console &console) {
  console.say(pinnedText(pinToOneCore()));
  nlohmann::ordered_json tables = nlohmann::ordered_json::array();
  for (const DepthSource depth : options.runs.depths) {
    const CompareTable table = compareAll(input, depth, options);
    console.say("\n" + compareText(table));
    if (!options.results.empty()) replaceRows(options.results, kCompareHead, compareKey(table), compareRows(table));
    tables.push_back(compareJson(table));
  }
  return tables;
}

nlohmann::ordered_json runAttack(const CompareInput &input, const CompareOptions &options, const Console &console) {
  const std::vector<AttackedCloud> clouds = attackClouds(input);
  console.say("\n" + attackText(input.name, clouds));
  if (!options.privacy_results.empty())
    updatePrivacyResults(options.privacy_results, attackRows(input.name, clouds));
  if (!options.out.empty()) {
    makeFolder(options.out);
    sayWritten(options.out, drawAttack(options.out, input.name, clouds), console);
  }
  return attackJson(input.name, clouds);
}

int run(const CompareOptions &options, const Console &console) {
  if (!options.attack && (!options.privacy_results.empty() || !options.out.empty()))
    throw UsageError("--out and --privacy-results are for --attack");
  if (options.attack && !options.results.empty()) throw UsageError("--results is not for --attack");
  FileUse files(options.force);
  files.reads(options.recording.mapping);
  for (const std::string &path : options.correspondences) files.reads("--correspondences", path);
  files.writes("--results", options.results, holds(kCompareHead));
  files.writes("--privacy-results", options.privacy_results, holds(kPrivacyHead));
  files.writesFolder("--out", options.out, holds(kPlotHead));
  files.check();
  const CompareInput input = readInput(options);
  if (options.attack)
    console.give(runAttack(input, options, console));
  else
    console.give({{"repeats", options.runs.bench.repeats}, {"tables", runTables(input, options, console)}});
  return kExitDone;
}

const char kCompareHelp[] =
    "Compares sphere clouds with a point cloud, line clouds (uniform, PPL, PPL+) and ray clouds of the same "
    "points,\n"
    "each with its own localizer on the same matches, in one interleaved run on one core: the rows of the paper's\n"
    "table 2.  With --attack the density attack on each cloud instead.  docs/baselines.md says what each system "
    "is.";
const char kCompareExample[] =
    "Example:\n"
    "  spherecloud-lab compare --recording kitchen --last 597 --step 3 --query-first 620 --query-step 5\n"
    "  spherecloud-lab compare --correspondences kitchen_eta100_dev.bin kitchen_eta33_dev.bin\n"
    "  spherecloud-lab compare --correspondences kitchen_eta100_dev.bin kitchen_eta33_dev.bin --attack --out "
    "attack\n"
    "What comes out: a table; with --attack --out a drawing of the errors of recovered points.";

void addInputOptions(CLI::App *app, CompareOptions *options) {
  addRecordingOptions(app, &options->recording.mapping);
  app->get_option("--recording")->required(false);
  const char *group = "Queries";
  RecordingOptions &queries = options->recording.queries;
  app->add_option("--query-first", queries.first, "First frame to localize [0]")
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX))
      ->group(group);
  app->add_option("--query-last", queries.last, "Last frame to localize [all]")
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX))
      ->group(group);
  app->add_option("--query-step", queries.step, "Localize every N-th frame [1]")
      ->type_name("N")
      ->transform(wholeFrom(1, UINT32_MAX))
      ->group(group);
  app->add_option("--eta", options->recording.etas, "Sphere clouds made of the recording [1 0.333]")
      ->check(between(1e-3, 1))
      ->type_name("X");
  for (const char *name :
       {"--calibration", "--first", "--last", "--step", "--query-first", "--query-last", "--query-step", "--eta"})
    app->get_option(name)->needs("--recording");  // correspondences were made of frames that were chosen then
  app->add_option("--correspondences", options->correspondences,
                  "Correspondence files of one place in place of a recording")
      ->type_name("FILE");
}

void addOptions(CLI::App *app, CompareOptions *options) {
  addInputOptions(app, options);
  addPoseRunOptions(app, &options->runs, "system");
  app->add_option("--name", options->name, "What the place is called in tables")->type_name("NAME");
  app->add_option("--results", options->results, "Put the rows of this place in a file, without milliseconds")
      ->type_name("FILE");
  app->add_flag("--attack", options->attack, "Recover points from each cloud by the density attack");
  app->add_option("-o,--out", options->out, "Folder for the attack's drawing")->type_name("DIR");
  app->add_option("--privacy-results", options->privacy_results, "Put the attack's rows of this place in a file")
      ->type_name("FILE");
}

}  // namespace

Command compareCommand(CLI::App *root) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App *app = root->add_subcommand("compare");
  app->description("Compare sphere clouds with the systems of the literature.\n\n" + std::string(kCompareHelp));
  app->footer(kCompareExample);
  addOptions(app, options.get());
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
