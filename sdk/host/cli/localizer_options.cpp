#include "host/cli/localizer_options.h"

#include "host/cli/common/choices.h"
#include "host/cli/common/light_options.h"
#include "host/cli/common/number_checks.h"
#include "host/evaluate/localize_run.h"

namespace sphc::host {
namespace {

const char kGroup[] = "Localizer";

template <typename Field>
CLI::Option *add(CLI::App *app, const char *name, Field *field, const char *text) {
  return app->add_option(name, *field, text)->capture_default_str()->group(kGroup);
}

void addSearchOptions(CLI::App *app, LocalizerOptions *options) {
  Parameters *parameters = &options->parameters;
  add(app, "--seed", &options->config.seed, "Seed of the random samples; the same seed gives the same answers")
      ->transform(wholeFrom(0));
  add(app, "--max-keypoints", &options->config.max_keypoints, "Strongest keypoints of a frame, 64 to 4096")
      ->transform(wholeFrom(0, UINT32_MAX));
  add(app, "--ratio", &parameters->max_ratio, "Ratio test: best distance over second best, 0.1 to 1");
  add(app, "--max-iterations", &parameters->max_iterations,
      "Most samples drawn in one search; a frame takes one to a few");
  add(app, "--min-inliers", &parameters->min_inliers, "A pose with fewer is not given out");
  add(app, "--probes", &parameters->probes, "Cells of the map's index searched for each keypoint, 1 to 32; 0: all");
  app->add_option("--mode", options->config.mode, "tracking: frames follow each other; single: each frame alone")
      ->transform(oneOf<sphc_localizer_mode>({{"tracking", SPHC_MODE_TRACKING}, {"single", SPHC_MODE_SINGLE}}))
      ->default_str("tracking")
      ->type_name("tracking|single")
      ->group(kGroup);
  add(app, "--deadline-us", &options->deadline_us,
      "Time for a frame, after which the best pose so far is given out; 0: no deadline")
      ->transform(wholeFrom(0, UINT32_MAX));
}

void addNoiseOptions(CLI::App *app, sphc_localizer_config *config) {
  add(app, "--depth-min", &config->depth_min_m, "Nearest depth used, metres");
  add(app, "--depth-max", &config->depth_max_m, "Farthest depth used, metres");
  add(app, "--depth-sigma", &config->depth_sigma_m, "Depth noise at z: this + the next * z^2, metres");
  add(app, "--depth-sigma-per-m2", &config->depth_sigma_per_m2, "See --depth-sigma");
  add(app, "--pixel-sigma", &config->pixel_sigma_px, "Noise of a keypoint's position, pixels");
  add(app, "--map-sigma", &config->map_sigma_m, "Error of a map point across its direction, metres");
  add(app, "--depth-mid", &config->depth_mid_m,
      "Where the depth sensor's offset is stated, metres; 0: geometric mean of its range");
  add(app, "--depth-offset-sigma", &config->depth_offset_sigma_m,
      "Unknown offset of the depth sensor there, metres; 0 with the next 0: a sensor without bias");
  add(app, "--depth-slope-sigma", &config->depth_slope_sigma, "Unknown slope of its error over depth");
}

void addLightOptions(CLI::App *app, sphc_localizer_config *config) {
  addBandOption(app, &config->color_band, "The light that the colour camera sees; a map must be of the same")
      ->group(kGroup);
  addAmplitudeOption(app, &config->amplitude_min)->group(kGroup);
  addRowTimeOption(app, &config->color_row_time_ns,
                   "for --mode tracking and frames at most 0.25 s apart; tell it to build too")
      ->group(kGroup);
}

}  // namespace

void addLocalizerOptions(CLI::App *app, LocalizerOptions *options) {
  addSearchOptions(app, options);
  addNoiseOptions(app, &options->config);
  addLightOptions(app, &options->config);
}

void noteRowsThatStay(const LocalizerOptions &options, double step_s, const Console &console) {
  if (options.config.color_row_time_ns == 0) return;
  const auto note = [&console](const std::string &why, const std::string &cure) {
    console.warn("note: --row-time-ns: how the camera moves is not known " + why +
                 ", so rows stay where they are, and poses are less sure by that; " + cure);
  };
  if (options.config.mode != SPHC_MODE_TRACKING)
    return note("in --mode single", "--mode tracking straightens them");
  if (step_s > kLongestStepS)
    note("between frames " + fixed(step_s, 2) + " s apart, with --odometry neither",
         "choose frames at most " + fixed(kLongestStepS, 2) + " s apart (a smaller --step)");
}

}  // namespace sphc::host
