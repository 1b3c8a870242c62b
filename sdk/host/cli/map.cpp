// spherecloud map: from a walk without poses to a point model and a path.
#include <chrono>
#include <ctime>
#include <memory>

#include "host/base/write_file.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/light_options.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/point_source.h"
#include "host/cli/common/progress.h"
#include "host/import/model_file.h"
#include "host/mapping/stretches.h"
#include "host/mapping/walk_mapper.h"
#include "host/report/hint_words.h"
#include "host/report/table.h"
#include "host/report/trajectory.h"
#include "host/report/trajectory_score.h"

namespace sphc::host {
namespace {

// Residuals that a sound recording does not have.  Depths far off: redkitchen 2.7 %, hololens 0.8 %; redkitchen as
// if its depth lay on the image 12.8 %, with a focal length 10 % off 10.8 %.  Keypoints, median: 0.2 to 0.9 sigma.
constexpr double kMostFarDepths = 0.06, kMostRaySigmas = 2;

struct MapOptions {
  PointSource source;
  sphc_band band = SPHC_BAND_VISIBLE;
  std::string model, trajectory;
  bool score = false, force = false;
};

// What a frame of the recording got; none of those that found no place.
using RecordingPoses = std::vector<std::optional<Rigid>>;

struct Outcome {
  Walk walk;
  MappedWalk mapped;
  Stretches stretches;
  RecordingPoses poses;
  std::optional<TrajectoryScore> score;
  ImportedPoints import;
  double seconds = 0, processor_seconds = 0;
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

RecordingPoses posesOf(const Walk &walk, const MappedWalk &mapped, uint32_t frames) {
  RecordingPoses poses(frames);
  for (size_t i = 0; i < walk.keyframes.size(); ++i) poses[walk.keyframes[i].index] = mapped.world_from_camera[i];
  for (const Follower &follower : walk.followers)
    if (const auto &keyframe = mapped.world_from_camera[follower.keyframe])
      poses[follower.index] = *keyframe * follower.keyframe_from_frame;
  return poses;
}

TrajectoryScore scoreOf(const RecordingPoses &poses, const RecordingReader &reader) {
  std::vector<PosePair> pairs;
  for (uint32_t i = 0; i < poses.size(); ++i) {
    const std::optional<sphc_rigid> truth = reader.worldFromCamera(i);
    if (poses[i] && truth) pairs.push_back({*poses[i], rigidFromC(*truth)});
  }
  return scoreTrajectory(pairs);
}

// The recording's points, seen from the poses that were found.
ImportedPoints importFrom(const MapOptions &options, const Outcome &outcome) {
  PointSource source = options.source;
  std::vector<bool> is_keyframe(outcome.poses.size());
  for (const WalkFrame &frame : outcome.walk.keyframes) is_keyframe[frame.index] = true;
  source.import.takes_part = [&](uint32_t index) { return is_keyframe[index] && outcome.poses[index]; };
  source.import.poses = [&](uint32_t index) { return std::make_optional(rigidToC(*outcome.poses[index])); };
  ImportedPoints points = importPoints(source);
  points.model.band = options.band;
  return points;
}

std::string trajectoryText(const RecordingPoses &poses, const RecordingReader &reader) {
  std::string text = std::string(kTumHead) + "world_from_camera, metres)\n";
  for (uint32_t i = 0; i < poses.size(); ++i)
    if (poses[i]) text += tumLine(reader.colorOf(i).time_ns, rigidToC(*poses[i]));
  return text;
}

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Outcome mapRecording(const MapOptions &options, RecordingReader *reader) {
  const auto start = std::chrono::steady_clock::now();
  const double processor_start = processorSeconds();
  Outcome outcome;
  Steps steps;
  const RgbdImportOptions &import = options.source.import;
  FrameReaderOptions frames;
  frames.depth_min_m = import.depth_min_m;
  frames.depth_max_m = import.depth_max_m;
  outcome.walk =
      readWalk(reader, frames, [&](uint32_t done, uint32_t total) { steps.show("reading", done, total); });
  outcome.mapped = mapWalk(
      outcome.walk, [&](const std::string &what, uint32_t done, uint32_t total) { steps.show(what, done, total); });
  outcome.stretches = stretchesOf(outcome.walk, outcome.mapped.parts);
  outcome.poses = posesOf(outcome.walk, outcome.mapped, reader->frameCount());
  if (options.score) outcome.score = scoreOf(outcome.poses, *reader);
  outcome.processor_seconds = processorSeconds() - processor_start;
  outcome.import = importFrom(options, outcome);
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

// Stretches as seconds since the recording's first frame.
class Clock {
 public:
  Clock(const RecordingReader &reader, const Walk &walk) : reader_(reader), walk_(walk) {}

  double secondsOf(uint32_t keyframe) const {
    const int64_t ns = reader_.colorOf(walk_.keyframes[keyframe].index).time_ns - reader_.colorOf(0).time_ns;
    return 1e-9 * static_cast<double>(ns);
  }
  std::string timesOf(const std::vector<Stretch> &stretches) const {
    std::string text;
    for (const Stretch &s : stretches)
      text +=
          (text.empty() ? "" : ", ") + fixed(secondsOf(s.first), 1) + " to " + fixed(secondsOf(s.last), 1) + " s";
    return text;
  }
  nlohmann::ordered_json jsonOf(const std::vector<Stretch> &stretches) const {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Stretch &s : stretches)
      json.push_back({{"from_s", secondsOf(s.first)},
                      {"to_s", secondsOf(s.last)},
                      {"frames", s.frames},
                      {"hints", hintNames(s.hints)}});
    return json;
  }

 private:
  const RecordingReader &reader_;
  const Walk &walk_;
};

uint32_t framesOf(const std::vector<Stretch> &stretches) {
  uint32_t frames = 0;
  for (const Stretch &s : stretches) frames += s.frames;
  return frames;
}

void warnOfParts(const Outcome &outcome, const Clock &clock, const Console &console) {
  const Stretches &s = outcome.stretches;
  if (s.apart.empty()) return;
  console.warn("The walk falls apart. The map is of its largest part alone, " + std::to_string(framesOf(s.mapped)) +
               " of " + std::to_string(outcome.walk.frameCount()) + " frames: " + clock.timesOf(s.mapped) + ".");
  for (const std::vector<Stretch> &part : s.apart)
    console.warn("It never met " + clock.timesOf(part) + " (" + std::to_string(framesOf(part)) +
                 " frames). Walk from what is seen there to what is seen at " + clock.timesOf(s.mapped) +
                 " once more, slowly, in one recording with the rest.");
}

void warnOfStretches(const Outcome &outcome, const Clock &clock, const Console &console) {
  for (const Stretch &s : outcome.stretches.left_out) {
    const std::string why = hintNames(s.hints);
    console.warn("note: left out: " + clock.timesOf({s}) + " (" + std::to_string(s.frames) +
                 " frames): " + (why.empty() ? "they show nothing that other frames show" : why));
  }
  if (outcome.walk.unreadable)
    console.warn("note: " + std::to_string(outcome.walk.unreadable) + " frames could not be read");
}

void warnOfResiduals(const Outcome &outcome, const Console &console) {
  const AdjustmentSummary &residuals = outcome.mapped.residuals;
  if (residuals.far_depths > kMostFarDepths)
    console.warn(
        "note: " + fixed(100 * residuals.far_depths, 0) +
        " % of the depths contradict the images: is the calibration right, and does depth lie where it says "
        "(both cameras, color_from_depth)? spherecloud doctor shows it");
  if (residuals.ray_sigmas > kMostRaySigmas)
    console.warn("note: keypoints are off by " + fixed(residuals.ray_sigmas, 1) +
                 " sigma: is the calibration of the colour camera right?");
}

std::string count(size_t n) { return std::to_string(n); }

std::vector<Row> tableOf(const Outcome &outcome) {
  const MappedWalk &m = outcome.mapped;
  const size_t parts = 1 + outcome.stretches.apart.size();
  std::vector<Row> rows = {
      {"frames", count(framesOf(outcome.stretches.mapped)),
       "of " + count(outcome.walk.frameCount()) + "; " + count(outcome.walk.keyframes.size()) + " keyframes"},
      {"parts", count(parts),
       parts == 1 ? "all that was connected is in the map" : "only the largest is in the map"},
      {"links", count(m.links),
       "between frames near in time; " + count(m.loops) + " loops, " + count(m.contradicting) +
           " left out as contradicting"},
      {"points adjusted", count(m.residuals.points), "seen " + count(m.residuals.sightings) + " times"},
      {"residuals, median", fixed(m.residuals.ray_sigmas, 2),
       "sigma, of keypoints; of depths " + fixed(m.residuals.depth_sigmas, 2) + ", " +
           fixed(1000 * m.residuals.depth_off_m, 1) + " mm"},
      {"depth bias", fixed(1000 * m.depth.mean[0], 1) + " mm",
       "at " + fixed(m.depth.mid_m, 2) + " m, and " + fixed(1000 * m.depth.mean[1], 1) + " mm more a metre"},
      {"time", fixed(outcome.seconds, 1) + " s",
       fixed(outcome.processor_seconds, 1) + " s of a processor for poses"}};
  if (const auto &s = outcome.score) {
    rows.push_back({"path error, RMSE", fixed(100 * s->rigid_rmse_m, 2) + " cm",
                    "beside the recording's poses, after a rigid alignment; worst turn " +
                        fixed(s->rotation_worst_deg, 2) + " deg, median " + fixed(s->rotation_median_deg, 2)});
    rows.push_back({"scale", fixed(s->scale, 4),
                    "after it the path error is " + fixed(100 * s->similarity_rmse_m, 2) + " cm"});
  }
  return rows;
}

nlohmann::ordered_json jsonOf(const MapOptions &options, const Outcome &outcome, const Clock &clock) {
  const MappedWalk &m = outcome.mapped;
  nlohmann::ordered_json json = {
      {"model", options.model},
      {"frames", outcome.walk.frameCount()},
      {"frames_mapped", framesOf(outcome.stretches.mapped)},
      {"keyframes", outcome.walk.keyframes.size()},
      {"unreadable", outcome.walk.unreadable},
      {"parts", 1 + outcome.stretches.apart.size()},
      {"mapped", clock.jsonOf(outcome.stretches.mapped)},
      {"apart", nlohmann::ordered_json::array()},
      {"left_out", clock.jsonOf(outcome.stretches.left_out)},
      {"links", m.links},
      {"loops", m.loops},
      {"contradicting", m.contradicting},
      {"points_adjusted", m.residuals.points},
      {"sightings", m.residuals.sightings},
      {"residuals",
       {{"ray_sigmas", m.residuals.ray_sigmas},
        {"depth_sigmas", m.residuals.depth_sigmas},
        {"depth_m", m.residuals.depth_off_m},
        {"far_depths", m.residuals.far_depths}}},
      {"depth_bias", {{"offset_m", m.depth.mean[0]}, {"slope", m.depth.mean[1]}, {"mid_m", m.depth.mid_m}}}};
  for (const std::vector<Stretch> &part : outcome.stretches.apart) json["apart"].push_back(clock.jsonOf(part));
  if (!options.trajectory.empty()) json["trajectory"] = options.trajectory;
  if (const auto &s = outcome.score)
    json["score"] = {{"frames", s->frames},
                     {"rigid_rmse_m", s->rigid_rmse_m},
                     {"similarity_rmse_m", s->similarity_rmse_m},
                     {"scale", s->scale},
                     {"rotation_median_deg", s->rotation_median_deg},
                     {"rotation_worst_deg", s->rotation_worst_deg}};
  json["points"] = outcome.import.facts;
  json["seconds"] = outcome.seconds;
  json["processor_seconds"] = outcome.processor_seconds;
  return json;
}

int run(const MapOptions &options, const Console &console) {
  FileUse files(options.force);
  files.reads(options.source.recording);
  files.writes("--model", options.model, isModelFile);
  files.writes("--trajectory", options.trajectory, holds(kTumHead));
  files.check();
  checkPointSource(options.source);
  const auto reader = openRecording(options.source.recording);
  const Outcome outcome = mapRecording(options, reader.get());
  const Clock clock(*reader, outcome.walk);
  console.say(tableText(tableOf(outcome)));
  for (const std::string &warning : outcome.import.warnings) console.warn("note: " + warning);
  warnOfStretches(outcome, clock, console);
  warnOfResiduals(outcome, console);
  warnOfParts(outcome, clock, console);
  writeModelFile(options.model, outcome.import.model);
  console.say(outcome.import.told);
  console.say("Wrote " + options.model +
              ": where every point is. Keep it, never ship it. Next:\n  spherecloud build "
              "--model " +
              options.model + " --map room.sphc");
  if (!options.trajectory.empty()) {
    writeFile(options.trajectory, trajectoryText(outcome.poses, *reader));
    console.say("Trajectory (world_from_camera): " + options.trajectory);
  }
  console.give(jsonOf(options, outcome, clock));
  return outcome.stretches.apart.empty() ? kExitDone : kExitWalkApart;
}

const char kMapHelp[] =
    "Finds where each frame of a walk was taken from, by its images and depths alone, and makes the private point\n"
    "model that build makes a map of.  Poses that the recording holds are not used; --score compares with them.";
const char kMapExample[] =
    "Example:\n"
    "  spherecloud record --color v4l2:/dev/video0 --depth v4l2:/dev/video2 -c headset.json --out walk.mcap\n"
    "  spherecloud map    --recording walk.mcap --model room.model --trajectory walk.tum\n"
    "  spherecloud build  --model room.model --map room.sphc\n"
    "The world is the first frame's camera, in metres.  Exit status 6: parts of the walk never met, the model is "
    "of\n"
    "the largest; stderr says which, and where to walk once more.";

}  // namespace

Command mapCommand(CLI::App *root) {
  auto options = std::make_shared<MapOptions>();
  CLI::App *app = root->add_subcommand("map");
  app->description("Make a point model from a recording without poses.\n\n" + std::string(kMapHelp));
  app->footer(kMapExample);
  addRecordingOptions(app, &options->source.recording);
  app->add_option("--model", options->model, "Private file for the points, for build --model")
      ->required()
      ->type_name("FILE");
  app->add_option("--trajectory", options->trajectory, "Poses of all frames in TUM format")->type_name("FILE");
  app->add_flag("--score", options->score, "Compare with the recording's own poses");
  addMappingOptions(app, &options->source.import);
  addBandOption(app, &options->band, "The light of the images; a camera must see the same to localize in the map");
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
