// What became of recordings that `spherecloud map` mapped together.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/common/point_source.h"
#include "host/mapping/stretches.h"
#include "host/mapping/vertical.h"
#include "host/mapping/walk_mapper.h"
#include "host/mapping/walk_times.h"
#include "host/report/trajectory_score.h"

namespace sphc::host {

// One of the recordings that were mapped together.
struct MappedRecording {
  std::string name;  // as it was given
  std::unique_ptr<RecordingReader> reader;
  std::vector<std::optional<Rigid>> poses;  // of its frames, world_from_camera; none of those that found no place
  std::optional<TrajectoryScore> score = {};
  WalkTimes times = {};
  double unaligned_rmse_m = 0;     // of the score too, where the world is the recording's
  bool is_truth_inverse = false;   // likewise of the score
  recording::PoseTrack told = {};  // those of --poses-from, in place of the recording's own
  uint32_t bad_told = 0;           // of that file, left out
  bool is_told = false;            // where poses are used: a frame at least has one, of the recording or the file

  uint32_t framesMapped() const;
  recording::PoseTrack path() const;  // through all of them
};

struct MapOutcome {
  PoseUse use = PoseUse::kNone;
  bool wants_told_axes = false;  // by --upright
  Walk walk;
  MappedWalk mapped;
  Stretches stretches;
  std::vector<Stretch> by_told_alone;  // MappedWalk::by_told_alone
  std::vector<MappedRecording> recordings;
  MeasuredVertical vertical;  // of recordings with inertial data
  ImportedPoints import;
  double seconds = 0, processor_seconds = 0;

  // Parts of a walk, or whole recordings, that never met the rest.
  bool isApart() const;
};

// In words, what was told: "poses", or "steps of the odometry".
const char *toldWord(const MapOutcome &outcome);

}  // namespace sphc::host
