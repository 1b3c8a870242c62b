#include "host/cli/common/point_source.h"

#include <cmath>
#include <sstream>

#include "host/base/counted.h"
#include "host/base/usage_error.h"
#include "host/cli/common/contradictions.h"
#include "host/cli/common/light_options.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/progress.h"
#include "host/import/model_file.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

constexpr const char *kMappingGroup = "Mapping";
constexpr double kMostScaleSpread = 0.05;  // beyond it the depth images are probably of another camera

void addColmapOptions(CLI::App *app, PointSource *source) {
  const char *group = "COLMAP";
  ColmapImportOptions &colmap = source->colmap;
  CLI::Option *model =
      app->add_option("--colmap", colmap.model, "Model to take in place of a recording: the folder of cameras.bin")
          ->type_name("DIR")
          ->group(group);
  app->add_option("--images", colmap.images, "Its images, to be described anew for the device")
      ->type_name("DIR")
      ->needs(model)
      ->group(group);
  app->add_option("--database", colmap.database,
                  "Its database.db, whose descriptors are taken when there is no --images")
      ->type_name("FILE")
      ->needs(model)
      ->group(group);
  app->add_option("--scale", colmap.metres_per_unit, "Metres a unit of the model")
      ->check(between(1e-9, 1e9))
      ->type_name("X")
      ->needs(model)
      ->group(group);
  app->add_option("--depth", colmap.depth,
                  "Depth images that tell the scale: X.png for X.jpg; --calibration says where their camera was")
      ->type_name("DIR")
      ->needs(model)
      ->group(group);
  app->add_option("--gravity", source->gravity,
                  "Down in the model: X,Y,Z; level: cameras were held level; none: the axes stay")
      ->capture_default_str()
      ->needs(model)
      ->group(group);
}

std::optional<Vector3> gravityFrom(const std::string &text) {
  if (text == "level") return std::nullopt;
  if (text == "none") return Vector3(Vector3::Zero());
  std::istringstream in(text);
  Vector3 down;
  char comma = 0, second = 0;
  if (!(in >> down.x() >> comma >> down.y() >> second >> down.z()) || comma != ',' || second != ',' || !in.eof() ||
      !(down.norm() > 0))
    throw UsageError("--gravity is level, none or a direction such as 0,1,0");
  return down;
}

// Both must outlive it.
Progress shownBy(ProgressBar *bar, const Interrupt *interrupt) {
  return [bar, interrupt](uint32_t done, uint32_t total) {
    if (interrupt) interrupt->throwIfCame();
    bar->show(done, total);
  };
}

ImportedPoints fromColmap(const PointSource &source, const Interrupt &interrupt) {
  ColmapImportOptions options = source.colmap;
  options.descriptors = options.images.empty() ? ColmapDescriptors::kDatabase : ColmapDescriptors::kAgain;
  options.calibration = source.recording.calibration;
  options.gravity = gravityFrom(source.gravity);
  ProgressBar bar("describing");
  ImportedPoints imported;
  ColmapImportSummary summary;
  imported.model = importColmap(options, shownBy(&bar, &interrupt), &summary);
  imported.told = "Took " + std::to_string(summary.points_kept) + " of " + std::to_string(summary.points_of_model) +
                  " points of the COLMAP model; one unit of it is " + fixed(summary.metres_per_unit, 4) + " m.";
  if (summary.scale_spread > kMostScaleSpread)
    imported.warnings.push_back("the images disagree on the scale by " + fixed(100 * summary.scale_spread, 0) +
                                " %: is --calibration that of the depth images?");
  nlohmann::ordered_json axes = nlohmann::ordered_json::array();
  for (int i = 0; i < 9; ++i) axes.push_back(summary.world_from_model_axes(i / 3, i % 3));
  imported.facts = {{"images", summary.images},
                    {"points_of_model", summary.points_of_model},
                    {"points_described", summary.points_described},
                    {"points_kept", summary.points_kept},
                    {"metres_per_unit", summary.metres_per_unit},
                    {"scale_spread", summary.scale_spread},
                    {"world_from_model_axes", axes}};
  return imported;
}

uint32_t onWhatMoved(const RgbdImportSummary &summary) {
  return summary.moving.seen_through + summary.moving.within_reach;
}

