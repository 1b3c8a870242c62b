// spherecloud-lab recording: depth codecs side by side, and the cost of the recorder.
#include <filesystem>
#include <memory>

#include "host/base/checked_call.h"
#include "host/base/usage_error.h"
#include "host/base/write_file.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "host/report/run.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/cli/words.h"
#include "lab/recording/bench.h"

namespace sphc::host {
namespace {

struct RecordingCommandOptions {
  std::vector<std::string> recordings, calibrations;
  uint32_t step = 1, repeats = 3;
  std::string results, folder = ".";
  bool force = false;
};

struct DepthFrames {
  uint32_t width = 0, height = 0;
  std::vector<std::vector<uint16_t>> frames;
};

DepthFrames readDepth(RecordingReader *reader, const Console &console) {
  DepthFrames depth;
  forReadableFrames(reader, saidBy(console), [&depth](uint32_t, const sphc_localizer_frame &frame) {
    const auto *pixels = static_cast<const uint16_t *>(frame.depth.data);
    depth.width = frame.depth.width;
    depth.height = frame.depth.height;
    depth.frames.emplace_back(pixels, pixels + size_t{depth.width} * depth.height);
  });
  return depth;
}

// The folder above a seq-* folder names the recording.
std::string nameOf(const std::string &path) {
  const std::filesystem::path folder = std::filesystem::weakly_canonical(path);
  const bool is_sequence = folder.filename().string().rfind("seq-", 0) == 0;
  return (is_sequence ? folder.parent_path() : folder).stem().string();
}

std::string costText(const RecorderCost &cost) {
  return "  recorder at 30 Hz: depth alone " + fixed(cost.depth_cpu_percent, 1) +
         " % of one core, with raw colour " + fixed(cost.both_cpu_percent, 1) + " %; the file grows by " +
         fixed(1e-6 * cost.bytes_per_second, 1) + " MB/s\n";
}

int run(const RecordingCommandOptions &options, const Console &console) {
  if (!options.calibrations.empty() && options.calibrations.size() != options.recordings.size())
    throw UsageError("give a --calibration for each --recording, or none");
  FileUse files(options.force);
  for (const std::string &path : options.recordings) files.reads("--recording", path);
  for (const std::string &path : options.calibrations) files.reads("--calibration", path);
  files.writes("--results", options.results, holds(codecResults({})));
  files.writesRecording("--folder", options.folder + "/recorder_cost.mcap");
  files.check();
  std::vector<CodecTable> tables;
  nlohmann::ordered_json costs = nlohmann::ordered_json::array();
  for (size_t i = 0; i < options.recordings.size(); ++i) {
    RecordingOptions chosen;
    chosen.folder = options.recordings[i];
    chosen.calibration = options.calibrations.empty() ? "" : options.calibrations[i];
    chosen.step = options.step;
    const auto reader = openRecording(chosen);
    const DepthFrames depth = readDepth(reader.get(), console);
    {
      ProgressBar bar("measuring ");
      tables.push_back(runCodecBench(nameOf(chosen.folder), depth.width, depth.height, depth.frames,
                                     options.repeats,
                                     [&bar](uint32_t done, uint32_t total) { bar.show(done, total); }));
    }
    const RecorderCost cost = measureRecorder(reader.get(), options.folder);
    console.say("\n" + codecText(tables.back()) + costText(cost));
    costs.push_back({{"recording", tables.back().name},
                     {"depth_cpu_percent", cost.depth_cpu_percent},
                     {"both_cpu_percent", cost.both_cpu_percent},
                     {"bytes_per_second", cost.bytes_per_second}});
  }
  if (!options.results.empty()) writeFile(options.results, codecResults(tables));
  console.give({{"codecs", codecJson(tables)}, {"recorder", costs}});
  return kExitDone;
}

const char kRecordingHelp[] =
    "Encodes and decodes the depth images of a recording with each lossless codec in turn: how much smaller they\n"
    "become, and in what time; every image is compared with what comes back.  Then records all frames and says "
    "what\n"
    "share of one core the recorder takes at 30 Hz, its threads and the system's part included.";
const char kRecordingExample[] =
    "Example:\n"
    "  spherecloud-lab recording --recording seq-01 --calibration kinect.json\n"
    "What comes out: a table a recording.  docs/recording.md says what each codec is.";

}  // namespace

Command recordingCommand(CLI::App *root) {
  auto options = std::make_shared<RecordingCommandOptions>();
  CLI::App *app = root->add_subcommand("recording");
  app->description("Depth codecs side by side, and the cost of the recorder.\n\n" + std::string(kRecordingHelp));
  app->footer(kRecordingExample);
  app->add_option("-r,--recording", options->recordings, "Recording; repeat for more")
      ->required()
      ->expected(1)
      ->take_all()
      ->type_name("PATH");
  app->add_option("-c,--calibration", options->calibrations, "Its calibration file, in the same order")
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
  app->add_option("--step", options->step, "Take every N-th frame")
      ->capture_default_str()
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  addRepeatOption(app, &options->repeats);
  app->add_option("--folder", options->folder, "Where the recorder writes while it is measured")
      ->capture_default_str()
      ->type_name("DIR");
  app->add_option("--results", options->results, "Write ratios, no milliseconds")->type_name("FILE");
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
