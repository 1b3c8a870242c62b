// spherecloud map: from walks without poses, or with poses that are a little wrong, to a point model and a path.
#include <algorithm>
#include <memory>
#include <stdexcept>

#include "host/base/counted.h"
#include "host/base/shell_word.h"
#include "host/base/write_file.h"
#include "host/calibration/compare.h"
#include "host/cli/commands.h"
#include "host/cli/common/contradictions.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/map_recordings.h"
#include "host/cli/map_report.h"
#include "host/cli/map_warnings.h"
#include "host/import/model_file.h"
#include "host/mapping/solver_memory.h"
#include "host/recording/calibration_json.h"
#include "host/report/trajectory.h"

namespace sphc::host {
namespace {

constexpr uint64_t kLeastMappedOf = 3;  // one of so many frames is to find a place
constexpr double kMostRefinedPx = 25;   // 1.5 % of focal length, 6 px, 0.7 degrees and 11 mm together are 20
constexpr size_t kFewestToRefine = 50;  // 25 frames have moved a sound calibration by 12 px

void tellOfFit(const MapOptions &options, const RefinedCalibration &refined, const CalibrationDifference &moved,
               const Console &console) {
  const CalibrationFit &fit = refined.fit;
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
  if (fit.frames < kFewestToRefine)
    console.warn(
        "note: " + counted(fit.frames, "frame") +
        " that found a place may be too few to refine a calibration by, and a sound one may be worse now; give " +
        std::to_string(kFewestToRefine) + " or more, in which the camera walks and turns");
  if (std::max(moved.color.largest_px, moved.depth_to_color[1].largest_px) > kMostRefinedPx)
    console.warn(
        "note: that is more than a calibration is off that is a little off, so the refined one may be wrong "
        "too: is the given one of these cameras, is color_from_depth inverted or in millimetres? "
        "`spherecloud doctor` compares edges");
}

std::string trajectoryText(const MappedRecording &recording) {
  std::string text = tumHead("world", "map");
  for (uint32_t i = 0; i < recording.poses.size(); ++i)
    if (recording.poses[i]) text += tumLine(recording.reader->colorOf(i).time_ns, rigidToC(*recording.poses[i]));
  return text;
}

// A model of next to nothing of the walk would pass for one of the place.  Empty where it is of enough.
std::string whyNoModel(const MapOptions &options, const MapOutcome &outcome) {
  uint64_t frames = 0, mapped = 0;
  for (const MappedRecording &recording : outcome.recordings) {
    frames += recording.poses.size();
    mapped += recording.framesMapped();
  }
  if (kLeastMappedOf * mapped >= frames) return "";
  return "only " + std::to_string(mapped) + " of " + counted(frames, "frame") +
         " found a place, fewer than a third, so no model was written; walk once more, slowly, in good light and "
         "where there is much to see, or choose the frames of the part that is worth a map by --first and --last" +
         (options.refined_calibration.empty()
              ? ""
              : ". Leave " + options.refined_calibration + " unused: these frames alone say that it is right");
}

// `build` of the recording would refuse it, and of the model it could not know.
void checkContradictions(const MapOptions &options, const MapOutcome &outcome) {
  if (outcome.import.contradictions.empty()) return;
  throw std::runtime_error("this walk contradicts itself:" + contradictionLines(outcome.import.contradictions) +
                           "\n" + options.model +
                           " was written all the same. Do not publish it: correct the recording, and map it again");
}

// Writes the calibration that the walk agrees with best; the map is then made with it.  How far it moved pixels.
CalibrationDifference refine(MapOptions *options, const Console &console) {
  const RefinedCalibration refined = refineCalibration(*options, console);
  recording::writeCalibration(options->refined_calibration, refined.fit.calibration);
  options->of_each.calibration = options->refined_calibration;
  const CalibrationDifference moved = compareCalibrations(refined.given, refined.fit.calibration);
  tellOfFit(*options, refined, moved, console);
  return moved;
}

void tellOfMap(const MapOptions &options, const MapOutcome &outcome, const Console &console) {
  console.say(tableText(mapTable(outcome)));
  warnOfMap(outcome, console);
  for (const MappedRecording &recording : outcome.recordings)
    if (options.score && recording.framesMapped() > 0 && !recording.score)
      console.warn("note: no score of " + recording.name +
                   ": fewer than 3 frames have a pose that was found and one that the recording holds");
}

void writeFiles(const MapOptions &options, const MapOutcome &outcome) {
  writeModelFile(options.model, outcome.import.model);
  for (size_t i = 0; i < options.trajectories.size(); ++i)
    writeFile(options.trajectories[i], trajectoryText(outcome.recordings[i]), Readers::kOwner);
}

void tellOfFiles(const MapOptions &options, const MapOutcome &outcome, const Console &console) {
  console.say(outcome.import.told);
  console.say("Wrote " + options.model +
              ": where every point is. Keep it, never ship it. Next:\n  spherecloud build --model " +
              shellWord(options.model) + " --map room.sphc");
  for (const std::string &trajectory : options.trajectories)
    console.say("Trajectory (world_from_camera): " + trajectory);
}

nlohmann::ordered_json resultJson(const MapOptions &options, const MapOutcome &outcome,
                                  const std::optional<CalibrationDifference> &refined) {
  nlohmann::ordered_json json = {{"model", options.model}};
  json.update(mapJson(outcome));
  if (options.trajectories.size() == 1) json["trajectory"] = options.trajectories[0];
  for (size_t i = 0; i < options.trajectories.size(); ++i)
    json["recordings"][i]["trajectory"] = options.trajectories[i];
  if (refined)
    json["refined_calibration"] = {{"path", options.refined_calibration},
                                   {"color_px", refined->color.largest_px},
                                   {"depth_at_1_m_px", refined->depth_to_color[1].largest_px}};
  return json;
}

int run(const CLI::App &app, MapOptions options, const Console &console) {
  checkMapOptions(app, options);
  callNewHandlerForCholmod();
  std::optional<CalibrationDifference> refined;
  if (!options.refined_calibration.empty()) refined = refine(&options, console);
  const MapOutcome outcome = mapRecordings(options, console);
  const std::string why_none = whyNoModel(options, outcome);
  if (why_none.empty()) writeFiles(options, outcome);  // before words, whose reader may be gone
  tellOfMap(options, outcome, console);
  if (!why_none.empty()) throw std::runtime_error(why_none);
  checkContradictions(options, outcome);
  tellOfFiles(options, outcome, console);
  console.give(resultJson(options, outcome, refined));
  return outcome.isApart() ? kExitWalkApart : kExitDone;
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
  addMapOptions(app, options.get());
  return {app, [app, options](const Console &console) { return run(*app, *options, console); }};
}

}  // namespace sphc::host
