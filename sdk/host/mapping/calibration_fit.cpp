#include "host/mapping/calibration_fit.h"

#include <optional>

namespace sphc::host {
namespace {

constexpr int kMostRounds = 6;
constexpr double kBetter = 0.95;  // of what was off before; sound calibrations gain less

double offness(const AdjustmentSummary &residuals) { return residuals.ray_sigmas * residuals.depth_sigmas; }

CalibrationChange sum(const CalibrationChange &first, const CalibrationChange &second) {
  return {first.lens + second.lens, first.mount + second.mount};
}

// Nothing, where a calibration is so far off that no two frames agree any more.
std::optional<MappedWalk> mapIfFramesAgree(const Walk &walk, const MappingOptions &options,
                                           const MappingProgress &progress) {
  try {
    return mapWalk(walk, options, progress);
  } catch (const NothingAgrees &) {
    return std::nullopt;
  }
}

}  // namespace

CalibrationFit fitCalibration(const sphc_rig &given, const ReadTrial &read, const MappingOptions &mapping,
                              const MappingProgress &progress) {
  CalibrationFit fit;
  const bool is_apart = !haveSameRays(given);
  MappingOptions options = mapping;
  options.lens_is_free = true;
  options.mount_is_free = is_apart;
  options.change_so_far = {};
  TrialCalibration trial = {given, is_apart};
  for (int round = 0; round < kMostRounds; ++round) {
    const Walk &walk = read(trial);
    const std::optional<MappedWalk> mapped =
        round == 0 ? mapWalk(walk, options, progress) : mapIfFramesAgree(walk, options, progress);
    if (!mapped) break;
    if (round == 0)
      fit.before = mapped->at_first;
    else if (offness(mapped->at_first) > kBetter * offness(fit.after))
      break;
    fit.calibration = trial.rig;
    fit.frames = mappedFrames(walk, mapped->world_from_camera);
    fit.rounds = round;
    fit.after = mapped->at_first;
    trial.rig = changedBy(mapped->change, trial.rig);
    options.change_so_far = sum(options.change_so_far, mapped->change);
  }
  return fit;
}

}  // namespace sphc::host
