#include "host/report/truth_words.h"

#include "host/base/counted.h"

namespace sphc::host {
namespace {

constexpr double kSure = 0.95;
constexpr uint32_t kFewestSure = 5;

}  // namespace

std::string alignmentWords(const Run &run) {
  if (run.aligned_frames == 0) return "";
  return std::string("the errors are what a rigid alignment of the recording's poses to ") +
         (run.maps.size() > 1 ? "each map" : "the map") + " leaves (--align)";
}

std::string doubtOfTruth(const Run &run, const Summary &summary) {
  uint32_t sure = 0;
  for (const FrameRecord &frame : run.frames) sure += isWrong(frame) && frame.confidence > kSure;
  if (sure < kFewestSure || 2 * sure <= summary.localized) return "";
  return std::to_string(sure) + " of " + counted(summary.localized, "pose") +
         " are sure and far from the recording's: " +
         (run.aligned_frames ? "no rigid alignment brings the two together"
                             : "was the map made by spherecloud map, or from another recording, it has a world of "
                               "its own (--align compares after an alignment)") +
         "; or the recording's poses are not in metres, not world_from_camera, or of other axes";
}

}  // namespace sphc::host
