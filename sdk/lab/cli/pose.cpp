// spherecloud-lab pose: estimators side by side on the same input.
#include <filesystem>
#include <memory>

#include "host/base/write_file.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/progress.h"
#include "host/report/file.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/cli/words.h"
#include "lab/pose/ours.h"
#include "lab/pose/peers.h"
#include "lab/pose/plots.h"
#include "lab/pose/table.h"

namespace sphc::host {
namespace {

struct PoseOptions {
  std::vector<std::string> files;
  PoseRunOptions runs;
  std::string python = "python3", out, results;
  bool no_peers = false, growth = false, force = false;
};

std::vector<PoseVariant> allVariants(const PoseOptions &options) {
  std::vector<PoseVariant> all = ourVariants();
  if (options.no_peers) return all;
  for (PoseVariant &peer : posePeers(options.python)) all.push_back(std::move(peer));
  return all;
}

void tellAbsent(const std::vector<PoseVariant> &variants, const Console &console) {
  for (const PoseVariant &variant : variants)
    if (!variant.run) console.warn("note: " + variant.name + " is absent, " + variant.absent);
}

// One file, read once for all kinds of depth.
struct Input {
  std::string name;
  PoseFile file, eta100;
};

Input readInput(const std::string &path, uint32_t every, const Console &console) {
  Input input = {std::filesystem::path(path).stem().string(), readPoseFile(path), readTruePoints(path)};
  if (input.file.queries.empty()) throw std::runtime_error(path + " holds no query; choose another file");
  if (input.eta100.queries.empty())
    console.warn("note: beside " + path + " lies no eta-100 file with its _xyz companion: no peers on true points");
  keepEvery(every, &input.file);
  return input;
}

BenchTable runInput(const Input &input, DepthSource depth, const BenchOptions &options,
                    const std::vector<PoseVariant> &variants) {
  const auto cases = makePoseCases(input.file, depth, noiseFor(depth), input.eta100);
  ProgressBar bar("measuring ");
  BenchTable table = {input.name, input.file.eta_percent, depth, cases.size(), {}, {}};
  table.runs =
      runPoseBench(cases, variants, options, [&bar](uint32_t done, uint32_t total) { bar.show(done, total); });
  table.summaries = summarizePoseBench(table.runs);
  return table;
}

std::vector<GrowthRow> growInput(const Input &input, DepthSource depth, const BenchOptions &options,
                                 const std::vector<PoseVariant> &variants) {
  const CaseNoise noise = noiseFor(depth);
  const GrowthInput growth = {input.name, makePoseCases(input.file, depth, noise, input.eta100), depth, noise};
  ProgressBar bar("growing   ");
  const QueryDone done = [&bar](uint32_t at, uint32_t total) { bar.show(at, total); };
  std::vector<GrowthRow> rows = growCounts(growth, variants, options, done);
  for (GrowthRow &row : growEtas(growth, variants, options, done)) rows.push_back(std::move(row));
  return rows;
}

struct Result {
  std::vector<BenchTable> tables;
  std::vector<GrowthRow> growth;
};

void append(const PoseOptions &options, const Input &input, DepthSource depth,
            const std::vector<PoseVariant> &variants, const Console &console, Result *result) {
  if (!options.growth) {
    result->tables.push_back(runInput(input, depth, options.runs.bench, variants));
    console.say("\n" + benchTableText(result->tables.back()));
    return;
  }
  const auto rows = growInput(input, depth, options.runs.bench, variants);
  console.say("\n" + growthText(rows));
  result->growth.insert(result->growth.end(), rows.begin(), rows.end());
}

void writeResult(const PoseOptions &options, const Result &result, const Console &console) {
  if (!options.results.empty())
    writeFile(options.results, options.growth ? growthResults(result.growth) : benchResults(result.tables));
  if (options.out.empty()) return;
  makeFolder(options.out);
  if (!result.tables.empty()) writeFile(options.out + "/pose.csv", benchCsv(result.tables));
  if (!result.growth.empty()) writeFile(options.out + "/pose_growth.csv", growthCsv(result.growth));
  sayWritten(options.out, writeDrawings(options.out, poseDrawings(result.tables, result.growth)), console);
}

int runPose(const PoseOptions &options, const Console &console) {
  FileUse files(options.force);
  for (const std::string &path : options.files) files.reads("the rows", path);
  files.writes("--results", options.results, holds(options.growth ? growthResults({}) : benchResults({})));
  files.writesFolder("--out", options.out, holds(kPlotHead));
  files.check();
  const int core = pinToOneCore();
  const auto variants = chosenByName(options.runs.only, allVariants(options));
  tellAbsent(variants, console);
  console.say(pinnedText(core));
  Result result;
  for (const std::string &path : options.files) {
    const Input input = readInput(path, options.runs.every, console);
    for (const DepthSource depth : options.runs.depths) append(options, input, depth, variants, console, &result);
  }
  writeResult(options, result, console);
  console.give({{"core", core},
                {"repeats", options.runs.bench.repeats},
                {"seeds", options.runs.bench.seeds},
                {"tables", benchJson(result.tables)},
                {"growth", growthJson(result.growth)}});
  return kExitDone;
}

const char kPoseHelp[] =
    "Runs pose estimators on the same correspondences in one interleaved run, on one core, and shows medians,\n"
    "tails and the ratio of times.  docs/bench.md says what each column means and how peers are installed.";
const char kPoseExample[] =
    "Example:\n"
    "  spherecloud-lab pose kitchen_eta33_dev.bin\n"
    "  spherecloud-lab pose kitchen_eta*_dev.bin --depth tof --depth oracle --out bench\n"
    "  spherecloud-lab pose kitchen_eta25_dev.bin --seeds 8 --repeat 1      for the tails\n"
    "  spherecloud-lab pose kitchen_eta25_dev.bin --growth --only ours --only 'poselib p3p' --out bench\n"
    "What comes out: a table a file and depth; with --out pose.csv and drawings.";

void addOptions(CLI::App *app, PoseOptions *options) {
  app->add_option("files", options->files, "Correspondence files")->required()->type_name("FILE");
  addPoseRunOptions(app, &options->runs, "variant");
  app->add_option("--seeds", options->runs.bench.seeds, "Runs with different seeds a query; 8 for tails")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
  app->add_flag("--growth", options->growth, "Time against the number of rows and against eta instead");
  app->add_flag("--no-peers", options->no_peers, "The library's own estimators only");
  app->add_option("--python", options->python, "Python that has poselib and numpy")
      ->capture_default_str()
      ->type_name("PATH");
  app->add_option("-o,--out", options->out, "Folder for pose.csv and drawings")->type_name("DIR");
  app->add_option("--results", options->results, "Write accuracy and ratios, no milliseconds")->type_name("FILE");
}

}  // namespace

Command poseCommand(CLI::App *root) {
  auto options = std::make_shared<PoseOptions>();
  CLI::App *app = root->add_subcommand("pose");
  app->description("Pose estimators on correspondences with known poses.\n\n" + std::string(kPoseHelp));
  app->footer(kPoseExample);
  addOptions(app, options.get());
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return runPose(*options, console); }};
}

}  // namespace sphc::host
