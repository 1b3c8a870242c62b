// spherecloud record: cameras to one crash-safe file.
#include <csignal>
#include <filesystem>
#include <memory>
#include <new>
#include <system_error>

#include "host/base/checked_call.h"
#include "host/base/counted.h"
#include "host/base/usage_error.h"
#include "host/cameras/number_text.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/few_warnings.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/new_recording.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/point_source.h"
#include "host/cli/common/recording_out.h"
#include "host/cli/common/rig_options.h"
#include "host/cli/field_warnings.h"
#include "host/cli/record_guide.h"
#include "host/live/interrupt.h"
#include "host/live/rate.h"
#include "host/live/status_line.h"
#include "host/recording/recorder.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

struct RecordOptions {
  RigOptions rig;
  std::string out;
  double seconds = 0;
  bool guide = false;
  WalkGuide::Options guided;
  sphc_recorder_config recorder = {};
};

struct RecorderCloser {
  void operator()(sphc_recorder *recorder) const { sphc_recorder_close(&recorder, nullptr); }
};
using Recorder = std::unique_ptr<sphc_recorder, RecorderCloser>;

Recorder openRecorder(const std::string &path, const RecordOptions &options, const sphc_rig &calibration) {
  sphc_recorder *recorder = nullptr;
  orThrow("cannot record", [&](sphc_message *message) {
    return sphc_recorder_open(path.c_str(), &calibration, &options.recorder, &recorder, message);
  });
  return Recorder(recorder);
}

sphc_recorder_statistics statisticsOf(const sphc_recorder *recorder) {
  sphc_recorder_statistics statistics = {};
  statistics.struct_size = sizeof statistics;
  sphc_recorder_get_statistics(recorder, &statistics);
  return statistics;
}

// What was given to the recorder.
struct RecordTally {
  uint64_t color = 0, depth = 0, raw_bytes = 0;
  Rate color_rate, depth_rate;

  bool isEmpty() const { return color + depth == 0; }
  void count(const sphc_capture &capture) {
    const bool is_color = capture.stream == SPHC_STREAM_COLOR;
    ++(is_color ? color : depth);
    (is_color ? color_rate : depth_rate).count();
    for (const sphc_image &image : {capture.image, capture.amplitude})
      raw_bytes += uint64_t{image.stride_bytes} * image.height;
  }
};

std::string statusText(const sphc_recorder_statistics &s, const RecordTally &tally) {
  char text[160];
  std::snprintf(text, sizeof text, "%llu colour (%.0f/s), %llu depth (%.0f/s), %s; dropped %llu, never came %llu",
                static_cast<unsigned long long>(tally.color), tally.color_rate.hz(),
                static_cast<unsigned long long>(tally.depth), tally.depth_rate.hz(),
                humanBytes(static_cast<double>(s.file_bytes)).c_str(),
                static_cast<unsigned long long>(s.dropped_count), static_cast<unsigned long long>(s.missing_count));
  return text;
}

void sayResult(const RecordOptions &options, const RecordTally &tally, const sphc_recorder_statistics &s,
               const Rig &rig, RecordGuide *guide, const Console &console) {
  const uint64_t file_bytes = std::filesystem::file_size(options.out), pairs = rig.counts().pairs;
  console.say("Wrote " + options.out + ": " + counted(tally.color, "colour image") + " and " +
              counted(tally.depth, "depth image") + " (" + counted(pairs, "pair") + "), " +
              humanBytes(static_cast<double>(file_bytes)) + " of " +
              humanBytes(static_cast<double>(tally.raw_bytes)));
  console.say("Dropped: " + std::to_string(s.dropped_count) + ", never came: " + std::to_string(s.missing_count) +
              ", most waiting at once: " + std::to_string(s.queue_most));
  const std::string troubles = rig.troubles();
  if (!troubles.empty()) console.say(troubles);
  nlohmann::ordered_json json = {{"file", options.out},          {"color", tally.color},
                                 {"depth", tally.depth},         {"pairs", pairs},
                                 {"dropped", s.dropped_count},   {"missing", s.missing_count},
                                 {"raw_bytes", tally.raw_bytes}, {"file_bytes", file_bytes}};
  if (!guide) return console.give(json);
  json["guide"] = guide->end(console);
  console.giveLine(json);
}

