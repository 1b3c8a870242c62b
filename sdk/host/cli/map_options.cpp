#include "host/cli/map_options.h"

#include <filesystem>
#include <system_error>

#include "host/base/counted.h"
#include "host/base/usage_error.h"
#include "host/cli/common/choices.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/light_options.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/recording_options.h"
#include "host/import/model_file.h"
#include "host/report/trajectory.h"

namespace sphc::host {
namespace {

// Two of one would agree with each other on everything, and count twice.
void checkDifferent(const std::vector<std::string> &recordings) {
  for (size_t i = 0; i < recordings.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      std::error_code error;
      if (std::filesystem::equivalent(recordings[j], recordings[i], error))
        throw UsageError("--recording: " + recordings[j] + " and " + recordings[i] +
                         " are one recording; give each once");
    }
}

void checkCount(const char *option, const std::vector<std::string> &files, size_t recordings) {
  if (!files.empty() && files.size() != recordings)
    throw UsageError(std::string(option) + " is given " + counted(files.size(), "time") + " for " +
                     counted(recordings, "recording") + "; give it once for each, in the same order");
}

// Each of these says how much to believe of poses in one use of them.
void checkTrust(const CLI::App &app, PoseUse use) {
  const struct {
    const char *option, *poses;
    PoseUse use;
  } known[] = {{"--pose-sigma", "approximate", PoseUse::kApproximate},
               {"--pose-sigma-deg", "approximate", PoseUse::kApproximate},
               {"--drift", "odometry", PoseUse::kOdometry},
               {"--drift-deg", "odometry", PoseUse::kOdometry}};
  for (const auto &one : known)
    if (app.count(one.option) > 0 && use != one.use)
      throw UsageError(std::string(one.option) + " is of --poses " + one.poses + "; give that, or leave it out");
}

void addPoseOptions(CLI::App *app, MapOptions *options) {
  const char *group = "Poses that are known";
  CLI::Option *poses =
      app->add_option("--poses", options->trust.use,
                      "What to believe of the recording's poses [none]:\n"
                      "  none          nothing\n"
                      "  odometry      how neighbouring frames moved; it drifts\n"
                      "  approximate   where each frame was, but for noise; the map is in their world")
          ->transform(oneOf<PoseUse>(
              {{"none", PoseUse::kNone}, {"odometry", PoseUse::kOdometry}, {"approximate", PoseUse::kApproximate}}))
          ->type_name("HOW")
          ->group(group);
  app->add_option("--poses-from", options->told,
                  "File of poses in TUM format, in place of the recording's; once for each recording")
      ->expected(1)
      ->take_all()
      ->type_name("FILE")
      ->group(group);
  app->add_option("--pose-sigma", options->trust.sigma_m, "Approximate: how far places are off, metres, 1 sigma")
      ->capture_default_str()
      ->check(between(1e-4, 10))
      ->needs(poses)
      ->type_name("M")
      ->group(group);
  app->add_option("--pose-sigma-deg", options->sigma_deg, "Approximate: how far they are turned, degrees")
      ->capture_default_str()
      ->check(between(1e-3, 90))
      ->needs(poses)
      ->type_name("DEG")
      ->group(group);
  app->add_option("--drift", options->drift_percent,
                  "Odometry: how far a metre of the way is off, per cent, 1 sigma")
      ->capture_default_str()
      ->check(between(0, 100))
      ->needs(poses)
      ->type_name("PERCENT")
      ->group(group);
  app->add_option("--drift-deg", options->drift_deg, "Odometry: how far a metre turns it, degrees")
      ->capture_default_str()
      ->check(between(0, 90))
      ->needs(poses)
      ->type_name("DEG")
      ->group(group);
  app->add_flag("--upright", options->trust.keeps_axes,
                "Odometry: the axes of its world become the map's, so that what is vertical there is so here")
      ->group(group);
}

}  // namespace

MappingOptions MapOptions::mapping() const {
  MappingOptions mapping;
  mapping.trust = trust;
  mapping.trust.sigma_rad = sigma_deg * kPi / 180;
  mapping.trust.drift_m = drift_percent / 100;
  mapping.trust.drift_rad = drift_deg * kPi / 180;
  mapping.threads = threads;
  return mapping;
}

std::vector<RecordingOptions> MapOptions::all() const {
  std::vector<RecordingOptions> all(recordings.size(), of_each);
  for (size_t i = 0; i < all.size(); ++i) all[i].folder = recordings[i];
  return all;
}

void addMapOptions(CLI::App *app, MapOptions *options) {
  addRecordingsOptions(app, &options->recordings, &options->of_each);
  app->add_option("--model", options->model, "Private file for the points, for build --model")
      ->required()
      ->type_name("FILE");
  app->add_option("--trajectory", options->trajectories,
                  "Poses of all frames in TUM format; once for each recording, in the same order")
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
  app->add_option("--refine-calibration", options->refined_calibration,
                  "Adjust the calibration too, write it there and map with it; about three times as long")
      ->type_name("FILE");
  app->add_option("--threads", options->threads, "At most so many; 0: one for each core")
      ->capture_default_str()
      ->transform(wholeFrom(0, 256))
      ->type_name("N");
  app->add_flag("--score", options->score, "Compare with the recording's own poses");
  addPoseOptions(app, options);
  addMappingOptions(app, &options->import);
  addBandOption(app, &options->band, "The light of the images; a camera must see the same to localize in the map");
  addForceOption(app, &options->force);
}

void checkMapOptions(const CLI::App &app, const MapOptions &options) {
  FileUse files(options.force);
  for (const RecordingOptions &recording : options.all()) files.reads(recording);
  for (const std::string &file : options.told) files.reads("--poses-from", file);
  files.writes("--model", options.model, isModelFile);
  for (const std::string &file : options.trajectories) files.writes("--trajectory", file, holds(tumMark("map")));
  files.writes("--refine-calibration", options.refined_calibration, never());
  files.check();
  checkDifferent(options.recordings);
  checkMappingOptions(options.import);
  checkTrust(app, options.trust.use);
  checkCount("--trajectory", options.trajectories, options.recordings.size());
  checkCount("--poses-from", options.told, options.recordings.size());
  if (options.trust.use == PoseUse::kNone && !options.told.empty())
    throw UsageError("--poses-from needs --poses, which says how much to believe of them");
  if (options.trust.use != PoseUse::kOdometry && options.trust.keeps_axes)
    throw UsageError("--upright needs --poses odometry; approximate poses keep the recording's world anyway");
}

}  // namespace sphc::host