// Of a recording that gave no point at all: what stood in the way.
void checkPoints(const RgbdImportSummary &summary, const RgbdImportOptions &options) {
  if (summary.points_kept > 0) return;
  if (summary.keypoints == 0)
    throw std::runtime_error("the images show nothing to map, not one keypoint; are they black, blank or blurred?");
  if (summary.lifted == 0)
    throw std::runtime_error(
        "none of " + std::to_string(summary.keypoints) + " keypoints has a depth of " +
        fixed(options.depth_min_m, 2) + " to " + fixed(options.depth_max_m, 2) +
        " m; is that the range of the room (--depth-min, --depth-max), and depth_unit_m of the "
        "calibration right?");
  const std::string none = "none of " + counted(summary.points_dropped, "point");
  if (onWhatMoved(summary) + summary.fixed_in_image + summary.moving.gone > 0)
    throw std::runtime_error(none +
                             " is sure and on what stays where it is; record the place without what moves, or "
                             "keep it with --keep-moving");
  if (options.min_observations == 1)
    throw std::runtime_error(none +
                             " is sure: no two frames agree on one, and the depth around each scatters; record "
                             "more frames of each place, slower, and look at the depth images");
  throw std::runtime_error(none + " was seen in " + counted(options.min_observations, "frame") +
                           "; record more frames of each place, or give a smaller --min-observations");
}

std::string movingText(const RgbdImportSummary &summary) {
  const uint32_t dropped = onWhatMoved(summary);
  std::string text = dropped ? ", " + std::to_string(dropped) + " of them on what moved" : "";
  if (summary.fixed_in_image)
    text += ", " + std::to_string(summary.fixed_in_image) + " of them on what is fixed in the image";
  if (summary.moving.gone)
    text += ", " + std::to_string(summary.moving.gone) + " of them on what later recordings see through";
  return text;
}

ImportedPoints fromModel(const PointSource &source) {
  ImportedPoints imported;
  imported.model = readModelFile(source.model);
  imported.told = "Read " + counted(imported.model.points.size(), "point") + " of " + source.model + ".";
  imported.facts = {{"model", source.model}, {"points_kept", imported.model.points.size()}};
  return imported;
}

}  // namespace

ImportedPoints importRecordings(const std::vector<RgbdSource> &recordings, const RgbdImportOptions &options,
                                const std::string &selection, const Interrupt *interrupt) {
  uint32_t frames = 0;
  for (const RgbdSource &source : recordings) frames += source.reader->frameCount();
  checkObservations(options, frames);
  ProgressBar bar("mapping   ");
  ImportedPoints imported;
  RgbdImportSummary summary;
  imported.model = importRgbd(recordings, options, shownBy(&bar, interrupt), &summary);
  checkPoints(summary, options);
  imported.told = "Mapped " + counted(summary.frames_used, "frame") + " (" + selection +
                  "): " + counted(summary.points_kept, "point") + " kept, " +
                  std::to_string(summary.points_dropped) + " dropped" + movingText(summary) + ".";
  imported.warnings = summary.moving.doubts;
  for (const std::string &left_out : framesLeftOut(summary)) imported.warnings.push_back(left_out);
  for (const std::string &fault : faultsOfFrames(summary)) imported.warnings.push_back(fault);
  imported.contradictions = contradictionsOf(summary);
  imported.doubts = doubtsOfPoses(summary);
  imported.facts = {{"frames_used", summary.frames_used},
                    {"frames_without_pose", summary.frames_without_pose},
                    {"frames_unreadable", summary.frames_unreadable},
                    {"frames_empty", summary.frames_empty},
                    {"frames_apart", summary.frames_apart},
                    {"frames_bent", summary.frames_bent},
                    {"row_time_ns", options.row_time_ns},
                    {"keypoints", summary.keypoints},
                    {"lifted", summary.lifted},
                    {"merged", summary.merged},
                    {"points_kept", summary.points_kept},
                    {"points_dropped", summary.points_dropped},
                    {"points_seen_through", summary.moving.seen_through},
                    {"points_within_reach", summary.moving.within_reach},
                    {"points_fixed_in_image", summary.fixed_in_image},
                    {"points_gone", summary.moving.gone},
                    {"views_disagree", summary.moving.disagreement},
                    {"matches_between_frames", summary.scale.matches},
                    {"matches_where_poses_say", summary.scale.agree}};
  return imported;
}

