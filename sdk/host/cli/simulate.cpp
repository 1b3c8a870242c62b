// spherecloud simulate: a recording of the simulated headset's walk.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "drivers/simulated/simulated.h"
#include "host/base/checked_call.h"
#include "host/base/counted.h"
#include "host/base/shell_word.h"
#include "host/base/usage_error.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/light_options.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_out.h"
#include "host/live/interrupt.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

struct SimulateOptions {
  std::string out;
  sphc_simulated_config config = {};
  std::optional<double> lap_s;
  std::string with, cameras = "headset";
  const CLI::Option *exposure = nullptr;
  double accelerometer_hz = 0, poses_hz = 0;
  bool ideal_depth = false, raw_depth = false, no_noise = false, no_blur = false, no_exposure_drift = false;
};

struct SimulatedCloser {
  void operator()(sphc_simulated *simulated) const { sphc_simulated_close(&simulated); }
};
using Simulated = std::unique_ptr<sphc_simulated, SimulatedCloser>;

sphc_simulated_config configOf(const SimulateOptions &options) {
  sphc_simulated_config config = options.config;
  config.ideal_depth = options.ideal_depth ? 1 : 0;
  config.raw_depth = options.raw_depth ? 1 : 0;
  config.color_noise = options.no_noise ? 0 : 1;
  config.motion_blur = options.no_blur ? 0 : 1;
  config.exposure_drift = options.no_exposure_drift ? 0 : 1;
  orThrow("--with", [&](sphc_message *message) {
    return sphc_simulated_parse_with(options.with.c_str(), &config.with, message);
  });
  orThrow("--cameras", [&](sphc_message *message) {
    return sphc_simulated_parse_cameras(options.cameras.c_str(), &config.cameras, message);
  });
  const bool is_flat = (config.with & SPHC_SIMULATED_FLAT) != 0;
  config.lap_s = options.lap_s.value_or(is_flat ? SPHC_SIMULATED_LAP_OF_FLAT_S : config.lap_s);
  return config;
}

// All of the config is of options.
template <typename Make>
auto madeOfOptions(const Make &make) {
  try {
    return make();
  } catch (const ArgumentError &error) {
    throw UsageError(error.what());
  }
}

Simulated openHeadset(const sphc_simulated_config &config) {
  sphc_simulated *simulated = nullptr;
  orThrow("cannot make the simulated headset",
          [&](sphc_message *message) { return sphc_simulated_open(&config, &simulated, message); });
  return Simulated(simulated);
}

sphc_rig calibrationOf(const sphc_simulated *simulated) {
  sphc_rig rig;
  orThrow("cameras", [&](sphc_message *) { return sphc_simulated_rig(simulated, &rig); });
  return rig;
}

sphc_rigid poseAt(const sphc_simulated *simulated, int64_t time_ns) {
  sphc_rigid pose;
  orThrow("pose", [&](sphc_message *) { return sphc_simulated_pose_at(simulated, time_ns, &pose); });
  return pose;
}

// Times at a rate from a time on; none at a rate of 0.
class Ticks {
 public:
  Ticks(double rate_hz, int64_t from_ns) : period_ns_(rate_hz > 0 ? 1e9 / rate_hz : 0), from_ns_(from_ns) {}

  // Calls add(time_ns) for each up to this time that has not been.
  template <typename Add>
  void upTo(int64_t time_ns, const Add &add) {
    while (period_ns_ > 0) {
      const int64_t next_ns = from_ns_ + std::llround(period_ns_ * static_cast<double>(count_));
      if (next_ns > time_ns) return;
      add(next_ns);
      ++count_;
    }
  }

 private:
  double period_ns_;
  int64_t from_ns_;
  uint64_t count_ = 0;
};

// To disk: captures, each colour image with its exact pose, and what has a rate of its own, in order of time.
class Writer {
 public:
  Writer(const sphc_simulated *simulated, const SimulateOptions &options, RecordingOut *out)
      : simulated_(simulated),
        out_(*out),
        accelerations_(options.accelerometer_hz, options.config.start_time_ns),
        poses_(options.poses_hz, std::max<int64_t>(options.config.start_time_ns - kPosesBeyondNs, 0)) {}

