
#include <filesystem>
#include <memory>

#include "host/base/write_file.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/progress.h"
#include "host/report/file.h"
#include "lab/cli/commands.h"
#include "lab/cli/words.h"
#include "lab/confidence/fit.h"
#include "lab/confidence/table.h"

namespace sphc::host {
namespace {

struct Options {
  std::vector<std::string> files, fitted;
  uint32_t times = 16, worlds = 6000;
  uint64_t seed = 1;
  std::string out, results;
  bool fit = false, force = false;
};

// Files that differ in eta alone are one scene.
std::string sceneName(const std::string &path) {
  const std::string stem = std::filesystem::path(path).stem().string();
  return stem.substr(0, stem.find("_eta"));
}

ConfidenceScene *sceneOf(const std::string &path, bool fitted_on, std::vector<ConfidenceScene> *scenes) {
  const std::string name = sceneName(path);
  for (ConfidenceScene &scene : *scenes)
    if (scene.name == name && scene.fitted_on == fitted_on) return &scene;
  scenes->push_back({name, fitted_on, {}});
  return &scenes->back();
}

void addFile(const Options &options, const std::string &path, bool fitted_on,
             std::vector<ConfidenceScene> *scenes) {
  const PoseFile file = readPoseFile(path);
  const CaseNoise noise = noiseFor(DepthSource::kTof);
  const auto queries = calibratedQueries(makePoseCases(file, DepthSource::kTof, noise, {}));
  ProgressBar bar("measuring ");
  runConfidence(
      queries, noise, options.times, options.seed + file.eta_percent,
      [&bar](uint32_t done, uint32_t total) { bar.show(done, total); }, &sceneOf(path, fitted_on, scenes)->runs);
}

std::vector<ConfidenceScene> measure(const Options &options) {
  std::vector<ConfidenceScene> scenes;
  for (const std::string &path : options.fitted) addFile(options, path, true, &scenes);
  ProgressBar bar("measuring ");
  const RunDone done = [&bar](uint32_t at, uint32_t total) { bar.show(at, total); };
  scenes.push_back(runMadeWorlds(MadeWorld::kRoom, options.worlds, options.seed, done));
  scenes.back().fitted_on = true;
  for (const std::string &path : options.files) addFile(options, path, false, &scenes);
  scenes.push_back(runMadeWorlds(MadeWorld::kObjects, options.worlds, options.seed, done));
  return scenes;
}

ConfidenceModel chooseModel(const Options &options, const std::vector<ConfidenceScene> &scenes,
                            const Console &console) {
  if (!options.fit) return confidenceModel();
  std::vector<ConfidenceRun> runs;
  for (const ConfidenceScene &scene : scenes)
    if (scene.fitted_on) runs.insert(runs.end(), scene.runs.begin(), scene.runs.end());
  const ConfidenceModel model = fitConfidence(runs);
  console.say("Fitted to " + std::to_string(runs.size()) + " poses; for sdk/runtime/stages/pose/confidence.cpp:\n" +
              modelText(model) + "\n");
  return model;
}

void writeResult(const Options &options, const std::vector<ConfidenceScene> &scenes, const ConfidenceModel &model,
                 const Console &console) {
  if (!options.results.empty()) writeFile(options.results, confidenceResults(scenes, model));
  if (options.out.empty()) return;
  makeFolder(options.out);
  writeFile(options.out + "/confidence.csv", confidenceCsv(scenes, model));
  const Drawing drawing = drawConfidence(scenes, model);
  sayWritten(options.out, plot(options.out, drawing.name, drawing.script, drawing.size), console);
}

int run(const Options &options, const Console &console) {
  FileUse files(options.force);
  for (const std::string &path : options.files) files.reads("the rows", path);
  for (const std::string &path : options.fitted) files.reads("--fitted", path);
  files.writes("--results", options.results, holds(confidenceResults({}, {})));
  files.writesFolder("--out", options.out, holds(kPlotHead));
  files.check();
  const auto scenes = measure(options);
  const ConfidenceModel model = chooseModel(options, scenes, console);
  console.say(confidenceText(scenes, model));
  writeResult(options, scenes, model, console);
  console.give(confidenceJson(scenes, model));
  return kExitDone;
}

const char kHelp[] =
    "Poses of queries made hard in every way (few rows, many fakes, depth noise misjudged, the wrong place), and "
    "the\n"
    "confidence that each is within 5 cm and 5 deg, against whether it is.  ECE: expected calibration error.\n"
    "Two made-up worlds are always measured: one that the model is fitted on, and one that it is not.\n"
    "docs/confidence.md says more.";
const char kExample[] =
    "Example:\n"
    "  spherecloud-lab confidence apt1_eta*_dev.bin --fitted kitchen_eta25_dev.bin --out bench\n"
    "  spherecloud-lab confidence apt1_eta*_dev.bin --fitted kitchen_eta25_dev.bin --fit\n"
    "What comes out: a table; with --out confidence.csv, a line a pose, and the reliability diagram.";

void addOptions(CLI::App *app, Options *options) {
  app->add_option("files", options->files, "Correspondence files to show the model on")->type_name("FILE");
  app->add_option("--fitted", options->fitted, "A file that the model was fitted on, or is with --fit; repeat")
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
  app->add_flag("--fit", options->fit, "Fit anew, and print the constants");
  app->add_option("--times", options->times, "Hard cases a query")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
  app->add_option("--worlds", options->worlds, "Cases of each made-up world")
      ->capture_default_str()
      ->check(CLI::Range(10u, 1000000u))
      ->type_name("N");
  app->add_option("--seed", options->seed, "Of the cases")
      ->capture_default_str()
      ->check(withoutSign())
      ->type_name("N");
  app->add_option("-o,--out", options->out, "Folder for confidence.csv and the diagram")->type_name("DIR");
  app->add_option("--results", options->results, "Write the table as csv")->type_name("FILE");
}

}  // namespace

Command confidenceCommand(CLI::App *root) {
  auto options = std::make_shared<Options>();
  CLI::App *app = root->add_subcommand("confidence");
  app->description("Is the confidence of a pose what it says?\n\n" + std::string(kHelp));
  app->footer(kExample);
  addOptions(app, options.get());
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