// What a recording has that cameras have not.
void noteWhatStays(const Rig &rig, const Console &console) {
  if (!rig.replayed()) return;
  const recording::Recording &replayed = rig.replayed()->recording();
  const size_t poses = replayed.poses.poses().size(), accelerations = replayed.accelerations.size();
  if (poses + accelerations == 0) return;
  console.warn("note: left out: " + (poses ? counted(poses, "pose") : "") +
               (poses && accelerations ? " and " : "") +
               (accelerations ? counted(accelerations, "acceleration") : "") +
               " of the recording that is played; `spherecloud convert` keeps them");
}

// The guide sees pairs alone.
std::string guideText(RecordGuide *guide, const Rig &rig) {
  return rig.counts().pairs == 0 ? "no pair of images" : guide->text();
}

// Why no map can be made of what was recorded; "" where it has pairs.
std::string whyOfNoUse(const RecordTally &tally, const Rig &rig, double tolerance_ms) {
  if (tally.color == 0 || tally.depth == 0)
    return std::string("Not one ") +
           (tally.depth > 0   ? "colour "
            : tally.color > 0 ? "depth "
                              : "") +
           "image came, so no map can be made of this.";
  if (rig.counts().pairs > 0) return "";
  return "Not one colour image met a depth image within " + briefText(tolerance_ms) +
         " ms (--tolerance-ms); a map is made of such pairs.";
}

// Until the cameras end, a signal comes or the time is over.
void recordAll(const RecordOptions &options, const Interrupt &interrupt, Rig *rig, sphc_recorder *recorder,
               StatusLine *line, RecordTally *tally, RecordGuide *guide, const Rig::Tell &unusable) {
  rig->watch([recorder, tally, &options, &unusable](const sphc_capture &capture) {
    sphc_message message = {};
    const sphc_status status = sphc_recorder_add(recorder, &capture, &message);
    if (status == SPHC_OK) tally->count(capture);
    if (status == SPHC_E_ARGUMENT) return unusable(message.text);  // a time that does not grow
    const char *cure =
        status == SPHC_E_IMAGE ? "; choose that mode (--width, --height) or give its calibration" : "";
    if (status < 0) throw std::runtime_error(options.out + ": " + message.text + cure);
  });
  const auto begin = std::chrono::steady_clock::now();
  const auto is_over = [&] {
    return options.seconds > 0 &&
           std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() >= options.seconds;
  };
  while (!interrupt.came() && !is_over()) {
    CapturePair pair;
    const Rig::Got got = rig->next(kPairWait, &pair);
    if (got == Rig::Got::kEnd) break;
    if (got == Rig::Got::kPair) {
      if (guide) guide->see(pair);
      rig->release(pair);
    }
    line->show((guide ? guideText(guide, *rig) + " | " : "") + statusText(statisticsOf(recorder), *tally));
  }
  line->wipe();
}

