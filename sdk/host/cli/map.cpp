// spherecloud map: from walks without poses, or with poses that are a little wrong, to a point model and a path.
#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <memory>
#include <system_error>

#include "host/base/counted.h"
#include "host/base/usage_error.h"
#include "host/base/write_file.h"
#include "host/calibration/compare.h"
#include "host/cli/commands.h"
#include "host/cli/common/choices.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/light_options.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/progress.h"
#include "host/cli/map_report.h"
#include "host/import/model_file.h"
#include "host/import/upright.h"
#include "host/mapping/calibration_fit.h"
#include "host/mapping/solver_memory.h"
#include "host/recording/calibration_json.h"
#include "host/report/trajectory.h"

namespace sphc::host {
namespace {

struct MapOptions {
  std::vector<std::string> recordings, trajectories, told;  // told: files of poses
  RecordingOptions of_each;                                 // of the recordings
  RgbdImportOptions import;
  PoseTrust trust;
  double sigma_deg = 1, drift_percent = 1, drift_deg = 1;
  sphc_band band = SPHC_BAND_VISIBLE;
  std::string model, refined_calibration;
  uint32_t threads = 0;
  bool score = false, force = false;

  MappingOptions mapping() const {
    MappingOptions mapping;
    mapping.trust = trust;
    mapping.threads = threads;
    mapping.judges_told = judgesTold();
    return mapping;
  }
  // The poses of the recording are not used, but compared.  Those of several are in several worlds.
  bool judgesTold() const { return score && trust.use == PoseUse::kNone && recordings.size() == 1; }
  std::vector<RecordingOptions> all() const {
    std::vector<RecordingOptions> all(recordings.size(), of_each);
    for (size_t i = 0; i < all.size(); ++i) all[i].folder = recordings[i];
    return all;
  }
};

// A bar for each of the mapper's steps.
class Steps {
 public:
  void show(const std::string &what, uint32_t done, uint32_t total) {
    if (what != what_) bar_ = std::make_unique<ProgressBar>(what);
    what_ = what;
    bar_->show(done, total);
  }

