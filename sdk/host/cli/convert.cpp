// spherecloud convert: a recording into another layout.
#include <filesystem>
#include <memory>

#include "drivers/replay/replay.h"
#include "host/base/checked_call.h"
#include "host/base/usage_error.h"
#include "host/cli/commands.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/new_recording.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "host/cli/common/recording_out.h"
#include "host/recording/recording_writer.h"

namespace sphc::host {
namespace {

enum class Layout { kByName, kMcap, kTum, k7Scenes };

struct Options {
  std::string in, out, calibration;
  Layout layout = Layout::kByName;
  sphc_recorder_config recorder = {};
};

struct Result {
  uint32_t color = 0, depth = 0, poses = 0, unreadable = 0, unpaired = 0;
};

Replay open(const Options &options) {
  sphc_replay *replay = nullptr;
  const char *calibration = options.calibration.empty() ? nullptr : options.calibration.c_str();
  orThrow("cannot open the recording", [&](sphc_message *message) {
    return sphc_replay_open(options.in.c_str(), calibration, nullptr, &replay, message);
  });
  return Replay(replay);
}

sphc_replay_info infoOf(const sphc_replay *replay) {
  sphc_replay_info info = {};
  info.struct_size = sizeof info;
  orThrow("recording", [&](sphc_message *) { return sphc_replay_get_info(replay, &info); });
  return info;
}

// Poses up to a time; each goes once.
class Poses {
 public:
  Poses(const sphc_replay *replay, uint32_t count) : replay_(replay), count_(count) {}

  void writeUpTo(int64_t time_ns, RecordingOut *out) {
    for (; next_ < count_; ++next_) {
      int64_t pose_ns = 0;
      sphc_rigid pose;
      orThrow("pose", [&](sphc_message *) { return sphc_replay_recorded_pose(replay_, next_, &pose_ns, &pose); });
      if (pose_ns > time_ns) return;
      out->addPose(pose_ns, pose);
    }
  }

