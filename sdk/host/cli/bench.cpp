// spherecloud bench: estimators side by side on the same input.
#include <filesystem>
#include <memory>

#include "host/bench/pose_ours.h"
#include "host/bench/pose_peers.h"
#include "host/bench/pose_table.h"
#include "host/cli/command.h"
#include "host/cli/exit_code.h"
#include "host/cli/progress.h"
#include "host/report/file.h"

namespace sphc::host {
namespace {

struct Options {
  std::vector<std::string> files, only;
  std::vector<DepthSource> depths = {DepthSource::kTof};
  BenchOptions bench;
  std::string python = "python3", out, ledger;
  bool no_peers = false;
};

std::vector<PoseVariant> allVariants(const Options &options) {
  std::vector<PoseVariant> all = ourVariants();
  if (options.no_peers) return all;
  for (PoseVariant &peer : posePeers(options.python)) all.push_back(std::move(peer));
  return all;
}

void tellAbsent(const std::vector<PoseVariant> &variants, const Console &console) {
  for (const PoseVariant &variant : variants)
    if (!variant.run) console.warn("note: " + variant.name + " is absent, " + variant.absent);
}

// Variants by name, when some were asked for.
std::vector<PoseVariant> chooseVariants(const Options &options, std::vector<PoseVariant> all) {
  if (options.only.empty()) return all;
  std::vector<PoseVariant> chosen;
  for (const std::string &name : options.only) {
    size_t before = chosen.size();
    for (const PoseVariant &variant : all)
      if (variant.name == name) chosen.push_back(variant);
    if (chosen.size() > before) continue;
    std::string known;
    for (const PoseVariant &variant : all) known += (known.empty() ? "" : ", ") + variant.name;
    throw UsageError("--only " + name + ": there is no such variant; choose from: " + known);
  }
  return chosen;
}

BenchTable runFile(const std::string &path, DepthSource depth, const Options &options,
                   const std::vector<PoseVariant> &variants, const Console &console) {
  const PoseFile file = readPoseFile(path), eta100 = readTruePoints(path);
  if (file.queries.empty()) throw std::runtime_error(path + " holds no query; choose another file");
  if (eta100.queries.empty())
    console.warn("note: beside " + path + " lies no eta-100 file with its _xyz companion: no peers on true points");
  const auto cases = makePoseCases(file, depth, noiseFor(depth), eta100);
  ProgressBar bar("measuring ");
  BenchTable table = {std::filesystem::path(path).stem().string(), file.eta_percent, depth, cases.size(), {}, {}};
  table.runs = runPoseBench(cases, variants, options.bench,
                            [&bar](uint32_t done, uint32_t total) { bar.show(done, total); });
  table.summaries = summarizePoseBench(table.runs);
  return table;
}

int runPose(const Options &options, const Console &console) {
  const int core = pinToOneCore();
  const auto variants = chooseVariants(options, allVariants(options));
  tellAbsent(variants, console);
  console.say(core < 0 ? "The system does not let itself be pinned to one core; times may jump."
                       : "Pinned to core " + std::to_string(core) + "; one thread.");
  std::vector<BenchTable> tables;
  for (const std::string &path : options.files) {
    for (const DepthSource depth : options.depths) {
      tables.push_back(runFile(path, depth, options, variants, console));
      console.say("\n" + benchTableText(tables.back()));
    }
  }
  if (!options.out.empty()) {
    makeFolder(options.out);
    writeText(options.out + "/pose.csv", benchCsv(tables));
  }
  if (!options.ledger.empty()) writeText(options.ledger, benchLedger(tables));
  console.give({{"core", core},
                {"repeats", options.bench.repeats},
                {"seeds", options.bench.seeds},
                {"tables", benchJson(tables)}});
  return kExitDone;
}

const char kHelp[] =
    "Runs pose estimators on the same correspondences in one interleaved run, on one core, and shows medians,\n"
    "tails and the ratio of times.  docs/bench.md says what each column means and how peers are installed.";
const char kExample[] =
    "Example:\n"
    "  spherecloud bench pose kitchen_eta33_dev.bin\n"
    "  spherecloud bench pose kitchen_eta*_dev.bin --depth tof --depth oracle --out bench\n"
    "  spherecloud bench pose kitchen_eta25_dev.bin --seeds 8 --repeat 1      for the tails\n"
    "What comes out: a table a file and depth; with --out pose.csv and drawings.";

void addOptions(CLI::App *app, Options *options) {
  app->add_option("files", options->files, "Correspondence files")->required()->type_name("FILE");
  const std::map<std::string, DepthSource> depths = {{"tof", DepthSource::kTof}, {"oracle", DepthSource::kOracle}};
  app->add_option("--depth", options->depths,
                  "tof: as the sensor measured; oracle: of the true points; repeat for both")
      ->transform(CLI::CheckedTransformer(depths))
      ->expected(1)
      ->take_all()
      ->type_name("tof|oracle");
  app->add_option("--repeat", options->bench.repeats, "Runs of which the median time counts")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
  app->add_option("--seeds", options->bench.seeds, "Runs with different seeds a query; 8 for tails")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
  app->add_option("--only", options->only, "Only the variant of this name; repeat for more")
      ->expected(1)
      ->take_all()
      ->type_name("NAME");
  app->add_flag("--no-peers", options->no_peers, "The library's own estimators only");
  app->add_option("--python", options->python, "Python that has poselib and numpy")
      ->capture_default_str()
      ->type_name("PATH");
  app->add_option("-o,--out", options->out, "Folder for pose.csv and drawings")->type_name("DIR");
  app->add_option("--ledger", options->ledger, "Write accuracy and ratios, no milliseconds")->type_name("FILE");
}

}  // namespace

Command benchCommand(CLI::App *root) {
  auto options = std::make_shared<Options>();
  CLI::App *bench = root->add_subcommand("bench");
  bench->description("Measure estimators beside their peers.\n\n  spherecloud bench pose FILE...");
  bench->require_subcommand(1);
  bench->footer("Example:\n  spherecloud bench pose kitchen_eta33_dev.bin\nMore: spherecloud bench pose --help");
  CLI::App *app = bench->add_subcommand("pose");
  app->description("Pose estimators on correspondences with known poses.\n\n" + std::string(kHelp));
  app->footer(kExample);
  addOptions(app, options.get());
  return {app, [options](const Console &console) { return runPose(*options, console); }};
}

}  // namespace sphc::host