  void add(const sphc_capture &capture) {
    accelerations_.upTo(capture.time_ns, [&](int64_t time_ns) {
      Acceleration felt;
      orThrow("accelerometer",
              [&](sphc_message *) { return sphc_simulated_felt_at(simulated_, time_ns, felt.mps2); });
      out_.addAcceleration(time_ns, felt);
    });
    addPosesUpTo(capture.time_ns);
    out_.add(capture);
    if (capture.stream == SPHC_STREAM_COLOR) addPose(capture.time_ns);
  }
  // After the last capture.
  void end() { addPosesUpTo(last_pose_ns_ + kPosesBeyondNs); }

 private:
  static constexpr int64_t kPosesBeyondNs = 100000000;  // before the first image and after the last

  void addPosesUpTo(int64_t end_ns) {
    poses_.upTo(end_ns - 1, [&](int64_t time_ns) { addPose(time_ns); });
  }
  // Once, where an image and a tick have the same time.
  void addPose(int64_t time_ns) {
    if (time_ns == last_pose_ns_) return;
    out_.addPose(time_ns, poseAt(simulated_, time_ns));
    last_pose_ns_ = time_ns;
  }

  const sphc_simulated *simulated_;
  RecordingOut &out_;
  Ticks accelerations_, poses_;
  int64_t last_pose_ns_ = INT64_MIN;
};

void record(sphc_simulated *simulated, const Interrupt &interrupt, Writer writer) {
  sphc_source source = {};
  source.struct_size = sizeof source;
  orThrow("source", [&](sphc_message *) { return sphc_simulated_source(simulated, &source); });
  const auto check = [&source](sphc_status status) {
    if (status < 0)
      throw std::runtime_error(std::string("the simulated headset failed: ") + source.message(source.self));
    return status;
  };
  check(source.start(source.self));
  ProgressBar bar("recording ");
  const uint32_t total = sphc_simulated_frame_count(simulated);
  sphc_capture capture = {};
  capture.struct_size = sizeof capture;
  while (check(source.acquire(source.self, 0, &capture)) != SPHC_END) {
    writer.add(capture);
    if (capture.stream == SPHC_STREAM_DEPTH) bar.show(capture.sequence + 1, total);
    source.release(source.self, &capture);
    interrupt.throwIfCame();
  }
  source.stop(source.self);
  writer.end();
}

// Which frames belong to which lap, so that the hint after the run can be copied.
void tellNext(const std::string &out, const sphc_simulated_config &config, const Console &console) {
  const double lap_frames = (config.lap_s - config.walk_start_s) * config.frame_rate_hz;
  const auto second_lap = static_cast<uint32_t>(std::lround(std::max(lap_frames, 0.0)));
  if (second_lap == 0 || second_lap >= config.frame_count) return;
  console.say("Lap one is frames 0 to " + std::to_string(second_lap - 1) +
              ": make a map of it with\n  spherecloud build --recording " + shellWord(out) + " --last " +
              std::to_string(second_lap - 1) + " --map room.sphc\nLap two, from frame " +
              std::to_string(second_lap) + " on, can then be localized in it.");
}

// Before the rendering, which may take minutes.
void noteWhatIsWithoutEffect(const SimulateOptions &options, const RecordingOut &out, const Console &console) {
  if (options.raw_depth && !isMcap(options.out))
    console.warn("note: a folder keeps no amplitudes of the depth; --out X.mcap does");
  if (options.accelerometer_hz > 0 && !out.keepsAccelerations())
    console.warn("note: a folder keeps no accelerations; --out X.mcap does");
  if (options.no_blur && options.exposure->count() > 0)
    console.warn("note: --exposure: with --no-blur nothing blurs, so it changes nothing");
}

