#include "host/cli/common/rig_options.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "host/base/checked_call.h"
#include "host/base/usage_error.h"
#include "host/cli/common/number_checks.h"

namespace sphc::host {

void addRigOptions(CLI::App *app, RigOptions *options) {
  const char *group = "Cameras";
  const auto add = [&](const char *name, auto &field, const char *text) {
    return app->add_option(name, field, text)->group(group);
  };
  add("--device", options->both, "A camera that gives colour and depth: openni2:, replay:FOLDER, simulated:")
      ->type_name("CAMERA");
  add("--color", options->color, "Or a colour camera: v4l2:/dev/video0, libcamera:")->type_name("CAMERA");
  add("--depth", options->depth, "and a depth camera: v4l2:/dev/video2")->type_name("CAMERA");
  add("-c,--calibration", options->wish.calibration, "Calibration file; `spherecloud calibration` makes one")
      ->type_name("FILE");
  const char *size = "as the calibration has it, else 640 x 480";
  add("--width", options->wish.width, "Size of V4L2 and libcamera images, of colour and depth alike, pixels")
      ->default_str(size)
      ->transform(wholeFrom(0, UINT32_MAX));
  add("--height", options->wish.height, "The same")->default_str(size)->transform(wholeFrom(0, UINT32_MAX));
  add("--fps", options->wish.fps, "Of the same cameras, images a second; 0: whatever the camera does")
      ->capture_default_str()
      ->transform(wholeFrom(0, UINT32_MAX));
  add("--tolerance-ms", options->tolerance_ms, "Colour and depth are a pair when taken at most so far apart")
      ->capture_default_str()
      ->check(between(0, 1000));
}

namespace {

bool hasModes(const std::string &camera) {
  return camera.rfind("v4l2:", 0) == 0 || camera.rfind("libcamera:", 0) == 0;
}

// Other cameras would leave it out without a word.
void checkModes(const RigOptions &options) {
  if (hasModes(options.color) || hasModes(options.depth)) return;
  const std::pair<const char *, uint32_t> wishes[] = {
      {"--width", options.wish.width}, {"--height", options.wish.height}, {"--fps", options.wish.fps}};
  for (const auto &[name, wish] : wishes)
    if (wish > 0)
      throw UsageError(std::string(name) +
                       " is of v4l2: and libcamera: cameras; leave it out, since others keep "
                       "the mode that they have");
}

}  // namespace

void checkRigOptions(const RigOptions &options) {
  const bool two = !options.color.empty() && !options.depth.empty();
  const bool any_of_two = !options.color.empty() || !options.depth.empty();
  if (!options.both.empty() && any_of_two)
    throw UsageError("--device gives colour and depth; leave it out, or --color and --depth");
  if (options.both.empty() && !two)
    throw UsageError("give --device, or --color and --depth; `spherecloud devices` lists what is there");
  checkModes(options);
}

sphc_rig calibrationOf(const RigOptions &options, const Rig &rig) {
  sphc_rig calibration;
  const std::string &path = options.wish.calibration;
  if (!path.empty())
    orThrow("calibration",
            [&](sphc_message *message) { return sphc_calibration_read(path.c_str(), &calibration, message); });
  else if (!rig.calibration(&calibration))
    throw std::runtime_error("these cameras do not know their calibration; give --calibration FILE");
  return calibration;
}

}  // namespace sphc::host
