#include "lab/cli/options.h"

#include <stdexcept>

#include "host/base/usage_error.h"
#include "host/cli/common/choices.h"

namespace sphc::host {

void addPoseRunOptions(CLI::App *app, PoseRunOptions *options, const std::string &what) {
  app->add_option("--depth", options->depths,
                  "tof: as the sensor measured; oracle: of the true points; repeat for both")
      ->transform(oneOf<DepthSource>({{"tof", DepthSource::kTof}, {"oracle", DepthSource::kOracle}}))
      ->expected(1)
      ->take_all()
      ->type_name("tof|oracle");
  addRepeatOption(app, &options->bench.repeats);
  addOnlyOption(app, &options->only, what);
  app->add_option("--every", options->every, "Every N-th query of the files only")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000000u))
      ->type_name("N");
}

void addRepeatOption(CLI::App *app, uint32_t *repeats) {
  app->add_option("--repeat", *repeats, "Runs of which the median time counts")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u))
      ->type_name("N");
}

void addOnlyOption(CLI::App *app, std::vector<std::string> *only, const std::string &what) {
  app->add_option("--only", *only, "Only the " + what + " of this name; repeat for more")
      ->expected(1)
      ->take_all()
      ->type_name("NAME");
}

std::unique_ptr<RecordingReader> openRecordingWithPoses(const RecordingOptions &options) {
  auto reader = openRecording(options);
  for (uint32_t i = 0; i < reader->frameCount(); ++i)
    if (reader->worldFromCamera(i)) return reader;
  throw std::runtime_error("no frame of " + options.folder +
                           " has a pose (groundtruth.txt, *.pose.txt), so nothing tells right from wrong; give a "
                           "recording with poses");
}

bool isChosen(const std::vector<std::string> &only, const std::string &name) {
  return only.empty() || std::count(only.begin(), only.end(), name) > 0;
}

void checkChoice(const std::vector<std::string> &only, const std::vector<std::string> &names) {
  std::string known;
  for (const std::string &name : names) known += (known.empty() ? "'" : ", '") + name + "'";
  for (const std::string &name : only)
    if (std::count(names.begin(), names.end(), name) == 0)
      throw UsageError("--only '" + name + "': there is none of that name; choose from: " + known);
}

}  // namespace sphc::host
