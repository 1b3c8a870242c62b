// What happened in one run of the localizer over a recording; everything the report and the table are made from.
#pragma once
#include <spherecloud/spherecloud.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sphc::host {

// One frame.  Poses are `base_from_camera`; the base is the recording's world when the owner's note is at hand,
// else the map's own frame.
struct FrameRecord {
  uint32_t index = 0;  // of the recording's chosen frames: where its images can be read again
  uint32_t sequence = 0;
  int64_t time_ns = 0;
  sphc_localizer_outcome outcome = SPHC_OUTCOME_FEW_KEYPOINTS;
  uint32_t keypoints = 0, lifted = 0, matches = 0, inliers = 0, iterations = 0;
  uint32_t features_us = 0, align_us = 0, match_us = 0, pose_us = 0, total_us = 0;

  sphc_localizer_state state = SPHC_STATE_RELOCALIZING;  // after this frame
  uint32_t map = 0;                                      // of the run's maps
  uint32_t frames_together = 1;                          // whose matches the pose was found from
  bool guided = false;                                   // found where it was expected
  uint32_t faults = 0;                                   // SPHC_FAULT_ bits that the result names
  uint32_t cuts = 0;                                     // SPHC_CUT_ bits: what the deadline left out
  uint32_t hints = 0;                                    // SPHC_HINT_ bits: why there is no pose
  uint32_t events = 0;                                   // SPHC_EVENT_ bits: what the pose does to what was drawn
  double jump_m = 0, jump_rad = 0;                       // from where it was expected

  sphc_depth_bias depth = {};  // what the localizer took the depth sensor for

  bool localized = false;
  sphc_rigid base_from_camera = {{1, 0, 0, 0}, {0, 0, 0}};
  double sigma_rotation_deg = 0, sigma_translation_m = 0;  // what the localizer itself believes
  std::optional<double> confidence;  // probability of being within 5 cm and 5 deg; when the localizer tells

  bool has_truth = false;
  sphc_rigid truth_base_from_camera = {{1, 0, 0, 0}, {0, 0, 0}};
  double rotation_error_deg = 0, translation_error_m = 0;  // when localized with truth

  std::vector<sphc_localizer_observation> observations;  // of those alone that a picture shows
};

// A frame that could not be decoded.
struct UnreadableFrame {
  uint32_t index = 0, sequence = 0;
  int64_t time_ns = 0;
  std::string why;
};

struct MemoryPiece {
  std::string name;
  size_t bytes = 0;
  bool scratch = false;
};

struct Setting {
  std::string name, value;
};

struct MapFacts {
  std::string path, id;
  uint32_t points = 0, format_version = 0, extractor = 0;
  sphc_band band = SPHC_BAND_VISIBLE;
  uint64_t file_bytes = 0;
  std::vector<std::array<double, 3>> directions;  // all that the file says of its points; for the picture
};

constexpr char kNoPoses[] = "the recording holds no poses";

struct Run {
  std::string recording;
  bool has_poses = true;     // the recording, of whatever time; without, there is no truth
  std::string base = "map";  // "world" or "map": of several maps each its own
  // Of the spheres, in the base: one for each map, or one for all, the origin of each.
  std::vector<std::array<double, 3>> centres_m = {{0, 0, 0}};
  std::vector<MapFacts> maps;  // one at least
  size_t state_bytes = 0, scratch_bytes = 0;
  std::vector<MemoryPiece> memory;
  std::vector<Setting> settings;
  std::vector<FrameRecord> frames;
  std::vector<UnreadableFrame> unreadable;  // not part of `frames`
  // Poses by which the truth was brought to the base (aligned_truth.h); 0: it is as it was recorded.
  uint32_t aligned_frames = 0;
};

uint64_t mapBytes(const Run &run);
// Localized frames in each map.
std::vector<size_t> answersByMap(const Run &run);
size_t mapsWithAnswers(const Run &run);
// The map that most answers are in; the first where there is none.
uint32_t mapOfMostAnswers(const Run &run);
// In how many frames of reference the answers are: in one, or, without notes or after an alignment, in that of each
// map with an answer.
size_t basesOfAnswers(const Run &run);

// "few matches" and so on: a word or two for tables, and a sentence with the likely cause.
const char *outcomeName(sphc_localizer_outcome outcome);
const char *bandName(sphc_band band);  // "visible"
const char *outcomeAdvice(sphc_localizer_outcome outcome);
// "features, search"; "" of none.
std::string cutNames(uint32_t cuts);
// "jumped"; "" of none.
std::string eventNames(uint32_t events);
const char *stateName(sphc_localizer_state state);

// "12345" as "12.3 kB"; powers of 1000.
std::string humanBytes(double bytes);
// Fixed number of digits after the point.
std::string fixed(double value, int digits);

}  // namespace sphc::host
