// Stretches of mapped recordings as seconds since their recording's first frame.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/cli/map_outcome.h"

namespace sphc::host {

class MapClock {
 public:
  explicit MapClock(const MapOutcome &outcome) : outcome_(outcome) {}

  const MappedRecording &recordingOf(const Stretch &s) const;
  // "walk 1.5 to 3.0 s, 7.0 to 9.5 s", with names where there are several recordings.
  std::string timesOf(const std::vector<Stretch> &stretches) const;
  nlohmann::ordered_json jsonOf(const std::vector<Stretch> &stretches) const;

 private:
  double secondsOf(uint32_t keyframe) const;

  const MapOutcome &outcome_;
};

uint32_t framesOf(const std::vector<Stretch> &stretches);

}  // namespace sphc::host
