#include "host/cli/map_recordings.h"

#include <chrono>
#include <ctime>
#include <memory>
#include <numeric>

#include "host/base/counted.h"
#include "host/base/usage_error.h"
#include "host/cli/common/progress.h"
#include "host/cli/map_warnings.h"
#include "host/import/upright.h"
#include "host/mapping/told_pieces.h"
#include "host/recording/calibration_json.h"
#include "host/report/trajectory.h"

namespace sphc::host {
namespace {

constexpr size_t kMostImported = 500;  // frames, where they are not all keyframes: more of them tell little

// A bar for each of the mapper's steps.
class Steps {
 public:
  void show(const std::string &what, uint32_t done, uint32_t total) {
    if (what != what_) bar_ = std::make_unique<ProgressBar>(what);
    what_ = what;
    bar_->show(done, total);
  }
  // For the mapper; borrows this.
  MappingProgress progress() {
    return [this](const std::string &what, uint32_t done, uint32_t total) { show(what, done, total); };
  }

 private:
  std::string what_;
  std::unique_ptr<ProgressBar> bar_;
};

// Those of the recording, or of its file of poses.
const recording::PoseTrack &toldPoses(const MapOptions &options, const MappedRecording &recording) {
  return options.told.empty() ? recording.reader->recording().poses : recording.told;
}

std::optional<sphc_rigid> toldAt(const MapOptions &options, const MappedRecording &recording, int64_t time_ns) {
  return toldPoses(options, recording).at(time_ns, recording.reader->poseGapNs());
}

void tell(const MapOptions &options, const MappedRecording &recording, Walk *walk) {
  const ToldPieces pieces(toldPoses(options, recording).poses());
  for (WalkFrame &frame : walk->keyframes)
    if (const std::optional<sphc_rigid> told = toldAt(options, recording, frame.time_ns)) {
      frame.told_world_from_camera = rigidFromC(*told);
      frame.told_piece = pieces.at(frame.time_ns);
    }
}

bool hasToldPose(const MapOptions &options, const MappedRecording &recording) {
  for (uint32_t i = 0; i < recording.reader->frameCount(); ++i)
    if (toldAt(options, recording, recording.reader->colorOf(i).time_ns)) return true;
  return false;
}

[[noreturn]] void refuseTold(const MapOptions &options, const std::vector<MappedRecording> &recordings) {
  for (const MappedRecording &recording : recordings) {
    const recording::PoseTrack &poses = toldPoses(options, recording);
    const std::string apart = tooFarApart(*recording.reader, poses);
    if (!apart.empty()) throw std::runtime_error("none of " + counted(poses.poses().size(), "pose") + apart);
  }
  throw std::runtime_error(
      options.told.empty() ? "--poses: the recording holds no pose; give --poses-from FILE, or leave --poses out"
                           : "--poses-from: no pose is of the time of a frame; is it the file of this recording?");
}

// The last word on what is gone has the last recording.  Clocks that do not count from 1970 may each begin anew.
void checkOrder(const std::vector<MappedRecording> &recordings) {
  constexpr int64_t kSince1970Ns = 1000000000000000000;  // later than 2001
  const MappedRecording *before = nullptr;
  for (const MappedRecording &recording : recordings) {
    if (recording.reader->frameCount() == 0) continue;
    const int64_t time_ns = recording.reader->colorOf(0).time_ns;
    if (time_ns < kSince1970Ns) return;
    if (before && time_ns < before->reader->colorOf(0).time_ns)
      throw UsageError("--recording: " + recording.name + " is older than " + before->name +
                       ", by their times; give the oldest first, for what the last one shows decides what is gone");
    before = &recording;
  }
}

// Before images are read, which takes minutes.
void checkRecordings(const MapOptions &options, const std::vector<MappedRecording> &recordings) {
  checkOrder(recordings);
  uint64_t frames = 0;
  bool is_told = false;
  for (const MappedRecording &recording : recordings) {
    frames += recording.reader->frameCount();
    is_told = is_told || recording.is_told;
  }
  checkObservations(options.import, frames);
  if (options.trust.use != PoseUse::kNone && !is_told) refuseTold(options, recordings);
}

// The frames that are mapped may be none of those that were told.
void checkTold(const MapOptions &options, const MapOutcome &outcome) {
  if (options.trust.use == PoseUse::kNone) return;
  for (const WalkFrame &frame : outcome.walk.keyframes)
    if (frame.told_world_from_camera) return;
  refuseTold(options, outcome.recordings);
}

// Says what of the recordings and of their poses takes no part.
void noteAll(const MapOptions &options, const std::vector<MappedRecording> &recordings, const Console &console) {
  for (size_t i = 0; i < recordings.size(); ++i) {
    noteDamage(*recordings[i].reader, console);
    if (options.told.empty()) continue;
    Damage damage;
    damage.bad_poses = recordings[i].bad_told;
    noteDamage(options.told[i], damage, console);
  }
  if (options.trust.use == PoseUse::kNone || recordings.size() == 1) return;
  for (const MappedRecording &recording : recordings)
    if (!recording.is_told)
      console.warn("note: no pose is of the time of a frame of " + recording.name + ", so it is mapped without" +
                   (options.told.empty() ? "" : ": is its file of poses the right one?"));
}

std::vector<MappedRecording> openAll(const MapOptions &options) {
  std::vector<MappedRecording> recordings;
  for (const RecordingOptions &recording : options.all())
    recordings.push_back({recording.folder, openRecording(recording), {}});
  for (size_t i = 0; i < options.told.size(); ++i)
    recordings[i].told = recording::readTumPoses(options.told[i], &recordings[i].bad_told);
  if (options.trust.use != PoseUse::kNone)
    for (MappedRecording &recording : recordings) recording.is_told = hasToldPose(options, recording);
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
    const auto show = [&](uint32_t done, uint32_t total) { steps->show(what, done, total); };
    try {
      walks.push_back(
          readWalk(recording.reader.get(), trial ? trial->rig : recording.reader->calibration(), frames, show));
    } catch (const std::runtime_error &error) {
      if (recordings.size() == 1) throw;
      throw std::runtime_error(recording.name + ": " + error.what());  // which of them
    }
    if (options.trust.use != PoseUse::kNone || options.judgesTold()) tell(options, recording, &walks.back());
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
void standUpright(MapOutcome *outcome) {
  if (outcome->mapped.is_in_told_world || outcome->mapped.has_told_axes) return;  // the world is given
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

// Of each recording the frames whose points make the map: keyframes with a pose, and as many of the frames beside
// them as make up kMostImported, evenly.
std::vector<std::vector<bool>> framesToImport(const MapOutcome &outcome) {
  const FramePoses &mapped = outcome.mapped.world_from_camera;
  std::vector<std::vector<bool>> takes_part;
  for (const MappedRecording &recording : outcome.recordings) takes_part.emplace_back(recording.poses.size());
  for (size_t i = 0; i < mapped.size(); ++i) {
    const WalkFrame &frame = outcome.walk.keyframes[i];
    takes_part[frame.recording][frame.index] = mapped[i].has_value();
  }
  std::vector<Follower> followers;
  for (const Follower &follower : outcome.walk.followers)
    if (mapped[follower.keyframe]) followers.push_back(follower);
  const size_t keyframes = placedCount(mapped);
  const size_t room = kMostImported > keyframes ? std::min(kMostImported - keyframes, followers.size()) : 0;
  for (size_t i = 0; i < room; ++i) {
    const Follower &follower = followers[i * followers.size() / room];
    takes_part[follower.recording][follower.index] = true;
  }
  return takes_part;
}

// The recordings' points, seen from the poses that were found.
ImportedPoints importFrom(const MapOptions &options, const MapOutcome &outcome) {
  const std::vector<std::vector<bool>> takes_part = framesToImport(outcome);
  std::vector<recording::PoseTrack> paths;
  for (const MappedRecording &recording : outcome.recordings) paths.push_back(recording.path());
  std::vector<RgbdSource> sources;
  for (size_t r = 0; r < outcome.recordings.size(); ++r) {
    const MappedRecording &recording = outcome.recordings[r];
    sources.push_back(
        {recording.reader.get(), [&, r](uint32_t i) { return takes_part[r][i]; },
         [&, r](int64_t time_ns) { return paths[r].at(time_ns, outcome.recordings[r].reader->poseGapNs()); },
         outcome.mapped.depth});
  }
  ImportedPoints points = importRecordings(sources, options.import, describeSelection(options.of_each));
  points.model.band = options.band;
  return points;
}

// Calls `map` for the outcome's walk.  Where nothing agrees, what was measured of the frames may tell why.
template <typename Map>
auto mapOrSayWhy(MapOutcome *outcome, const Console &console, const Map &map) {
  try {
    return map();
  } catch (const NothingAgrees &) {
    std::vector<uint32_t> each_apart(outcome->walk.keyframes.size());
    std::iota(each_apart.begin(), each_apart.end(), 1);  // 0 is what is mapped
    outcome->stretches = stretchesOf(outcome->walk, each_apart, FramePoses(each_apart.size()));
    noteStretchesLeftOut(*outcome, console);
    throw;
  }
}

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

MapOutcome mapRecordings(const MapOptions &options, const Console &console) {
  const auto start = std::chrono::steady_clock::now();
  const double processor_start = processorSeconds();
  MapOutcome outcome;
  Steps steps;
  outcome.use = options.trust.use;
  outcome.wants_told_axes = options.trust.keeps_axes;
  outcome.recordings = openAll(options);
  noteAll(options, outcome.recordings, console);
  checkRecordings(options, outcome.recordings);
  outcome.walk = readAll(options, nullptr, outcome.recordings, &steps);
  checkTold(options, outcome);
  for (MappedRecording &recording : outcome.recordings) recording.times = timesOf(*recording.reader);
  MappingOptions mapping = options.mapping();
  mapping.judges_told = options.judgesTold();
  outcome.mapped = mapOrSayWhy(&outcome, console, [&] { return mapWalk(outcome.walk, mapping, steps.progress()); });
  checkObservations(options.import, mappedFrames(outcome.walk, outcome.mapped.world_from_camera),
                    " that found a place");
  outcome.stretches = stretchesOf(outcome.walk, outcome.mapped.parts, outcome.mapped.world_from_camera);
  const std::vector<bool> &alone = outcome.mapped.by_told_alone;
  outcome.by_told_alone =
      runsOf(outcome.walk, {alone.begin(), alone.end()}, true, outcome.mapped.world_from_camera);
  takePoses(&outcome);
  standUpright(&outcome);
  if (options.score)
    for (MappedRecording &recording : outcome.recordings) score(&recording);
  outcome.processor_seconds = processorSeconds() - processor_start;
  outcome.import = importFrom(options, outcome);
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

RefinedCalibration refineCalibration(const MapOptions &options, const Console &console) {
  MapOutcome outcome;  // as far as it is known
  outcome.recordings = openAll(options);
  const std::vector<MappedRecording> &recordings = outcome.recordings;
  const sphc_rig given = commonCalibration(recordings);
  checkRecordings(options, recordings);
  Steps steps;
  const auto read = [&](const TrialCalibration &trial) -> const Walk & {
    outcome.walk = {};  // before another one is in memory
    return outcome.walk = readAll(options, &trial, recordings, &steps);
  };
  return {given, mapOrSayWhy(&outcome, console,
                             [&] { return fitCalibration(given, read, options.mapping(), steps.progress()); })};
}

}  // namespace sphc::host
