// spherecloud-lab align: depth alignment beside its peers.
#include <memory>

#include "host/base/checked_call.h"
#include "host/base/write_file.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "host/report/file.h"
#include "host/report/picture_file.h"
#include "lab/align/bench.h"
#include "lab/cli/commands.h"
#include "lab/cli/options.h"
#include "lab/cli/words.h"

namespace sphc::host {
namespace {

struct AlignOptions {
  RecordingOptions recording;
  uint32_t repeats = 5;
  std::string out, results;
  bool no_peers = false, force = false;
};

std::vector<uint8_t> grayOf(const sphc_image &color) {
  std::vector<uint8_t> gray;
  for (uint32_t y = 0; y < color.height; ++y) {
    const auto *row = static_cast<const uint8_t *>(color.data) + size_t{y} * color.stride_bytes;
    for (uint32_t x = 0; x < color.width; ++x)  // blue, green, red
      gray.push_back(
          static_cast<uint8_t>((29u * row[3 * x] + 150u * row[3 * x + 1] + 77u * row[3 * x + 2] + 128u) >> 8));
  }
  return gray;
}

std::vector<uint16_t> depthOf(const sphc_image &depth) {
  std::vector<uint16_t> pixels;
  for (uint32_t y = 0; y < depth.height; ++y) {
    const auto *row = static_cast<const uint16_t *>(depth.data) + size_t{y} * (depth.stride_bytes / 2);
    pixels.insert(pixels.end(), row, row + depth.width);
  }
  return pixels;
}

AlignCase readCase(const AlignOptions &options, const Console &console) {
  const auto reader = openRecording(options.recording);
  const sphc_rig &calibration = reader->calibration();
  AlignCase c;
  c.name = std::to_string(calibration.depth_camera.width) + "x" + std::to_string(calibration.depth_camera.height);
  c.rig = calibration;
  forReadableFrames(reader.get(), saidBy(console), [&c](uint32_t, const sphc_localizer_frame &frame) {
    c.frames.push_back({grayOf(frame.color), depthOf(frame.depth)});
  });
  return c;
}

std::vector<AlignCase> casesOf(const AlignOptions &options, const Console &console) {
  std::vector<AlignCase> cases = {readCase(options, console)};
  const sphc_camera depth = cases[0].depth();
  if (depth.width == 640 && depth.height == 480)
    cases.push_back(tofCase(cases[0]));
  else
    console.warn("note: no 320 x 288 table; it is made of depth images of 640 x 480 only");
  return cases;
}

int run(const AlignOptions &options, const Console &console) {
  FileUse files(options.force);
  files.reads(options.recording);
  files.writes("--results", options.results, holds(alignResults({})));
  files.writesFolder("--out", options.out, holds(kPictureMark));
  files.check();
  const int core = pinToOneCore();
  std::vector<AlignVariant> variants = {ourAligner(), plainLoop()};
  if (!options.no_peers) variants.push_back(openCvAligner());
  for (const AlignVariant &variant : variants)
    if (!variant.make) console.warn("note: " + variant.name + " is absent, " + variant.absent);
  console.say(pinnedText(core));
  std::vector<AlignTable> tables;
  if (!options.out.empty()) makeFolder(options.out);
  for (const AlignCase &c : casesOf(options, console)) {
    ProgressBar bar("measuring ");
    tables.push_back(runAlignBench(c, variants, options.repeats,
                                   [&bar](uint32_t done, uint32_t total) { bar.show(done, total); }));
    console.say("\n" + alignText(tables.back()));
    if (!options.out.empty()) writeAlignPicture(c, options.out + "/align_" + c.name + ".png");
  }
  if (!options.results.empty()) writeFile(options.results, alignResults(tables));
  if (!options.out.empty()) console.say("Wrote " + options.out + ".");
  console.give({{"core", core}, {"repeats", options.repeats}, {"tables", alignJson(tables)}});
  return kExitDone;
}

const char kAlignHelp[] =
    "Brings the depth images of a recording to its colour camera with each aligner in turn, on one core: time,\n"
    "coverage, and the median distance from depth edges to image edges, before and after.  docs/bench.md says "
    "more.";
const char kAlignExample[] =
    "Example:\n"
    "  spherecloud-lab align --recording seq-01 --calibration kinect.json --step 20 --out bench\n"
    "What comes out: a table for the recording and one for a 320 x 288 sensor made of it; with --out, pictures of\n"
    "depth edges over the image before and after, and of the mask.";

}  // namespace

Command alignCommand(CLI::App *root) {
  auto options = std::make_shared<AlignOptions>();
  CLI::App *app = root->add_subcommand("align");
  app->description("Depth alignment beside its peers.\n\n" + std::string(kAlignHelp));
  app->footer(kAlignExample);
  addRecordingOptions(app, &options->recording);
  addRepeatOption(app, &options->repeats);
  app->add_flag("--no-peers", options->no_peers, "Without OpenCV");
  app->add_option("-o,--out", options->out, "Folder for pictures")->type_name("DIR");
  app->add_option("--results", options->results, "Write ratios and errors, no milliseconds")->type_name("FILE");
  addForceOption(app, &options->force);
  return {app, [options](const Console &console) { return run(*options, console); }};
}

}  // namespace sphc::host
