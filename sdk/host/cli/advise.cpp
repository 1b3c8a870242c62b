// spherecloud advise: is this recording good enough for a map?
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "host/advise/advice.h"
#include "host/cli/commands.h"
#include "host/cli/common/contradictions.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/point_source.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "host/cli/field_warnings.h"
#include "host/report/coverage_picture.h"
#include "host/report/directions.h"
#include "host/report/picture_file.h"
#include "host/report/statistics.h"
#include "host/report/table.h"

namespace sphc::host {
namespace {

constexpr size_t kMostFailuresTold = 12;

struct AdviseOptions {
  RecordingOptions recording;
  AdviceOptions advice;
  std::string picture;
  bool force = false;
};

std::string holesText(const std::vector<Hole> &holes) {
  std::string text;
  for (const Hole &hole : holes)
    text += "  yaw " + fixed(hole.yaw_deg, 0) + ", pitch " + fixed(hole.pitch_deg, 0) + ": nothing within " +
            fixed(hole.radius_deg, 0) + " deg\n";
  return text.empty() ? "  none\n" : text;
}

std::string failuresText(const std::vector<Failure> &failures) {
  std::string text;
  for (size_t i = 0; i < failures.size() && i < kMostFailuresTold; ++i)
    text += "  frame " + std::to_string(failures[i].sequence) + ": " + failures[i].why + "\n";
  if (failures.size() > kMostFailuresTold)
    text += "  and " + std::to_string(failures.size() - kMostFailuresTold) + " more (--json lists them)\n";
  return text.empty() ? "  none\n" : text;
}

void tell(const AdviseOptions &options, const Advice &advice, const Console &console) {
  std::vector<Row> rows = {
      {"points", std::to_string(advice.points), "before fakes replace most of their directions"},
      {"sphere covered", fixed(100 * advice.coverage.covered_share, 0) + " %", "within 5 deg of a point"},
      {"evenness", fixed(100 * advice.coverage.evenness, 0) + " %", "100: as many points in every direction"}};
  for (const Recall &recall : advice.recalls)
    rows.push_back({"expected recall, eta " + fixed(100 * recall.eta, 0) + " %",
                    fixed(percent(recall.good, recall.frames), 1) + " %",
                    std::to_string(recall.good) + " of " + std::to_string(recall.frames) +
                        " held-out frames within 5 cm and 5 deg" +
                        (std::isfinite(recall.median_m) ? ", median " + fixed(100 * recall.median_m, 2) + " cm"
                                                        : ", not one localized")});
  console.say(tableText(rows));
  console.say("Directions without points (yaw around z from x, pitch up, in the recording's world)\n" +
              holesText(advice.coverage.holes));
  console.say("Frames that would fail at eta " + fixed(100 * options.advice.judged_eta, 0) + " %\n" +
              failuresText(advice.failures));
}

// What `build` would say of the recording: as long as that holds, no advice is worth much.
void warnOfRecording(const RgbdImportSummary &all, std::vector<std::string> *contradictions,
                     const Console &console) {
  *contradictions = contradictionsOf(all);
  for (const std::string &contradiction : *contradictions)
    console.warn("This recording contradicts itself, and build refuses it: " + contradiction);
  for (const std::string &doubt : doubtsOfPoses(all)) console.warn("Warning: " + doubt);
}

nlohmann::ordered_json json(const Advice &advice, const std::vector<std::string> &contradictions) {
  nlohmann::ordered_json value = {{"left_out", advice.left_out},
                                  {"contradictions", contradictions},
                                  {"points", advice.points},
                                  {"covered_percent", 100 * advice.coverage.covered_share},
                                  {"evenness_percent", 100 * advice.coverage.evenness},
                                  {"holes", nlohmann::ordered_json::array()},
                                  {"recall", nlohmann::ordered_json::array()},
                                  {"failures", nlohmann::ordered_json::array()}};
  for (const Hole &hole : advice.coverage.holes)
    value["holes"].push_back(
        {{"yaw_deg", hole.yaw_deg}, {"pitch_deg", hole.pitch_deg}, {"radius_deg", hole.radius_deg}});
  for (const Recall &recall : advice.recalls)
    value["recall"].push_back({{"eta", recall.eta},
                               {"good", recall.good},
                               {"frames", recall.frames},
                               {"median_m", std::isfinite(recall.median_m) ? nlohmann::ordered_json(recall.median_m)
                                                                           : nlohmann::ordered_json()}});
  for (const Failure &failure : advice.failures)
    value["failures"].push_back({{"sequence", failure.sequence},
                                 {"why", failure.why},
                                 {"yaw_deg", std::atan2(failure.view[1], failure.view[0]) / kDegree},
                                 {"pitch_deg", std::asin(std::clamp(failure.view[2], -1.0, 1.0)) / kDegree}});
  return value;
}

void drawAdvice(const std::string &path, const Advice &advice) {
  std::vector<std::array<double, 3>> views;
  for (const Failure &failure : advice.failures) views.push_back(failure.view);
  writePicture(path, drawCoverage(advice.directions, advice.coverage.holes, views), Readers::kOwner);
}

int run(const AdviseOptions &options, const Console &console) {
  checkMappingOptions(options.advice.import);
  FileUse files(options.force);
  files.reads(options.recording);
  files.writes("--picture", options.picture, holds(kPictureMark));
  files.check();
  if (!options.picture.empty()) checkPictureName(options.picture);
  const auto reader = openRecording(options.recording);
  noteDamage(*reader, console);
  warnOfField(reader->calibration(), console);  // where nothing is seen, no points are
  ProgressBar bar("holding out");
  std::vector<std::string> contradictions;
  const Advice advice = advise(
      reader.get(), options.advice,
      [&](const RgbdImportSummary &all) { warnOfRecording(all, &contradictions, console); },
      [&bar](uint32_t done, uint32_t total) { bar.show(done, total); });
  for (const std::string &left_out : advice.left_out) console.warn("note: " + left_out);
  if (!options.picture.empty()) drawAdvice(options.picture, advice);  // before words, whose reader may be gone
  tell(options, advice, console);
  if (!options.picture.empty())
    console.say("Picture, private: " + options.picture +
                " (rings: no points; crosses: where failed frames looked)");
  console.give(json(advice, contradictions));
  return kExitDone;
}

const char kAdviseHelp[] =
    "Maps a recording several times, each time without a block of neighbouring frames, and localizes that block "
    "by\n"
    "the real localizer: what a device may expect that comes by later.  Tells which directions have no points, "
    "how\n"
    "recall falls with eta, and which frames fail and why.  Everything it says is private: it is for the owner.";
const char kAdviseExample[] =
    "Example:\n"
    "  spherecloud advise --recording walk --last 99 --picture advice.png\n"
    "A frame fails for few keypoints (blank walls, blur, dark), few depths (too near, too far, dark surfaces) or "
    "few\n"
    "matches (seen from nowhere else: walk there again).";

}  // namespace

Command adviseCommand(CLI::App *root) {
  auto options = std::make_shared<AdviseOptions>();
  CLI::App *app = root->add_subcommand("advise");
  app->description("Look at a recording before its map is released.\n\n" + std::string(kAdviseHelp));
  app->footer(kAdviseExample);
  addRecordingOptions(app, &options->recording);
  addPosesOption(app, &options->recording);
  addDepthRangeOptions(app, &options->advice.import.depth_min_m, &options->advice.import.depth_max_m);
  app->add_option("--folds", options->advice.folds, "Blocks of frames held out in turn")
      ->capture_default_str()
      ->transform(wholeFrom(2, 100));
  app->add_option("--picture", options->picture, "Coverage as a map of the sky")->type_name("PNG");
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
