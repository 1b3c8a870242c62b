// spherecloud localize: where was the camera, frame by frame?
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/base/counted.h"
#include "host/base/in_seconds.h"
#include "host/base/usage_error.h"
#include "host/base/write_file.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/few_warnings.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "host/cli/common/trust_options.h"
#include "host/cli/localizer_options.h"
#include "host/evaluate/kept_observations.h"
#include "host/evaluate/localize_run.h"
#include "host/evaluate/map_file.h"
#include "host/frames/recording.h"
#include "host/report/aligned_truth.h"
#include "host/report/json.h"
#include "host/report/overlay.h"
#include "host/report/page.h"
#include "host/report/report.h"
#include "host/report/statistics.h"
#include "host/report/table.h"
#include "host/report/trajectory.h"
#include "host/report/truth_words.h"

namespace sphc::host {
namespace {

constexpr double kManyContradictions = 10;  // per cent of the frames

struct LocalizeOptions {
  RecordingOptions recording;
  TrustOptions trust;
  std::vector<std::string> maps, owner_notes;
  std::string trajectory, frames_json, report;
  bool odometry = false, align = false, force = false;
  LocalizerOptions localizer;
};

FileUse fileUse(const LocalizeOptions &options) {
  FileUse files(options.force);
  files.reads(options.recording);
  for (const std::string &map : options.maps) files.reads("--map", map);
  for (const std::string &note : options.owner_notes) files.reads("--owner-note", note);
  readsTrust(options.trust, &files);
  files.writes("--trajectory", options.trajectory, holds(tumMark("localize")));
  files.writes("--frames-json", options.frames_json, holds("{\"sequence\":"));
  files.writesFolder("--report", options.report, holds(kReportHead));
  return files;
}

void readNotes(const LocalizeOptions &options, LocalizeInput *input, Run *run) {
  if (options.owner_notes.empty()) return;
  if (options.owner_notes.size() != options.maps.size())
    throw UsageError("--owner-note: give one for each --map, or none");
  for (size_t i = 0; i < options.maps.size(); ++i) {
    const Vector3 centre = centreByNote(options.owner_notes, input->maps[i], options.maps[i]);
    input->centres_in_world_m.push_back({centre.x(), centre.y(), centre.z()});
  }
  run->centres_m = input->centres_in_world_m;
  run->base = "world";
}

void noteUselessOdometry(const LocalizeOptions &options, const RecordingReader &reader, const Console &console) {
  if (reader.recording().poses.poses().empty())
    console.warn(std::string("note: --odometry: ") + kNoPoses + " to play");
  if (options.localizer.config.mode == SPHC_MODE_SINGLE)
    console.warn("note: --odometry: --mode single treats each frame alone, so odometry changes nothing");
}

// From a frame to the next, median; NaN of a single one.
double stepSeconds(const RecordingReader &reader) {
  std::vector<double> steps_s;
  for (uint32_t i = 1; i < reader.frameCount(); ++i)
    steps_s.push_back(inSeconds(reader.colorOf(i).time_ns - reader.colorOf(i - 1).time_ns));
  return percentile(steps_s, 0.5);
}

// They would be neither truth nor odometry without a word.
void notePosesOfOtherTimes(const LocalizeOptions &options, const RecordingReader &reader, const Console &console) {
  const size_t poses = reader.recording().poses.poses().size();
  if (poses == 0 || (!options.odometry && options.owner_notes.empty())) return;
  for (uint32_t i = 0; i < reader.frameCount(); ++i)
    if (reader.worldFromCamera(i)) return;
  console.warn("note: none of " + counted(poses, "pose") + ofOtherTimes(reader, reader.recording().poses));
}

Run localize(const LocalizeOptions &options, RecordingReader *reader, KeptObservations *observations,
             const Console &console) {
  Run run;
  run.recording = options.recording.folder + " (" + describeSelection(options.recording) + ")";
  LocalizeInput input;
  run.has_poses = !reader->recording().poses.poses().empty();
  input.maps = openMapFiles(options.maps, trustOf(options.trust));
  for (size_t i = 0; i < options.maps.size(); ++i) run.maps.push_back(mapFacts(input.maps[i], options.maps[i]));
  input.reader = reader;
  input.deadline_us = options.localizer.deadline_us;
  if (options.odometry) noteUselessOdometry(options, *reader, console);
  noteRowsThatStay(options.localizer, stepSeconds(*reader), console);
  notePosesOfOtherTimes(options, *reader, console);
  input.play_odometry = options.odometry;
  input.config = options.localizer.config;
  input.parameters = options.localizer.parameters;
  input.observations = observations;
  setCameras(reader->calibration(), &input.config);
  readNotes(options, &input, &run);
  run.settings = describeConfig(input.config, input.parameters);
  run.settings.push_back({"deadline_us", std::to_string(options.localizer.deadline_us)});
  run.settings.push_back({"odometry", options.odometry ? "played" : "none"});
  ProgressBar bar("localizing");
  FewWarnings warnings(console, "note: ", "frame", " could not be read");
  localizeFrames(
      input, [&bar](uint32_t done, uint32_t total) { bar.show(done, total); },
      [&warnings](const std::string &why) { warnings.add(why); }, &run);
  if (run.frames.empty()) refuseUnreadable();
  return run;
}

cv::Mat imageOf(RecordingReader *reader, const FrameRecord &frame) {
  const std::optional<sphc_localizer_frame> image = reader->tryRead(frame.index);
  return image ? bgrFromImage(image->color) : cv::Mat();
}

std::string writeReportOf(const std::string &folder, Run *run, RecordingReader *reader,
                          KeptObservations *observations, const Console &console) {
  for (const Highlight &shown : chooseHighlights(*run))
    run->frames[shown.frame].observations = observations->of(shown.frame);
  const ReportSummary report =
      writeReport(folder, *run, [reader](const FrameRecord &frame) { return imageOf(reader, frame); });
  if (!report.problem.empty()) console.warn("note: " + report.problem);
  return "Report with pictures: " + report.page;
}

// Gives a line to be said of each.
std::vector<std::string> writeOutputs(const LocalizeOptions &options, const Run &run) {
  std::vector<std::string> told;
  if (!options.trajectory.empty()) {
    writeFile(options.trajectory, tumTrajectory(run));
    told.push_back("Trajectory (" + run.base + "_from_camera): " + options.trajectory);
  }
  if (!options.frames_json.empty()) {
    writeFile(options.frames_json, framesJsonLines(run));
    told.push_back("A JSON line a frame: " + options.frames_json);
  }
  return told;
}

// Frames that contradict themselves have no pose; what is wrong with their cameras is wrong with the others' too.
void noteContradictions(const Summary &summary, const Console &console) {
  const uint32_t contradicting = summary.outcomes[SPHC_OUTCOME_CONTRADICTION];
  if (percent(contradicting, summary.frames) < kManyContradictions) return;
  uint32_t faults = 0;
  for (size_t i = 0; i < summary.faults.size(); ++i)
    if (summary.faults[i]) faults |= kFaultWords[i].bit;
  console.warn("note: " + std::to_string(contradicting) + " of " + counted(summary.frames, "frame") +
               " contradict themselves (" + faultNames(faults) +
               "): the poses of the others may be wrong too; check the cameras and the calibration by spherecloud "
               "doctor");
}

// Errors of other maps are told beside them.
void align(const Console &console, Run *run) {
  const std::vector<uint32_t> unaligned = alignTruth(run);
  if (run->aligned_frames == 0)
    return console.warn(std::string("note: --align: ") +
                        (run->has_poses ? "fewer than 3 localized frames have a pose in the recording" : kNoPoses) +
                        ", so no errors are known");
  for (const uint32_t map : unaligned)
    console.warn("note: --align: fewer than 3 frames localized in " + run->maps[map].path +
                 " have a pose in the recording, so their errors are not known");
}

// A path whose poses lie in the frames of several maps is none.  Nothing tells whether maps with notes share a
// world.
void noteMixedFrames(const LocalizeOptions &options, const Run &run, const Console &console) {
  const size_t maps = mapsWithAnswers(run);
  if (options.trajectory.empty() || maps < 2) return;
  console.warn(
      "note: --trajectory: its poses are of " + std::to_string(maps) + " maps" +
      (run.base == "map"
           ? ", each in the frame of its own; give --owner-note for each --map, or take --frames-json, which"
           : "; a map that spherecloud map made without given poses has a world of its own, and the path jumps "
             "where such a map begins; --frames-json") +
      " names the map of each pose");
}

int run(const LocalizeOptions &options, const Console &console) {
  fileUse(options).check();
  const auto reader = openRecording(options.recording);
  noteDamage(*reader, console);
  std::optional<KeptObservations> observations;
  if (!options.report.empty()) observations.emplace();
  Run done = localize(options, reader.get(), observations ? &*observations : nullptr, console);
  if (options.align) align(console, &done);
  const Summary summary = summarize(done);
  auto told = writeOutputs(options, done);  // before words, whose reader may be gone
  if (observations) told.push_back(writeReportOf(options.report, &done, reader.get(), &*observations, console));
  console.say(tableText(tableRows(done, summary)));
  for (const std::string &line : told) console.say(line);
  console.give(summaryJson(done, summary));
  noteMixedFrames(options, done, console);
  noteContradictions(summary, console);
  if (const std::string doubt = doubtOfTruth(done, summary); !doubt.empty()) console.warn("note: " + doubt);
  if (summary.localized > 0) return kExitDone;
  console.warn(
      summary.outcomes[SPHC_OUTCOME_DEADLINE] == summary.frames
          ? kAllTooLate
          : "Not one frame was localized. Is this the place that the map shows? Is the calibration right? The "
            "report (--report DIR) shows what the localizer saw.");
  return kExitNotLocalized;
}

const char kLocalizeHelp[] =
    "Gives every frame of a recording to the localizer, together with a map, and tells where the camera was.\n"
    "Frames go through the same C interface as on a device.  With the owner's note the answers come in the\n"
    "world that the map was made in and are compared with the recording's poses, where it has any; without it\n"
    "they are in the map's own frame.";
const char kLocalizeExample[] =
    "Example:\n"
    "  spherecloud localize --recording walk --first 100 --map room.sphc\n"
    "  spherecloud localize --recording walk --first 100 --map room.sphc \\\n"
    "      --owner-note room.sphc.owner.json --report report --trajectory path.tum\n"
    "  spherecloud localize -r kitchen -c kinect.json --first 620 --last 799 --mode single -m kitchen.sphc --json\n"
    "  spherecloud localize -r flat -m kitchen.sphc -m hall.sphc      which room, and where in it\n"
    "What comes out: one table; with --report a folder with report.html and pictures; with --trajectory a path\n"
    "that evo reads (evo_traj tum path.tum).  Exit status 3: it ran, but not one frame was localized.";

void addOutputs(CLI::App *app, LocalizeOptions *options) {
  const char *group = "Output";
  app->add_option("--trajectory", options->trajectory, "Localized poses in TUM format")
      ->type_name("FILE")
      ->group(group);
  app->add_option("--frames-json", options->frames_json, "A JSON line a frame")->type_name("FILE")->group(group);
  app->add_option("--report", options->report, "Folder for report.html and pictures")
      ->type_name("DIR")
      ->group(group);
  addForceOption(app, &options->force);
}

}  // namespace

Command localizeCommand(CLI::App *root) {
  auto options = std::make_shared<LocalizeOptions>();
  CLI::App *app = root->add_subcommand("localize");
  app->description("Find where the camera was, in a map.\n\n" + std::string(kLocalizeHelp));
  app->footer(kLocalizeExample);
  addRecordingOptions(app, &options->recording);
  addPosesOption(app, &options->recording);
  app->add_option("-m,--map", options->maps, "Map file; repeat for more rooms")
      ->required()
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
  app->add_option("--owner-note", options->owner_notes,
                  "Note that build wrote beside the map (FILE.owner.json); one for each map")
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
  app->add_flag("--align", options->align,
                "Compare after a rigid alignment of the recording's poses to the map: for maps of spherecloud map")
      ->needs("--owner-note");
  app->add_flag("--odometry", options->odometry,
                "Give the localizer the recording's poses as odometry, each step disturbed by 0.1 deg and 2 mm");
  addTrustOptions(app, &options->trust);
  addOutputs(app, options.get());
  addLocalizerOptions(app, &options->localizer);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
