// spherecloud live: cameras and a map; where is the camera now?
#include <cmath>
#include <memory>

#include "host/base/checked_call.h"
#include "host/base/counted.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/few_warnings.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/rig_options.h"
#include "host/cli/common/trust_options.h"
#include "host/cli/field_warnings.h"
#include "host/cli/live_pose.h"
#include "host/cli/localizer_options.h"
#include "host/evaluate/localize_run.h"
#include "host/evaluate/map_file.h"
#include "host/live/interrupt.h"
#include "host/live/pair_frame.h"
#include "host/live/pair_silence.h"
#include "host/live/rate.h"
#include "host/live/status_line.h"
#include "host/report/fault_words.h"
#include "host/report/hint_words.h"

namespace sphc::host {
namespace {

struct LiveOptions {
  RigOptions rig;
  TrustOptions trust;
  std::vector<std::string> maps;
  uint32_t frames = 0;
  double seconds = 0;
  bool every = false;
  LocalizerOptions localizer;
};

const char kNotLocalized[] =
    "Not one frame was localized. Is this the place that the map shows? `spherecloud doctor` says whether cameras "
    "and calibration are right.";
const char kNoDepth[] =
    "Not one frame had depth in range where the image shows something: does depth fall on the colour image by "
    "color_from_depth of the calibration (metres, from depth to colour, x right, y down, z forward)? `spherecloud "
    "doctor` compares them.";
const char kNoPair[] = "Not one pair of images came. `spherecloud doctor` says what the cameras do.";

struct LiveTally {
  uint32_t frames = 0, localized = 0, too_late = 0, skipped = 0;
  double total_ms = 0;
  Rate color, depth, poses;
  std::array<uint32_t, kFaultWords.size()> faults = {};  // frames that name each
  std::array<uint32_t, kHintWords.size()> hints = {};    // the same
};

bool hadNoDepthAtAll(const LiveTally &tally) {
  for (size_t i = 0; i < kHintWords.size(); ++i)
    if (kHintWords[i].bit == SPHC_HINT_NO_DEPTH_IN_RANGE) return tally.hints[i] == tally.frames;
  return false;
}

const char *whyNotLocalized(const LiveTally &tally) {
  if (tally.frames == 0) return kNoPair;
  if (tally.too_late == tally.frames) return kAllTooLate;
  return hadNoDepthAtAll(tally) ? kNoDepth : kNotLocalized;
}

LiveNumbers numbersOf(const LiveTally &tally, const Rig &rig, double ms) {
  const sphc_pairer_counts counts = rig.counts();
  return {tally.color.hz(), tally.depth.hz(), tally.poses.hz(), counts.color_lost + counts.depth_lost, ms};
}

nlohmann::ordered_json frameJson(const CapturePair &pair, const sphc_localizer_result &result, double ms) {
  nlohmann::ordered_json out = {
      {"time_ns", result.time_ns},
      {"color_sequence", pair.color.sequence},
      {"depth_sequence", pair.depth.sequence},
      {"state", stateName(result.state)},
      {"localized", result.outcome == SPHC_OUTCOME_LOCALIZED},
      {"outcome", outcomeName(result.outcome)},
      {"map", result.map_id == SPHC_MAP_NONE ? nlohmann::ordered_json() : nlohmann::ordered_json(result.map_id)},
      {"faults", faultNames(result.faults)},
      {"cuts", cutNames(result.cuts)},
      {"hints", hintNames(result.hints)},
      {"inliers", result.inliers},
      {"ms", std::round(1000 * ms) / 1000}};
  if (result.outcome != SPHC_OUTCOME_LOCALIZED) return out;
  out["events"] = eventNames(result.events);
  out["jump"] = {{"rotation_deg", result.jump_rad * 180 / M_PI}, {"translation_m", result.jump_m}};
  out["confidence"] = result.confidence;
  out["camera_from_map"] = {{"q_wxyz", result.camera_from_map.q_wxyz}, {"t_m", result.camera_from_map.t_m}};
  return out;
}

// When frames come faster than they are looked at, the newest is the one that matters.
uint32_t skipToNewest(Rig *rig, CapturePair *pair) {
  uint32_t skipped = 0;
  CapturePair newer;
  while (rig->next(std::chrono::milliseconds(0), &newer) == Rig::Got::kPair) {
    rig->release(*pair);
    *pair = newer;
    ++skipped;
  }
  return skipped;
}

void checkAmplitude(const LiveOptions &options, const CapturePair &pair) {
  if (options.localizer.config.amplitude_min == 0 || pair.depth.amplitude.data) return;
  throw std::runtime_error("frame " + std::to_string(pair.color.sequence) +
                           ": the depth camera gave no amplitudes; leave --amplitude-min out");
}

void lookAt(const CapturePair &pair, const LiveOptions &options, const Rig &rig, const Console &console,
            spherecloud::Localizer *localizer, StatusLine *line, LiveTally *tally) {
  sphc_localizer_result result = spherecloud::emptyResult();
  const auto begin = std::chrono::steady_clock::now();
  sphc_localizer_frame frame = frameOf(pair);
  frame.deadline_us = options.localizer.deadline_us;
  const spherecloud::Status status = localizer->process(frame, &result);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  if (status.failed())
    throw std::runtime_error("frame " + std::to_string(pair.color.sequence) + ": " + status.text() +
                             "; does the calibration belong to these cameras?");
  ++tally->frames;
  tally->localized += result.outcome == SPHC_OUTCOME_LOCALIZED;
  tally->too_late += result.outcome == SPHC_OUTCOME_DEADLINE;
  tally->total_ms += ms;
  countBits(kFaultWords, result.faults, &tally->faults);
  countBits(kHintWords, result.hints, &tally->hints);
  if (result.outcome == SPHC_OUTCOME_LOCALIZED) tally->poses.count();
  console.giveLine(frameJson(pair, result, ms));
  line->show(liveLine(result, options.maps, numbersOf(*tally, rig, ms)));
}

bool isOver(const LiveOptions &options, const LiveTally &tally, std::chrono::steady_clock::time_point begin) {
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return (options.frames > 0 && tally.frames >= options.frames) ||
         (options.seconds > 0 && elapsed_s >= options.seconds);
}

void sayTally(const LiveTally &tally, const Rig &rig, const Console &console) {
  console.say("Frames processed: " + std::to_string(tally.frames) +
              ", localized: " + std::to_string(tally.localized) +
              (tally.skipped ? ", skipped: " + std::to_string(tally.skipped) : ""));
  for (size_t i = 0; i < kFaultWords.size(); ++i)
    if (tally.faults[i])
      console.say("FAULT in " + counted(tally.faults[i], "frame") + ", " + kFaultWords[i].name + ": " +
                  kFaultWords[i].cure);
  for (size_t i = 0; i < kHintWords.size(); ++i)
    if (tally.hints[i])
      console.say("No pose in " + counted(tally.hints[i], "frame") + ", " + kHintWords[i].name + ": " +
                  kHintWords[i].cure);
  if (tally.frames > 0) console.say("Time a frame: " + fixed(tally.total_ms / tally.frames, 2) + " ms, mean");
  console.say(unpairedText(rig.counts()));
  const std::string troubles = rig.troubles();
  if (!troubles.empty()) console.warn(troubles);
}

int run(const LiveOptions &options, const Console &console) {
  checkRigOptions(options.rig);
  const std::vector<MapFile> maps = openMapFiles(options.maps, trustOf(options.trust));
  StatusLine line;
  FewWarnings unreadable(console, "", "capture", " had such troubles");
  const auto warn = [&](const std::string &trouble) {
    line.wipe();
    console.warn(trouble);
  };
  Rig rig(options.rig, warn);
  rig.hearUnreadable([&](const std::string &why) {
    line.wipe();
    unreadable.add(why);
  });
  for (const std::string &camera : rig.descriptions()) console.say("Camera: " + camera);
  sphc_localizer_config config = options.localizer.config;
  const sphc_rig calibration = calibrationOf(options.rig, rig);
  warnOfField(calibration, console);
  noteRowsThatStay(options.localizer, NAN, console);
  setCameras(calibration, &config);
  spherecloud::Localizer localizer = makeLocalizer(config, maps, options.localizer.parameters);
  LiveTally tally;
  rig.watch([&](const sphc_capture &c) { (c.stream == SPHC_STREAM_COLOR ? tally.color : tally.depth).count(); });
  const bool every = options.every || rig.waits();
  const Interrupt interrupt;
  PairSilence silence;
  const auto begin = std::chrono::steady_clock::now();
  while (!interrupt.came() && !isOver(options, tally, begin)) {
    CapturePair pair;
    const Rig::Got got = rig.next(kPairWait, &pair);
    if (got == Rig::Got::kEnd) break;
    if (const std::string told = silence.hear(got, rig); !told.empty()) warn(told);
    if (got == Rig::Got::kNothing) {
      line.show("no pair of images; " + rig.troubles());
      continue;
    }
    const uint32_t losses = rig.losses();
    if (!every) tally.skipped += skipToNewest(&rig, &pair);
    if (rig.losses() != losses) {  // the images went with the camera
      rig.release(pair);
      continue;
    }
    checkAmplitude(options, pair);
    lookAt(pair, options, rig, console, &localizer, &line, &tally);
    rig.release(pair);
  }
  line.wipe();
  sayTally(tally, rig, console);
  if (tally.localized > 0) return kExitDone;
  console.warn(whyNotLocalized(tally));
  return kExitNotLocalized;
}

const char kLiveExample[] =
    "Example:\n"
    "  spherecloud live --color v4l2:/dev/video0 --depth v4l2:/dev/video2 -c headset.json --map room.sphc\n"
    "  spherecloud live --color libcamera: --depth v4l2:card=ToF -c headset.json --map room.sphc --json\n"
    "  spherecloud live --device openni2: -c kinect.json --map room.sphc --seconds 60\n"
    "Ctrl-C or SIGTERM ends it.  A camera that is unplugged is waited for.  Exit status 3: not one frame was "
    "localized.";

}  // namespace

Command liveCommand(CLI::App *root) {
  auto options = std::make_shared<LiveOptions>();
  CLI::App *app = root->add_subcommand("live");
  app->description(
      "Capture, pair, localize: where is the camera now?\n\n"
      "On a terminal one line shows rates a second (colour and depth images in, poses out), images lost,\n"
      "the pose and its confidence; with --json a line of JSON comes for every frame.");
  app->footer(kLiveExample);
  addRigOptions(app, &options->rig);
  app->add_option("-m,--map", options->maps, "Map file; repeat for more rooms")
      ->required()
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
  addTrustOptions(app, &options->trust);
  app->add_option("--frames", options->frames, "End after so many frames; 0: never")
      ->transform(wholeFrom(0, UINT32_MAX));
  app->add_option("--seconds", options->seconds, "End after so long; 0: never")->check(notNegative());
  app->add_flag("--every", options->every, "Process every frame, however late; else only the newest");
  addLocalizerOptions(app, &options->localizer);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