int simulate(const SimulateOptions &options, const Console &console) {
  if (isRaw(options.out))
    throw UsageError("--out is a folder or a .mcap file; `spherecloud convert` makes a .raw file of either");
  FileUse files(false);
  files.writesRecording("--out", options.out);
  files.check();
  const auto start = std::chrono::steady_clock::now();
  const sphc_simulated_config config = madeOfOptions([&] { return configOf(options); });
  const Simulated simulated = madeOfOptions([&] { return openHeadset(config); });
  const Interrupt interrupt;  // from before there is a file
  const auto out = createRecording(options.out, calibrationOf(simulated.get()), patientRecorderConfig());
  noteWhatIsWithoutEffect(options, *out, console);
  record(simulated.get(), interrupt, {simulated.get(), options, out.get()});
  out->close();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  console.say("Recorded " + counted(config.frame_count, "frame") + " to " + options.out + " in " +
              fixed(seconds, 1) + " s: colour, depth, calibration and exact poses.");
  tellNext(options.out, config, console);
  console.give({{"recording", options.out},
                {"frames", config.frame_count},
                {"rate_hz", config.frame_rate_hz},
                {"lap_s", config.lap_s},
                {"seconds", seconds}});
  return kExitDone;
}

const char kSimulateHelp[] =
    "Records a walk of a headset that exists only in memory: a furnished room, a colour camera and a\n"
    "time-of-flight camera with their usual faults, and exact poses.  The walk has two laps around the room;\n"
    "lap two sees the same places from elsewhere, so map one and query the other.";
const char kSimulateExample[] =
    "Example:\n"
    "  spherecloud simulate --out walk            200 frames, two laps of 100\n"
    "  spherecloud simulate --out walk30 --frames 960 --rate 30 --seed 7\n"
    "  spherecloud simulate --out walk.mcap       the same in one file\n"
    "  spherecloud simulate --out hard --with feet,people,tiles,doubles\n"
    "  spherecloud simulate --out flat.mcap --with flat --frames 9000 --rate 30   five minutes\n"
    "  spherecloud simulate --out later --from 16 --frames 100 --arrangement 2   lap two, things moved\n"
    "What comes out: a folder in the TUM layout, with calibration.json, rgb/, depth/ and groundtruth.txt; or one\n"
    "MCAP file with all of that.\n"
    "The same options give the same bytes; another machine's C library may round sines otherwise.";

const char kWithHelp[] =
    "What makes the world hard, joined by commas:\n"
    "  hands, feet     the wearer's own, where the view goes down or they are raised\n"
    "  people          three walk around\n"
    "  carpet, parquet, tiles   a floor that repeats exactly\n"
    "  bare            walls and ceiling with nothing on them\n"
    "  doubles         each piece of furniture twice, one poster several times\n"
    "  mirror, window  depth goes on behind the glass: to the image, to nothing\n"
    "  day, night, dark   the sun alone, a floor lamp alone, hardly any light\n"
    "  flat            eight rooms in a ring, with doorways; a lap goes through all\n"
    "  menu            a line of text and a menu, drawn over the colour image\n"
    "  wallpaper       one paper on all walls that repeats exactly\n"
    "  binders         shelves along the walls, full of equal binders";

const char kCamerasHelp[] =
    "Whose cameras:\n"
    "  headset   colour 640 x 480 of 63 degrees, ToF 320 x 288\n"
    "  phone     colour 1440 x 1080 of 67 degrees, depth 256 x 192: smoothed, and as of the colour camera\n"
    "  wide      fisheyes: colour 640 x 480 of 111 degrees, ToF 320 x 288 of 100\n"
    "  glasses   colour 480 x 360 of 59 degrees, depth of 64 x 48 zones";