 private:
  const sphc_replay *replay_;
  uint32_t count_, next_ = 0;
};

// Both streams in order of time, poses among them.
Result copyStreams(sphc_replay *replay, RecordingOut *out, const Console &console) {
  const sphc_replay_info info = infoOf(replay);
  Poses poses(replay, info.pose_count);
  sphc_source source = {};
  orThrow("source", [&](sphc_message *) { return sphc_replay_source(replay, &source); });
  if (source.start(source.self) < 0) throw std::runtime_error(source.message(source.self));
  ProgressBar bar("converting ");
  Result result;
  result.poses = info.pose_count;
  for (uint32_t done = 1;; ++done) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    const sphc_status status = source.acquire(source.self, 0, &capture);
    if (status == SPHC_END) break;
    bar.show(done, info.color_count + info.depth_count);
    if (status != SPHC_OK) {
      console.warn(std::string("left out: ") + source.message(source.self));
      ++result.unreadable;
      continue;
    }
    poses.writeUpTo(capture.time_ns, out);
    out->add(capture);
    ++(capture.stream == SPHC_STREAM_COLOR ? result.color : result.depth);
    source.release(source.self, &capture);
  }
  poses.writeUpTo(INT64_MAX, out);
  return result;
}

// Frames of colour and depth under one number.
Result copyFrames(sphc_replay *replay, const std::string &folder, const Console &console) {
  const uint32_t count = sphc_replay_frame_count(replay);
  ProgressBar bar("converting ");
  Result result;
  result.unpaired = infoOf(replay).color_count - count;
  uint32_t last = 0;
  for (uint32_t i = 0; i < count; ++i) {
    sphc_frame frame;
    sphc_rigid pose;
    sphc_message message = {};
    bar.show(i, count);
    if (sphc_replay_read_frame(replay, i, &frame, &message) != SPHC_OK) {
      console.warn(std::string("left out: ") + message.text);
      ++result.unreadable;
      continue;
    }
    if (i > 0 && frame.sequence <= last) frame.sequence = last + 1;  // a camera that came back counts anew
    last = frame.sequence;
    const bool has_pose = sphc_replay_pose(replay, i, &pose) == SPHC_OK;
    orThrow("cannot write a frame", [&](sphc_message *why) {
      return sphc_recording_write_7scenes(folder.c_str(), &frame, has_pose ? &pose : nullptr, why);
    });
    ++result.color;
    ++result.depth;
    result.poses += has_pose ? 1 : 0;
  }
  return result;
}

Result convertTo7Scenes(sphc_replay *replay, const std::string &out, const Console &console) {
  NewRecording recording(out, NewRecording::IfCut::kRemove);
  const std::string &folder = recording.part(), file = folder + "/calibration.json";
  std::filesystem::create_directory(folder);
  const sphc_calibration calibration = calibrationOf(replay);
  orThrow("cannot write the calibration",
          [&](sphc_message *message) { return sphc_calibration_write(file.c_str(), &calibration, message); });
  const Result result = copyFrames(replay, folder, console);
  recording.finish();
  return result;
}

// What the new layout does not keep.
void tellLosses(const Options &options, const sphc_replay_info &info, const Result &result,
                const Console &console) {
  if (info.is_cut) console.warn("note: " + options.in + " was cut off; all of its whole chunks are kept");
  if (info.bad_chunk_count)
    console.warn("note: " + std::to_string(info.bad_chunk_count) + " parts with changed bytes are left out");
  if (options.layout == Layout::k7Scenes)
    console.warn("note: the 7-Scenes layout has no times: frame N is at N / 30 s from now on");
  if (options.layout == Layout::k7Scenes && info.depth_count > result.depth)
    console.warn("note: " + std::to_string(info.depth_count - result.depth) +
                 " depth images that are no frame's are left out");
  if (options.layout == Layout::k7Scenes && info.pose_count > result.poses)
    console.warn("note: " + std::to_string(info.pose_count - result.poses) + " poses between frames are left out");
  if (options.layout == Layout::kTum && info.layout == SPHC_REPLAY_MCAP)
    console.warn("note: the TUM layout has no sequence numbers, clocks and exposures");
  if (result.unpaired)
    console.warn("note: " + std::to_string(result.unpaired) + " colour images without depth are left out");
}

int convert(Options options, const Console &console) {
  if (options.layout == Layout::kByName) options.layout = isMcap(options.out) ? Layout::kMcap : Layout::kTum;
  if ((options.layout == Layout::kMcap) != isMcap(options.out))
    throw UsageError("the name of a file ends with .mcap, that of a folder does not: " + options.out);
  FileUse files(false);
  files.reads("the recording", options.in);
  files.reads("--calibration", options.calibration);
  files.writesRecording("the new recording", options.out);
  files.check();
  const Replay replay = open(options);
  Result result;
  if (options.layout == Layout::k7Scenes) {
    result = convertTo7Scenes(replay.get(), options.out, console);
  } else {
    const auto out = createRecording(options.out, calibrationOf(replay.get()), options.recorder);
    result = copyStreams(replay.get(), out.get(), console);
    out->close();
  }
  tellLosses(options, infoOf(replay.get()), result, console);
  console.say("Wrote " + options.out + ": " + std::to_string(result.color) + " colour images, " +
              std::to_string(result.depth) + " depth images, " + std::to_string(result.poses) + " poses.");
  console.give({{"recording", options.out},
                {"color", result.color},
                {"depth", result.depth},
                {"poses", result.poses},
                {"unreadable", result.unreadable},
                {"unpaired", result.unpaired}});
  return result.unreadable ? kExitFailure : kExitDone;
}

const char kHelp[] =
    "Reads a recording in any layout (TUM, 7-Scenes, MCAP) and writes it in another, with its calibration and\n"
    "poses.  Images stay the same to the bit, unless --jpeg is given.  A recording that was cut off becomes whole.";
const char kExample[] =
    "Example:\n"
    "  spherecloud convert walk walk.mcap                 a folder into one file\n"
    "  spherecloud convert walk.mcap walk                 a file into a folder of the TUM layout\n"
    "  spherecloud convert walk.mcap seq-01 --to 7scenes  times become N / 30 s\n"
    "  spherecloud convert seq-01 a.mcap --calibration kinect.json --jpeg 95";

}  // namespace

Command convertCommand(CLI::App *root) {
  auto options = std::make_shared<Options>();
  options->recorder = patientRecorderConfig();
  CLI::App *app = root->add_subcommand("convert");
  app->description("Turn a recording into another layout.\n\n" + std::string(kHelp));
  app->footer(kExample);
  app->add_option("in", options->in, "Recording: a folder or a .mcap file")->required()->type_name("IN");
  app->add_option("out", options->out, "New folder, or new file X.mcap")->required()->type_name("OUT");
  app->add_option("-c,--calibration", options->calibration, "Calibration file [the recording's own]")
      ->type_name("FILE");
  const std::map<std::string, Layout> layouts = {
      {"mcap", Layout::kMcap}, {"tum", Layout::kTum}, {"7scenes", Layout::k7Scenes}};
  app->add_option("--to", options->layout, "Layout of OUT [mcap for a file, tum for a folder]")
      ->transform(CLI::CheckedTransformer(layouts).description(""))
      ->type_name("tum|7scenes|mcap");
  const std::map<std::string, sphc_depth_codec> codecs = {
      {"raw", SPHC_DEPTH_RAW}, {"rvl", SPHC_DEPTH_RVL}, {"zstd", SPHC_DEPTH_ZSTD}};
  app->add_option("--depth-codec", options->recorder.depth_codec, "Of depth in a file, all without loss [zstd]")
      ->transform(CLI::CheckedTransformer(codecs).description(""))
      ->type_name("zstd|rvl|raw");
  app->add_option("--jpeg", options->recorder.jpeg_quality, "Colour in a file as JPEG of this quality [raw]")
      ->check(CLI::Range(1u, 100u))
      ->type_name("Q");
  return {app, [options](const Console &console) { return convert(*options, console); }};
}

}  // namespace sphc::host
