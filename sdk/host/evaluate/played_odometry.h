// Odometry for a replay, made from the recording's poses: what a headset's dead reckoning would say.
#pragma once
#include <cstdint>
#include <random>

#include "host/recording/recording_reader.h"

namespace sphc::host {

// Each step is the true one times a normal error; the errors add up to a drift.  The same numbers in every run.
class PlayedOdometry {
 public:
  static constexpr double kRotationSigmaRad = 0.1 * 3.14159265358979323846 / 180, kTranslationSigmaM = 0.002;

  explicit PlayedOdometry(const recording::RecordingReader *reader) : reader_(reader) {}

  // Of frame `index`, in ascending order; null where the recording has no pose.  Valid until the next call.
  const sphc_localizer_prior *at(uint32_t index);

 private:
  const recording::RecordingReader *reader_;
  std::mt19937_64 random_{1};
  bool begun_ = false;
  sphc_rigid world_from_camera_ = {{1, 0, 0, 0}, {0, 0, 0}};
  sphc_localizer_prior prior_ = {};
};

}  // namespace sphc::host