int run(const RecordOptions &options, const Console &console) {
  checkRigOptions(options.rig);
  checkDepthRange(options.guided.depth_min_m, options.guided.depth_max_m);
  if (!isMcap(options.out)) throw UsageError("--out: the file's name must end with .mcap: " + options.out);
  FileUse files(false);
  files.reads(options.rig);
  files.writesRecording("--out", options.out);
  files.check();
  StatusLine line;
  FewWarnings unusable(console, "", "capture", " had such troubles");
  const auto tell_unusable = [&](const std::string &why) {
    line.wipe();
    unusable.add(why);
  };
  Rig rig(options.rig, [&](const std::string &trouble) {
    line.wipe();
    console.warn(trouble);
  });
  rig.hearUnreadable(tell_unusable);
  for (const std::string &camera : rig.descriptions()) console.say("Camera: " + camera);
  noteWhatStays(rig, console);
  const sphc_rig calibration = calibrationOf(options.rig, rig);
  warnOfField(calibration, console);
  const auto guide =
      options.guide ? std::make_unique<RecordGuide>(calibration, options.guided, rig.waits(), console) : nullptr;
  if (guide) std::signal(SIGPIPE, SIG_IGN);  // a recording outlives the program that reads the advice
  const Interrupt interrupt;                 // from before there is a file
  NewRecording recording(options.out, NewRecording::IfCut::kRemove);
  Recorder recorder = openRecorder(recording.part(), options, calibration);
  recording.isMade();
  const uintmax_t bytes_without_images = std::filesystem::file_size(recording.part());
  RecordTally tally;
  sphc_recorder_statistics statistics = {};
  try {
    recordAll(options, interrupt, &rig, recorder.get(), &line, &tally, guide.get(), tell_unusable);
    statistics = statisticsOf(recorder.get());
    sphc_recorder *ended = recorder.release();
    orThrow(options.out, [&](sphc_message *message) { return sphc_recorder_close(&ended, message); });
    recording.finish();
  } catch (const std::exception &error) {
    if (tally.isEmpty()) throw;  // a file without images would be in the way of the next try
    recorder.reset();            // writes what it can
    std::error_code unknown;
    const bool has_images = std::filesystem::file_size(recording.part(), unknown) > bytes_without_images;
    if (has_images) recording.keepIfCut();
    const bool is_memory = dynamic_cast<const std::bad_alloc *>(&error) != nullptr;
    throw std::runtime_error((is_memory ? "there was not enough memory" : std::string(error.what())) +
                             (has_images ? "; what was recorded until then is in " + recording.part()
                                         : "; no image was written, so no file is left"));
  }
  rig.endPairs();
  sayResult(options, tally, statistics, rig, guide.get(), console);
  const std::string why = whyOfNoUse(tally, rig, options.rig.tolerance_ms);
  if (why.empty()) return kExitDone;
  console.warn(why + " `spherecloud doctor` says what the cameras do.");
  return kExitFailure;
}

const char kRecordExample[] =
    "Example:\n"
    "  spherecloud record --color v4l2:/dev/video0 --depth v4l2:/dev/video2 -c headset.json --out walk.mcap\n"
    "  spherecloud record --device openni2: -c kinect.json --out walk.mcap --seconds 60\n"
    "  spherecloud record --device openni2: -c kinect.json --out walk.mcap --guide\n"
    "Ctrl-C or SIGTERM ends it.  The file plays everywhere a recording does, and opens in Foxglove.  Its name is\n"
    "walk.mcap.part until it is whole; after a crash that plays too, and `spherecloud convert` makes it whole.";

}  // namespace

Command recordCommand(CLI::App *root) {
  auto options = std::make_shared<RecordOptions>();
  sphc_recorder_config_init(&options->recorder, sizeof options->recorder);
  options->rig.wish.color_images = true;
  CLI::App *app = root->add_subcommand("record");
  app->description(
      "Record cameras into one file that survives a crash.\n\nEvery image is kept as it came, paired or not; what "
      "was lost or dropped is listed in the file.");
  app->footer(kRecordExample);
  addRigOptions(app, &options->rig);
  app->add_option("-o,--out", options->out, "The file, ending in .mcap")->required()->type_name("FILE");
  CLI::Option *guide = app->add_flag(
      "--guide", options->guide,
      "Say on the way what to do, so that `map` can make a map of the walk; with --json a line for each "
      "frame it sees");
  for (CLI::Option *option : addDepthRangeOptions(app, &options->guided.depth_min_m, &options->guided.depth_max_m))
    option->needs(guide);
  app->add_option("--seconds", options->seconds, "End after so long; 0: never")->check(notNegative());
  app->add_option("--jpeg", options->recorder.jpeg_quality,
                  "Colour as JPEG of this quality, 1 to 100; 0: as it came")
      ->capture_default_str()
      ->transform(wholeFrom(0, 100));
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
