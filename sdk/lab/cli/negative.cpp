// spherecloud-lab negative: what happens when a sensor, a calibration or a prior is wrong.
#include <memory>

#include "host/cli/common/exit_code.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/negative/table.h"

namespace sphc::host {
namespace {

struct NegativeOptions {
  RecordingOptions recording;
  std::string map;
  std::vector<std::string> only;
  uint32_t sequences = 4;
  bool elsewhere = false;
};

std::vector<SensorFault> chosenFaults(const NegativeOptions &options) {
  // Of another place the frames are enough of a fault.
  std::vector<std::string> only = options.only;
  if (options.elsewhere && only.empty()) only = {"healthy"};
  return chosenByName(only, allFaults());
}

int run(const NegativeOptions &options, const Console &console) {
  const auto reader =
      options.elsewhere ? openRecording(options.recording) : openRecordingWithPoses(options.recording);
  const std::vector<SensorFault> faults = chosenFaults(options);
  std::vector<MapFile> maps;
  maps.push_back(openMapFile(options.map));
  const Vector3 centre = centreByNote({options.map + ".owner.json"}, maps[0], options.map);
  NegativeInput input = {readSequences(reader.get(), options.sequences),
                         &maps,
                         {centre.x(), centre.y(), centre.z()},
                         options.elsewhere};
  ProgressBar bar("breaking ");
  const std::vector<NegativeRow> rows =
      runNegative(input, faults, [&bar](uint32_t done, uint32_t total) { bar.show(done, total); });
  console.say(negativeText(rows));
  console.give(negativeJson(rows));
  return kExitDone;
}

const char kNegativeHelp[] =
    "Breaks sequences of 30 frames in every way of a table, localizes them in a map, frame by frame alone and\n"
    "tracking, and counts poses beyond 25 cm or 10 deg, those of a confidence above 0.5, and frames and sequences\n"
    "in which the result names the fault.  On healthy frames every fault that is named is a false alarm.";
const char kNegativeExample[] =
    "Example:\n"
    "  spherecloud-lab negative --recording walk --first 100 --map room.sphc\n"
    "  spherecloud-lab negative --recording other --map room.sphc --elsewhere\n"
    "What comes out: a table; with --json rows.  The owner's note is sought beside the map.";

}  // namespace

Command negativeCommand(CLI::App *root) {
  auto options = std::make_shared<NegativeOptions>();
  CLI::App *app = root->add_subcommand("negative");
  app->description("Are broken sensors believed?\n\n" + std::string(kNegativeHelp));
  app->footer(kNegativeExample);
  addRecordingOptions(app, &options->recording);
  app->add_option("-m,--map", options->map, "Map file, with its owner's note beside it")
      ->required()
      ->type_name("FILE");
  app->add_option("--sequences", options->sequences, "At most so many, spread over the recording")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
  app->add_flag("--elsewhere", options->elsewhere, "The recording shows another place: no pose is right");
  addOnlyOption(app, &options->only, "fault");
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