// Bounds are the driver's; of the rate they are those at which colour and depth, 4 ms apart, take turns.
void addWalkOptions(CLI::App *app, SimulateOptions *options) {
  sphc_simulated_config &config = options->config;
  app->add_option("-o,--out", options->out, "Folder to make, or file X.mcap; must not be a recording yet")
      ->required()
      ->type_name("PATH");
  app->add_option("--frames", config.frame_count, "How many frames")
      ->capture_default_str()
      ->transform(wholeFrom(1, 1000000))
      ->type_name("N");
  app->add_option("--rate", config.frame_rate_hz, "Frames a second, 0.1 to 120")
      ->capture_default_str()
      ->check(between(0.1, 120))
      ->type_name("HZ");
  app->add_option("--lap", options->lap_s, "Seconds for a lap around the room, or through all of them; 4 to 3600")
      ->default_str("16; of a flat 150")
      ->check(between(4, 3600))
      ->type_name("S");
  options->exposure =
      app->add_option(
             "--exposure", config.exposure_s,
             "Seconds that the colour camera exposes in the light by default: how long motion blurs; 0 to 0.05")
          ->capture_default_str()
          ->check(between(0, 0.05))
          ->type_name("S");
  addRowTimeOption(app, &config.color_row_time_ns, "0: all rows at once");
}

void addWorldOptions(CLI::App *app, SimulateOptions *options) {
  sphc_simulated_config &config = options->config;
  app->add_option("--seed", config.seed, "Another room for every number")
      ->capture_default_str()
      ->transform(wholeFrom(0))
      ->type_name("N");
  app->add_option("--walk-seed", config.walk_seed, "Another walk and noise for every number")
      ->capture_default_str()
      ->transform(wholeFrom(0))
      ->type_name("N");
  app->add_option("--with", options->with, kWithHelp)->type_name("NAMES");
  app->add_option("--cameras", options->cameras, kCamerasHelp)->capture_default_str()->type_name("NAME");
  app->add_option("--arrangement", config.arrangement_seed,
                  "Another arrangement of what people move (chairs, boxes, plants, books, small things, pictures)\n"
                  "for every number: half stands elsewhere, a quarter is gone; 0: as the room has it")
      ->capture_default_str()
      ->transform(wholeFrom(0))
      ->type_name("N");
}

void addRunOptions(CLI::App *app, SimulateOptions *options) {
  sphc_simulated_config &config = options->config;
  app->add_option("--from", config.walk_start_s, "Seconds on the walk at which frame 0 is; 16 is lap two")
      ->capture_default_str()
      ->check(between(0, 1e6))
      ->type_name("S");
  app->add_option("--threads", config.threads, "At most so many, up to 64; 0: all cores")
      ->capture_default_str()
      ->transform(wholeFrom(0, 64))
      ->type_name("N");
  app->add_option("--accelerometer", options->accelerometer_hz,
                  "Also what an accelerometer measures, so many times a second [none]; X.mcap keeps it")
      ->check(between(0.1, 2000))
      ->type_name("HZ");
  app->add_option("--poses", options->poses_hz,
                  "Also exact poses, so many times a second, from 0.1 s before the first image to 0.1 s after "
                  "the\nlast [none]")
      ->check(between(0.1, 2000))
      ->type_name("HZ");
}

void addImageFlags(CLI::App *app, SimulateOptions *options) {
  auto *ideal =
      app->add_flag("--ideal-depth", options->ideal_depth, "Depth without noise, bias, holes or mixed pixels");
  app->add_flag("--raw-depth", options->raw_depth,
                "Depth as a ToF module measures it, before it drops what it does not believe")
      ->excludes(ideal);
  app->add_flag("--no-noise", options->no_noise, "Colour without noise");
  app->add_flag("--no-blur", options->no_blur, "Colour without motion blur");
  app->add_flag("--no-exposure-drift", options->no_exposure_drift, "Colour of constant brightness");
}

}  // namespace

Command simulateCommand(CLI::App *root) {
  auto options = std::make_shared<SimulateOptions>();
  sphc_simulated_config_init(&options->config, sizeof options->config);
  options->config.frame_count = 200;  // the driver's own walk, two laps, with few enough frames to be done soon
  options->config.frame_rate_hz = 6.25;
  CLI::App *app = root->add_subcommand("simulate");
  app->description("Record a walk of the simulated headset.\n\n" + std::string(kSimulateHelp));
  app->footer(kSimulateExample);
  addWalkOptions(app, options.get());
  addWorldOptions(app, options.get());
  addRunOptions(app, options.get());
  addImageFlags(app, options.get());
  return {app, [options](const Console &console) { return simulate(*options, console); }};
}

}  // namespace sphc::host