 private:
  std::string what_;
  std::unique_ptr<ProgressBar> bar_;
};

std::optional<sphc_rigid> poseOf(const recording::PoseTrack &path, int64_t time_ns) {
  return path.at(time_ns, recording::ReaderOptions().pose_gap_ns);
}

// What the recording, or the file of poses, tells of its keyframes.
void tell(const MapOptions &options, size_t recording, const RecordingReader &reader, Walk *walk) {
  recording::PoseTrack file;
  uint32_t bad = 0;
  if (!options.told.empty()) file = recording::readTumPoses(options.told[recording], &bad);
  for (WalkFrame &frame : walk->keyframes) {
    const std::optional<sphc_rigid> told =
        options.told.empty() ? reader.worldFromCamera(frame.index) : poseOf(file, frame.time_ns);
    if (told) frame.told_world_from_camera = rigidFromC(*told);
  }
}

void checkTold(const MapOptions &options, const Walk &walk) {
  if (options.trust.use == PoseUse::kNone) return;
  for (const WalkFrame &frame : walk.keyframes)
    if (frame.told_world_from_camera) return;
  throw std::runtime_error(
      options.told.empty() ? "--poses: the recording holds no pose; give --poses-from FILE, or leave --poses out"
                           : "--poses-from: no pose is of the time of a frame; is it the file of this recording?");
}

std::vector<MappedRecording> openAll(const MapOptions &options) {
  std::vector<MappedRecording> recordings;
  for (const RecordingOptions &recording : options.all())
    recordings.push_back({recording.folder, openRecording(recording), {}});
  return recordings;
}

// `trial`: in place of the recordings' calibrations; null: those.
Walk readAll(const MapOptions &options, const TrialCalibration *trial,
             const std::vector<MappedRecording> &recordings, Steps *steps) {
  FrameReaderOptions frames;
  frames.depth_min_m = options.import.depth_min_m;
  frames.depth_max_m = options.import.depth_max_m;
  frames.surfaces = trial && trial->surfaces;
  std::vector<Walk> walks;
  for (const MappedRecording &recording : recordings) {
    const std::string what = recordings.size() > 1 ? "reading " + recording.name : "reading";
    walks.push_back(readWalk(recording.reader.get(), trial ? trial->rig : recording.reader->calibration(), frames,
                             [&](uint32_t done, uint32_t total) { steps->show(what, done, total); }));
    if (options.trust.use != PoseUse::kNone || options.judgesTold())
      tell(options, walks.size() - 1, *recording.reader, &walks.back());
  }
  return joinWalks(std::move(walks));
}

sphc_rig commonCalibration(const std::vector<MappedRecording> &recordings) {
  const sphc_rig &rig = recordings.front().reader->calibration();
  for (const MappedRecording &recording : recordings)
    if (recording::calibrationToJson(recording.reader->calibration()) != recording::calibrationToJson(rig))
      throw UsageError("--refine-calibration: the calibrations of " + recordings.front().name + " and " +
                       recording.name + " differ; refine that of each alone, or give --calibration for both");
  return rig;
}

constexpr uint64_t kLeastMappedOf = 3;  // one of so many frames is to find a place
constexpr double kMostRefinedPx = 25;   // 1.5 % of focal length, 6 px, 0.7 degrees and 11 mm together are 20

void tellOfFit(const MapOptions &options, const CalibrationFit &fit, const CalibrationDifference &moved,
               const Console &console) {
  if (fit.rounds == 0) {
    console.say("The calibration stays as it is, in " + options.refined_calibration +
                " too: the walk agrees with no other by much better.");
    return;
  }
  console.say("Calibration refined: " + options.refined_calibration + ". Keypoints are off by " +
              fixed(fit.after.ray_sigmas, 2) + " sigma, where they were by " + fixed(fit.before.ray_sigmas, 2) +
              ", and depths by " + fixed(1000 * fit.after.depth_off_m, 1) + " mm, where they were by " +
              fixed(1000 * fit.before.depth_off_m, 1) + " (medians). Rays of the colour camera moved by up to " +
              fixed(moved.color.largest_px, 1) + " px, depth at 1 m by up to " +
              fixed(moved.depth_to_color[1].largest_px, 1) + " px in the colour image.");
  if (std::max(moved.color.largest_px, moved.depth_to_color[1].largest_px) > kMostRefinedPx)
    console.warn(
        "note: that is more than a calibration is off that is a little off, so the refined one may be wrong "
        "too: is the given one of these cameras, is color_from_depth inverted or in millimetres? "
        "`spherecloud doctor` compares edges");
}

// Writes the calibration that the walk agrees with best; the map is then made with it.  How far it moved pixels.
CalibrationDifference refineCalibration(MapOptions *options, const Console &console) {
  const std::vector<MappedRecording> recordings = openAll(*options);
  const sphc_rig given = commonCalibration(recordings);
  Steps steps;
  const auto read = [&](const TrialCalibration &trial) { return readAll(*options, &trial, recordings, &steps); };
  const CalibrationFit fit = fitCalibration(
      given, read, options->mapping(),
      [&](const std::string &what, uint32_t done, uint32_t total) { steps.show(what, done, total); });
  recording::writeCalibration(options->refined_calibration, fit.calibration);
  options->of_each.calibration = options->refined_calibration;
  const CalibrationDifference moved = compareCalibrations(given, fit.calibration);
  tellOfFit(*options, fit, moved, console);
  return moved;
}

void takePoses(MapOutcome *outcome) {
  const Walk &walk = outcome->walk;
  const FramePoses &mapped = outcome->mapped.world_from_camera;
  for (MappedRecording &recording : outcome->recordings) recording.poses.resize(recording.reader->frameCount());
  for (size_t i = 0; i < walk.keyframes.size(); ++i)
    outcome->recordings[walk.keyframes[i].recording].poses[walk.keyframes[i].index] = mapped[i];
  for (const Follower &follower : walk.followers)
    if (const auto &keyframe = mapped[follower.keyframe])
      outcome->recordings[follower.recording].poses[follower.index] = *keyframe * follower.keyframe_from_frame;
}

// Turns the world so that up is +z, where the recordings say what that is.
void standUpright(const MapOptions &options, MapOutcome *outcome) {
  if (options.trust.use == PoseUse::kApproximate || options.trust.keeps_axes) return;  // the world is given
  std::vector<FeltPath> paths;
  for (const MappedRecording &recording : outcome->recordings) {
    FeltPath path;
    path.felt = recording.reader->recording().accelerations;
    if (path.felt.empty()) continue;
    path.world_from_camera = recording.path();
    paths.push_back(std::move(path));
  }
  outcome->vertical = measureVertical(paths);
  if (!outcome->vertical.isKnown()) return;
  const Rigid upright_from_world = {uprightAxes(-outcome->vertical.up_world), Vector3::Zero()};
  for (std::optional<Rigid> &pose : outcome->mapped.world_from_camera)
    if (pose) pose = upright_from_world * *pose;
  takePoses(outcome);
}

void score(MappedRecording *recording) {
  std::vector<PosePair> pairs;
  double squared_m2 = 0;
  for (uint32_t i = 0; i < recording->poses.size(); ++i) {
    const std::optional<sphc_rigid> truth = recording->reader->worldFromCamera(i);
    if (!recording->poses[i] || !truth) continue;
    pairs.push_back({*recording->poses[i], rigidFromC(*truth)});
    squared_m2 += (pairs.back().estimated.translation_m - pairs.back().truth.translation_m).squaredNorm();
  }
  if (pairs.size() < kFewestScored) return;
  recording->score = scoreTrajectory(pairs);
  recording->is_truth_inverse = isTruthInverse(pairs);
  recording->unaligned_rmse_m = std::sqrt(squared_m2 / static_cast<double>(pairs.size()));
}

// The recordings' points, seen by the keyframes from the poses that were found.
ImportedPoints importFrom(const MapOptions &options, const MapOutcome &outcome) {
  std::vector<std::vector<bool>> is_keyframe;
  std::vector<recording::PoseTrack> paths;
  for (const MappedRecording &recording : outcome.recordings) {
    is_keyframe.emplace_back(recording.poses.size());
    paths.push_back(recording.path());
  }
  for (const WalkFrame &frame : outcome.walk.keyframes) is_keyframe[frame.recording][frame.index] = true;
  std::vector<RgbdSource> sources;
  for (size_t r = 0; r < outcome.recordings.size(); ++r) {
    const MappedRecording &recording = outcome.recordings[r];
    sources.push_back({recording.reader.get(),
                       [&, r](uint32_t i) { return is_keyframe[r][i] && recording.poses[i]; },
                       [&, r](int64_t time_ns) { return poseOf(paths[r], time_ns); }});
  }
  ImportedPoints points = importRecordings(sources, options.import, describeSelection(options.of_each));
  points.model.band = options.band;
  return points;
}

std::string trajectoryText(const MappedRecording &recording) {
  std::string text = tumHead("world", "map");
  for (uint32_t i = 0; i < recording.poses.size(); ++i)
    if (recording.poses[i]) text += tumLine(recording.reader->colorOf(i).time_ns, rigidToC(*recording.poses[i]));
  return text;
}

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

MapOutcome mapRecordings(const MapOptions &options, const Console &console) {
  const auto start = std::chrono::steady_clock::now();
  const double processor_start = processorSeconds();
  MapOutcome outcome;
  Steps steps;
  outcome.use = options.trust.use;
  outcome.recordings = openAll(options);
  for (const MappedRecording &recording : outcome.recordings) noteDamage(*recording.reader, console);
  outcome.walk = readAll(options, nullptr, outcome.recordings, &steps);
  checkTold(options, outcome.walk);
  for (MappedRecording &recording : outcome.recordings) recording.times = timesOf(*recording.reader);
  outcome.mapped =
      mapWalk(outcome.walk, options.mapping(),
              [&](const std::string &what, uint32_t done, uint32_t total) { steps.show(what, done, total); });
  outcome.stretches = stretchesOf(outcome.walk, outcome.mapped.parts, outcome.mapped.world_from_camera);
  takePoses(&outcome);
  standUpright(options, &outcome);
  if (options.score)
    for (MappedRecording &recording : outcome.recordings) score(&recording);
  outcome.processor_seconds = processorSeconds() - processor_start;
  outcome.import = importFrom(options, outcome);
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

// A model of next to nothing of the walk would pass for one of the place.
void checkMapped(const MapOutcome &outcome) {
  uint64_t frames = 0, mapped = 0;
  for (const MappedRecording &recording : outcome.recordings) {
    frames += recording.poses.size();
    mapped += recording.framesMapped();
  }
  if (kLeastMappedOf * mapped >= frames) return;
  throw std::runtime_error(
      "only " + std::to_string(mapped) + " of " + counted(frames, "frame") +
      " found a place, fewer than a third, so no model was written; walk once more, slowly, in good light and "
      "where "
      "there is much to see, or choose the frames of the part that is worth a map by --first and --last");
}

// Two of one would agree with each other on everything, and count twice.
void checkDifferent(const std::vector<std::string> &recordings) {
  for (size_t i = 0; i < recordings.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      std::error_code error;
      if (std::filesystem::equivalent(recordings[j], recordings[i], error))
        throw UsageError("--recording: " + recordings[j] + " and " + recordings[i] +
                         " are one recording; give each once");
    }
}

void checkCount(const char *option, const std::vector<std::string> &files, size_t recordings) {
  if (!files.empty() && files.size() != recordings)
    throw UsageError(std::string(option) + " is given " + counted(files.size(), "time") + " for " +
                     counted(recordings, "recording") + "; give it once for each, in the same order");
}

// Each of these says how much to believe of poses in one use of them.
void checkTrust(const CLI::App &app, PoseUse use) {
  const struct {
    const char *option, *poses;
    PoseUse use;
  } known[] = {{"--pose-sigma", "approximate", PoseUse::kApproximate},
               {"--pose-sigma-deg", "approximate", PoseUse::kApproximate},
               {"--drift", "odometry", PoseUse::kOdometry},
               {"--drift-deg", "odometry", PoseUse::kOdometry}};
  for (const auto &one : known)
    if (app.count(one.option) > 0 && use != one.use)
      throw UsageError(std::string(one.option) + " is of --poses " + one.poses + "; give that, or leave it out");
}

void check(const MapOptions &options) {
  FileUse files(options.force);
  for (const RecordingOptions &recording : options.all()) files.reads(recording);
  for (const std::string &file : options.told) files.reads("--poses-from", file);
  files.writes("--model", options.model, isModelFile);
  for (const std::string &file : options.trajectories) files.writes("--trajectory", file, holds(tumMark("map")));
  files.writes("--refine-calibration", options.refined_calibration, never());
  files.check();
  checkDifferent(options.recordings);
  checkMappingOptions(options.import);
  checkCount("--trajectory", options.trajectories, options.recordings.size());
  checkCount("--poses-from", options.told, options.recordings.size());
  if (options.trust.use == PoseUse::kNone && !options.told.empty())
    throw UsageError("--poses-from needs --poses, which says how much to believe of them");
  if (options.trust.use != PoseUse::kOdometry && options.trust.keeps_axes)
    throw UsageError("--upright needs --poses odometry; approximate poses keep the recording's world anyway");
}

int run(const CLI::App &app, MapOptions options, const Console &console) {
  check(options);
  checkTrust(app, options.trust.use);
  callNewHandlerForCholmod();
  options.trust.sigma_rad = options.sigma_deg * kPi / 180;
  options.trust.drift_m = options.drift_percent / 100;
  options.trust.drift_rad = options.drift_deg * kPi / 180;
  std::optional<CalibrationDifference> refined;
  if (!options.refined_calibration.empty()) refined = refineCalibration(&options, console);
  const MapOutcome outcome = mapRecordings(options, console);
  console.say(tableText(mapTable(outcome)));
  warnOfMap(outcome, console);
  for (const MappedRecording &recording : outcome.recordings) {
    if (options.score && recording.framesMapped() > 0 && !recording.score)
      console.warn("note: no score of " + recording.name +
                   ": fewer than 3 frames have a pose that was found and one that the recording holds");
  }
  checkMapped(outcome);
  writeModelFile(options.model, outcome.import.model);
  console.say(outcome.import.told);
  console.say("Wrote " + options.model +
              ": where every point is. Keep it, never ship it. Next:\n  spherecloud build "
              "--model " +
              options.model + " --map room.sphc");
  for (size_t i = 0; i < options.trajectories.size(); ++i) {
    writeFile(options.trajectories[i], trajectoryText(outcome.recordings[i]));
    console.say("Trajectory (world_from_camera): " + options.trajectories[i]);
  }
  nlohmann::ordered_json json = {{"model", options.model}};
  json.update(mapJson(outcome));
  if (options.trajectories.size() == 1) json["trajectory"] = options.trajectories[0];
  if (refined)
    json["refined_calibration"] = {{"path", options.refined_calibration},
                                   {"color_px", refined->color.largest_px},
                                   {"depth_at_1_m_px", refined->depth_to_color[1].largest_px}};
  console.give(json);
  return outcome.isApart() ? kExitWalkApart : kExitDone;
}

void addPoseOptions(CLI::App *app, MapOptions *options) {
  const char *group = "Poses that are known";
  CLI::Option *poses =
      app->add_option("--poses", options->trust.use,
                      "What to believe of the recording's poses [none]:\n"
                      "  none          nothing\n"
                      "  odometry      how neighbouring frames moved; it drifts\n"
                      "  approximate   where each frame was, but for noise; the map is in their world")
          ->transform(oneOf<PoseUse>(
              {{"none", PoseUse::kNone}, {"odometry", PoseUse::kOdometry}, {"approximate", PoseUse::kApproximate}}))
          ->type_name("HOW")
          ->group(group);
  app->add_option("--poses-from", options->told,
                  "File of poses in TUM format, in place of the recording's; once for each recording")
      ->allow_extra_args(false)
      ->type_name("FILE")
      ->group(group);
  app->add_option("--pose-sigma", options->trust.sigma_m, "Approximate: how far places are off, metres, 1 sigma")
      ->capture_default_str()
      ->check(between(1e-4, 10))
      ->needs(poses)
      ->type_name("M")
      ->group(group);
  app->add_option("--pose-sigma-deg", options->sigma_deg, "Approximate: how far they are turned, degrees")
      ->capture_default_str()
      ->check(between(1e-3, 90))
      ->needs(poses)
      ->type_name("DEG")
      ->group(group);
  app->add_option("--drift", options->drift_percent,
                  "Odometry: how far a metre of the way is off, per cent, 1 sigma")
      ->capture_default_str()
      ->check(between(0, 100))
      ->needs(poses)
      ->type_name("PERCENT")
      ->group(group);
  app->add_option("--drift-deg", options->drift_deg, "Odometry: how far a metre turns it, degrees")
      ->capture_default_str()
      ->check(between(0, 90))
      ->needs(poses)
      ->type_name("DEG")
      ->group(group);
  app->add_flag("--upright", options->trust.keeps_axes,
                "Odometry: the axes of its world become the map's, so that what is vertical there is so here")
      ->group(group);
}

const char kMapHelp[] =
    "Finds where each frame of a walk was taken from, by its images and depths, and makes the private point model\n"
    "that build makes a map of.  Poses that the recording holds are not used, unless --poses says what to believe "
    "of\n"
    "them; --score compares with them.  Several recordings of one place become one map; what later ones see "
    "through\n"
    "is gone and left out.  Where a recording has accelerations, up is +z in the map.";
const char kMapExample[] =
    "Example:\n"
    "  spherecloud record --color v4l2:/dev/video0 --depth v4l2:/dev/video2 -c headset.json --out walk.mcap\n"
    "  spherecloud map    --recording walk.mcap --model room.model --trajectory walk.tum\n"
    "  spherecloud build  --model room.model --map room.sphc\n"
    "  spherecloud map    --recording monday.mcap --recording friday.mcap --model room.model\n"
    "  spherecloud map    --recording walk.mcap --model room.model --refine-calibration headset2.json\n"
    "  spherecloud map    --recording walk.mcap --poses odometry --poses-from headset.tum --model room.model\n"
    "The world is the first frame's camera, in metres.  Exit status 6: parts of the walk never met, the model is "
    "of\n"
    "the largest; stderr says which, and where to walk once more.";

}  // namespace

Command mapCommand(CLI::App *root) {
  auto options = std::make_shared<MapOptions>();
  CLI::App *app = root->add_subcommand("map");
  app->description("Make a point model from a recording without poses.\n\n" + std::string(kMapHelp));
  app->footer(kMapExample);
  addRecordingsOptions(app, &options->recordings, &options->of_each);
  app->add_option("--model", options->model, "Private file for the points, for build --model")
      ->required()
      ->type_name("FILE");
  app->add_option("--trajectory", options->trajectories,
                  "Poses of all frames in TUM format; once for each recording, in the same order")
      ->allow_extra_args(false)
      ->type_name("FILE");
  app->add_option("--refine-calibration", options->refined_calibration,
                  "Adjust the calibration too, write it there and map with it; about three times as long")
      ->type_name("FILE");
  app->add_option("--threads", options->threads, "At most so many; 0: one for each core")
      ->capture_default_str()
      ->check(CLI::Range(0, 256).description(""))
      ->type_name("N");
  app->add_flag("--score", options->score, "Compare with the recording's own poses");
  addPoseOptions(app, options.get());
  addMappingOptions(app, &options->import);
  addBandOption(app, &options->band, "The light of the images; a camera must see the same to localize in the map");
  addForceOption(app, &options->force);
  return {app, [app, options](const Console &console) { return run(*app, *options, console); }};
}

}  // namespace sphc::host