std::array<CLI::Option *, 2> addDepthRangeOptions(CLI::App *app, double *depth_min_m, double *depth_max_m) {
  return {app->add_option("--depth-min", *depth_min_m, "Nearest depth used, metres")
              ->capture_default_str()
              ->check(between(0.01, 100))
              ->group(kMappingGroup),
          app->add_option("--depth-max", *depth_max_m, "Farthest depth used, metres")
              ->capture_default_str()
              ->check(notNegative())
              ->group(kMappingGroup)};
}

void addMappingOptions(CLI::App *app, RgbdImportOptions *import) {
  app->add_option("--max-keypoints", import->max_keypoints, "Strongest keypoints of a frame")
      ->capture_default_str()
      ->transform(wholeFrom(1, 100000))
      ->group(kMappingGroup);
  app->add_option("--min-observations", import->min_observations, "Frames that must agree on a point")
      ->capture_default_str()
      ->transform(wholeFrom(1, kMostObservations))
      ->group(kMappingGroup);
  addDepthRangeOptions(app, &import->depth_min_m, &import->depth_max_m);
  addRowTimeOption(app, &import->row_time_ns, "needs poses (map: frames) at 20 Hz or more; tell it to localize too")
      ->group(kMappingGroup);
  app->add_flag("--keep-moving", import->keep_moving,
                "Keep points on people, hands, feet, things that were moved, and what is drawn over the image")
      ->group(kMappingGroup);
}

void addPointSourceOptions(CLI::App *app, PointSource *source) {
  CLI::Option *recording = addRecordingOptions(app, &source->recording)->required(false);
  addPosesOption(app, &source->recording)->needs(recording);
  app->get_option("--pose-gap-ms")->needs(recording);
  addMappingOptions(app, &source->import);
  addColmapOptions(app, source);
  auto *model =
      app->add_option("--model", source->model, "Point model to take in place of a recording: from --save-model")
          ->type_name("FILE");
  const auto is_of_mapping = [](const CLI::Option *option) { return option->get_group() == kMappingGroup; };
  for (CLI::Option *option : app->get_options(is_of_mapping))
    option->excludes(model)->excludes(app->get_option("--colmap"));  // these have their points already
}

void checkDepthRange(double depth_min_m, double depth_max_m) {
  if (depth_min_m >= depth_max_m)
    throw UsageError("--depth-min must be less than --depth-max, or no depth is left");
}

void checkMappingOptions(const RgbdImportOptions &import) {
  checkDepthRange(import.depth_min_m, import.depth_max_m);
}

void checkObservations(const RgbdImportOptions &import, uint64_t frames, const char *which) {
  if (import.min_observations > frames)
    throw UsageError("--min-observations " + std::to_string(import.min_observations) +
                     ": no point can be seen in so many of " + counted(frames, "frame") + which +
                     "; give a smaller number");
}

void checkPointSource(const PointSource &source) {
  const ColmapImportOptions &colmap = source.colmap;
  const int sources = !source.recording.folder.empty() + !colmap.model.empty() + !source.model.empty();
  if (sources == 0) throw UsageError("--recording, --colmap or --model is required, one of the three");
  if (sources > 1) throw UsageError("--recording, --colmap and --model exclude each other; give one of the three");
  if (source.recording.folder.empty() && source.recording.isPart())
    throw UsageError("--first, --last and --step choose frames of a --recording; leave them out");
  if (!source.model.empty() && !source.recording.calibration.empty())
    throw UsageError("--calibration is of a --recording or of --colmap; leave it out");
  gravityFrom(source.gravity);
  checkMappingOptions(source.import);
  if (colmap.model.empty()) return;
  if (colmap.images.empty() && colmap.database.empty())
    throw UsageError("--colmap needs --images, to describe them for the device, or --database");
  if (!colmap.metres_per_unit && colmap.depth.empty())
    throw UsageError(
        "a COLMAP model has no scale: give --scale, metres a unit, or --depth, a folder of depth images");
}

ImportedPoints importPoints(const PointSource &source, const Interrupt &interrupt, const Console &console) {
  if (!source.model.empty()) return fromModel(source);
  if (!source.colmap.model.empty()) return fromColmap(source, interrupt);
  const auto reader = openRecording(source.recording);
  noteDamage(*reader, console);
  return importRecordings({{reader.get()}}, source.import, describeSelection(source.recording), &interrupt);
}

}  // namespace sphc::host
