// spherecloud guide: what would have been said while a recording was made?
#include <chrono>
#include <cmath>
#include <memory>

#include "host/base/counted.h"
#include "host/base/usage_error.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/point_source.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "host/guide/guide_words.h"
#include "host/guide/look_pace.h"
#include "host/guide/walk_guide.h"

namespace sphc::host {
namespace {

struct GuideOptions {
  RecordingOptions recording;
  WalkGuide::Options guide;
  bool score = false;
};

// How far the two views of a loop are from where the recording's own poses say.
nlohmann::ordered_json scoreOf(const GuideStep &step, const RecordingReader &reader) {
  const auto now = reader.worldFromCameraAt(step.time_ns), then = reader.worldFromCameraAt(step.loop->time_then_ns);
  if (!now || !then) return nullptr;
  const Rigid off = step.loop->now_from_then.inverse() * rigidFromC(*now).inverse() * rigidFromC(*then);
  return {{"rotation_deg", rotationAngle(off.rotation) * 180 / M_PI}, {"translation_m", off.translation_m.norm()}};
}

void lookAt(const sphc_localizer_frame &images, const GuideOptions &options, const RecordingReader &reader,
            WalkGuide *guide, const Console &console) {
  const auto begin = std::chrono::steady_clock::now();
  const GuideStep step = guide->look(images);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  nlohmann::ordered_json json = stepJson(step);
  json["ms"] = std::round(1000 * ms) / 1000;
  if (options.score && step.loop) json["loop"]["error"] = scoreOf(step, reader);
  console.giveLine(json);
}

int run(const GuideOptions &options, const Console &console) {
  if (options.score && !console.json) throw UsageError("--score is of the lines of --json; give that too");
  checkDepthRange(options.guide.depth_min_m, options.guide.depth_max_m);
  const auto reader = openRecording(options.recording);
  noteDamage(*reader, console);
  WalkGuide guide(reader->calibration(), options.guide);
  LookPace pace;
  uint32_t unreadable = 0, looked_at = 0;
  std::string why, first_why;
  {
    ProgressBar bar("looking");
    for (uint32_t i = 0; i < reader->frameCount(); ++i) {
      bar.show(i, reader->frameCount());
      if (!pace.isDue(reader->colorOf(i).time_ns)) continue;
      const std::optional<sphc_localizer_frame> images = reader->tryRead(i, &why);
      if (!images && ++unreadable == 1) first_why = why;
      if (!images) continue;
      ++looked_at;
      pace.looked(images->color_time_ns);
      lookAt(*images, options, *reader, &guide, console);
    }
  }
  if (unreadable && looked_at == 0) throw std::runtime_error("not one frame can be read; the first: " + first_why);
  if (unreadable)
    console.warn("note: " + counted(unreadable, "frame") + " could not be read; the first: " + first_why);
  const WalkSummary summary = guide.summary();
  console.say(tableText(summaryRows(summary)) + nextSteps(summary));
  console.giveLine({{"summary", summaryJson(summary)}});
  return kExitDone;
}

}  // namespace

Command guideCommand(CLI::App *root) {
  auto options = std::make_shared<GuideOptions>();
  CLI::App *app = root->add_subcommand("guide");
  app->description(
      "Look at a recording as `record --guide` does.\n\nWhat was covered, which loops were closed and which "
      "stretches will be hard to map; with --json\na line of JSON for each frame that is looked at too.");
  app->footer("Example:\n  spherecloud guide --recording walk.mcap");
  addRecordingOptions(app, &options->recording);
  addDepthRangeOptions(app, &options->guide.depth_min_m, &options->guide.depth_max_m);
  app->add_flag("--score", options->score, "With --json: compare loops with the recording's own poses");
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
