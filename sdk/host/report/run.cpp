#include "host/report/run.h"

#include <algorithm>
#include <cstdio>

#include "host/report/bit_words.h"

namespace sphc::host {

const char *bandName(sphc_band band) { return band == SPHC_BAND_INFRARED ? "infrared" : "visible"; }

const char *outcomeName(sphc_localizer_outcome outcome) {
  switch (outcome) {
    case SPHC_OUTCOME_LOCALIZED:
      return "localized";
    case SPHC_OUTCOME_FEW_KEYPOINTS:
      return "few keypoints";
    case SPHC_OUTCOME_FEW_DEPTHS:
      return "few depths";
    case SPHC_OUTCOME_FEW_MATCHES:
      return "few matches";
    case SPHC_OUTCOME_NO_CONSENSUS:
      return "no consensus";
    case SPHC_OUTCOME_UNCERTAIN:
      return "uncertain";
    case SPHC_OUTCOME_DEADLINE:
      return "deadline";
    case SPHC_OUTCOME_CONTRADICTION:
      return "contradiction";
    default:
      return "unknown";
  }
}

const char *outcomeAdvice(sphc_localizer_outcome outcome) {
  switch (outcome) {
    case SPHC_OUTCOME_LOCALIZED:
      return "a pose was given out";
    case SPHC_OUTCOME_FEW_KEYPOINTS:
      return "dark, blurred or blank image";
    case SPHC_OUTCOME_FEW_DEPTHS:
      return "the depth sensor saw little, or the calibration is wrong";
    case SPHC_OUTCOME_FEW_MATCHES:
      return "another place than the map's, or much has changed";
    case SPHC_OUTCOME_NO_CONSENSUS:
      return "no pose agrees with clearly more matches than chance would";
    case SPHC_OUTCOME_UNCERTAIN:
      return "a pose was found, but few matches fix it, no second search agrees, or another fits nearly as well";
    case SPHC_OUTCOME_DEADLINE:
      return "no pose before the deadline";
    case SPHC_OUTCOME_CONTRADICTION:
      return "the frame contradicts itself; the table of faults says how";
    default:
      return "an outcome this report does not know";
  }
}

std::string cutNames(uint32_t cuts) {
  constexpr std::array<BitWords, 4> kCutWords = {{{SPHC_CUT_FEATURES, "features", ""},
                                                  {SPHC_CUT_MATCHES, "matches", ""},
                                                  {SPHC_CUT_SEARCH, "search", ""},
                                                  {SPHC_CUT_VERIFICATION, "verification", ""}}};
  return namesOf(kCutWords, cuts);
}

std::string eventNames(uint32_t events) {
  constexpr std::array<BitWords, 3> kEventWords = {{{SPHC_EVENT_RELOCALIZED, "relocalized", ""},
                                                    {SPHC_EVENT_JUMPED, "jumped", ""},
                                                    {SPHC_EVENT_MAP_CHANGED, "map changed", ""}}};
  return namesOf(kEventWords, events);
}

const char *stateName(sphc_localizer_state state) {
  switch (state) {
    case SPHC_STATE_RELOCALIZING:
      return "relocalizing";
    case SPHC_STATE_TRACKING:
      return "tracking";
    case SPHC_STATE_LOST:
      return "lost";
    default:
      return "unknown";
  }
}

uint64_t mapBytes(const Run &run) {
  uint64_t bytes = 0;
  for (const MapFacts &map : run.maps) bytes += map.file_bytes;
  return bytes;
}

std::vector<size_t> answersByMap(const Run &run) {
  std::vector<size_t> answers(run.maps.size());
  for (const FrameRecord &frame : run.frames)
    if (frame.localized && frame.map < answers.size()) ++answers[frame.map];
  return answers;
}

size_t mapsWithAnswers(const Run &run) {
  const std::vector<size_t> answers = answersByMap(run);
  return answers.size() - static_cast<size_t>(std::count(answers.begin(), answers.end(), size_t{0}));
}

uint32_t mapOfMostAnswers(const Run &run) {
  const std::vector<size_t> answers = answersByMap(run);
  return static_cast<uint32_t>(std::max_element(answers.begin(), answers.end()) - answers.begin());
}

size_t basesOfAnswers(const Run &run) {
  return run.base == "map" || run.aligned_frames > 0 ? mapsWithAnswers(run) : 1;
}

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string humanBytes(double bytes) {
  const char *units[] = {"B", "kB", "MB", "GB", "TB"};
  size_t unit = 0;
  while (bytes >= 1000 && unit + 1 < sizeof units / sizeof *units) {
    bytes /= 1000;
    ++unit;
  }
  return fixed(bytes, unit == 0 || bytes >= 100 ? 0 : bytes >= 10 ? 1 : 2) + " " + units[unit];
}

}  // namespace sphc::host
