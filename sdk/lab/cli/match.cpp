// spherecloud-lab match: matchers of descriptors on maps of growing size.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <memory>

#include "host/base/write_file.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/import_recording.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/progress.h"
#include "host/publish/map_writer.h"
#include "host/report/file.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/cli/words.h"
#include "lab/match/plots.h"
#include "lab/match/table.h"
#include "lab/pose/bench.h"

namespace sphc::host {
namespace {

constexpr uint64_t kSeed = 20240902;

struct MatchOptions {
  RecordingOptions recording, queries;
  std::vector<size_t> sizes = {10000, 50000, 200000, 1000000};
  size_t query_count = 1000;
  uint32_t repeats = 5;
  std::vector<std::string> only;
  std::string python = "python3", out, results;
  bool no_peers = false, force = false;
};

// `count` points of a model, evenly chosen, as seen from a centre.
std::vector<MatchPoint> chosenPoints(const PointModel &model, const Vector3 &centre_m, size_t count) {
  std::vector<MatchPoint> points;
  count = std::min(count, model.points.size());
  for (size_t k = 0; k < count; ++k) {
    const ModelPoint &point = model.points[k * model.points.size() / count];
    points.push_back({(point.position_m - centre_m).normalized(), point.descriptor});
  }
  return points;
}

MatchCase caseOf(const PointModel &model, const Vector3 &centre_m, size_t size,
                 const std::vector<MatchPoint> &queries) {
  const auto start = std::chrono::steady_clock::now();
  SphereCloud cloud;
  for (const MatchPoint &p : grownPoints(chosenPoints(model, centre_m, size), size, kSeed))
    cloud.points.push_back({p.direction, p.descriptor});
  const std::vector<uint8_t> file = encodeMap(cloud, MapId{});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  MapHeader header;
  std::memcpy(&header, file.data(), sizeof header);
  return makeMatchCase(file, header.extractor, seconds, queries);
}

std::vector<MatchVariant> variantsOf(const MatchOptions &options, const Console &console) {
  std::vector<MatchVariant> all = ourMatchVariants();
  if (!options.no_peers) {
    for (MatchVariant &peer : openCvMatchPeers()) all.push_back(std::move(peer));
    for (MatchVariant &peer : pythonMatchPeers(options.python)) all.push_back(std::move(peer));
  }
  all = chosenByName(options.only, std::move(all));
  for (const MatchVariant &variant : all)
    if (!variant.prepare) console.warn("note: " + variant.name + " is absent, " + variant.absent);
  return all;
}

void writeResult(const MatchOptions &options, const std::vector<MatchTable> &tables, const Console &console) {
  if (!options.results.empty()) writeFile(options.results, matchResults(tables));
  if (options.out.empty()) return;
  makeFolder(options.out);
  writeFile(options.out + "/match.csv", matchCsv(tables));
  sayWritten(options.out, writeMatchDrawings(options.out, tables), console);
}

int run(MatchOptions options, const Console &console) {
  FileUse files(options.force);
  files.reads(options.recording);
  files.writes("--results", options.results, holds(matchResults({})));
  files.writesFolder("--out", options.out, holds(kPlotHead));
  files.check();
  options.queries.folder = options.recording.folder;
  options.queries.calibration = options.recording.calibration;
  const int core = pinToOneCore();
  const auto variants = variantsOf(options, console);
  console.say(pinnedText(core, "CPU time"));
  const PointModel model = importRecording(options.recording, "mapping   ");
  const Vector3 centre_m = centreOf(model.points);
  const auto queries = chosenPoints(importRecording(options.queries, "querying  "), centre_m, options.query_count);
  std::vector<MatchTable> tables;
  for (const size_t size : options.sizes) {
    const MatchCase c = caseOf(model, centre_m, size, queries);
    ProgressBar bar("measuring ");
    tables.push_back(runMatchBench(c, variants, options.repeats,
                                   [&bar](uint32_t done, uint32_t total) { bar.show(done, total); }));
    console.say("\n" + matchTableText(tables.back()));
  }
  writeResult(options, tables, console);
  console.give({{"core", core}, {"repeats", options.repeats}, {"tables", matchJson(tables)}});
  return kExitDone;
}

const char kMatchHelp[] =
    "Makes maps of several sizes from the frames of a recording, asks each with keypoints of other frames, and\n"
    "shows times and recalls of this library's matchers and of their peers, in one interleaved run on one core.\n"
    "docs/bench.md says what each column means, how maps grow and how peers are installed.";
const char kMatchExample[] =
    "Example:\n"
    "  spherecloud-lab match --recording kitchen --last 597 --step 3 --query-first 620 --query-step 20\n"
    "  spherecloud-lab match --recording kitchen --last 597 --query-first 620 --size 50000 --no-peers\n"
    "What comes out: a table a size; with --out match.csv and a drawing.";

void addOptions(CLI::App *app, MatchOptions *options) {
  addRecordingOptions(app, &options->recording);
  const char *group = "Queries";
  app->add_option("--query-first", options->queries.first, "First frame that asks [0]")
      ->required()
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX))
      ->group(group);
  app->add_option("--query-last", options->queries.last, "Last frame that asks [all]")
      ->type_name("N")
      ->transform(wholeFrom(0, UINT32_MAX))
      ->group(group);
  app->add_option("--query-step", options->queries.step, "Every N-th frame asks [1]")
      ->type_name("N")
      ->transform(wholeFrom(1, UINT32_MAX))
      ->group(group);
  app->add_option("--queries", options->query_count, "Keypoints that ask")
      ->capture_default_str()
      ->check(CLI::Range(size_t{1}, size_t{4096}))
      ->type_name("N")
      ->group(group);
  app->add_option("--size", options->sizes, "Points of a map; repeat [10000, 50000, 200000, 1000000]")
      ->expected(1)
      ->take_all()
      ->check(CLI::Range(size_t{1000}, size_t{16000000}))
      ->type_name("N");
  addRepeatOption(app, &options->repeats);
  addOnlyOption(app, &options->only, "matcher");
  app->add_flag("--no-peers", options->no_peers, "The library's own matchers only");
  app->add_option("--python", options->python, "Python that has faiss, hnswlib and numpy")
      ->capture_default_str()
      ->type_name("PATH");
  app->add_option("-o,--out", options->out, "Folder for match.csv and a drawing")->type_name("DIR");
  app->add_option("--results", options->results, "Write recalls and ratios, no milliseconds")->type_name("FILE");
}

}  // namespace

Command matchCommand(CLI::App *root) {
  auto options = std::make_shared<MatchOptions>();
  CLI::App *app = root->add_subcommand("match");
  app->description("Matchers of descriptors on maps of growing size.\n\n" + std::string(kMatchHelp));
  app->footer(kMatchExample);
  addOptions(app, options.get());
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
