// spherecloud convert: a recording into another layout.
#include <algorithm>
#include <memory>
#include <optional>

#include "drivers/replay/reader.h"
#include "drivers/replay/replay.h"
#include "host/base/checked_call.h"
#include "host/base/counted.h"
#include "host/base/usage_error.h"
#include "host/cli/commands.h"
#include "host/cli/common/choices.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/few_warnings.h"
#include "host/cli/common/file_use.h"
#include "host/cli/common/new_recording.h"
#include "host/cli/common/number_checks.h"
#include "host/cli/common/progress.h"
#include "host/cli/common/recording_options.h"
#include "host/cli/common/recording_out.h"
#include "host/frames/recording.h"
#include "host/live/interrupt.h"
#include "host/recording/writer_7scenes.h"
#include "host/recording/writer_raw.h"

namespace sphc::host {
namespace {

enum class Target { kByName, kMcap, kTum, k7Scenes, kRaw };

constexpr int64_t kAroundNs = 1000000000;  // of a part of a recording, poses and accelerations

struct ConvertOptions {
  RecordingOptions in;
  std::string out;
  Target target = Target::kByName;
  sphc_recorder_config recorder = {};
  std::optional<sphc_depth_codec> depth_codec;

  // Colour and depth under one number, as the layout has them.
  bool isByFrame() const { return target == Target::k7Scenes || target == Target::kRaw; }
};

struct Result {
  uint32_t color = 0, depth = 0, poses = 0, accelerations = 0, unpaired = 0, amplitudes = 0;
  uint32_t unreadable = 0, unreadable_poses = 0;  // images or frames, and the poses of these
};

// What is told of a recording once it is converted.
struct Facts {
  bool is_mcap;
  uint32_t depth_count, pose_count, acceleration_count;
  uint32_t depth_in_frames = 0;  // where it goes frame by frame
};

struct ReplayCloser {
  void operator()(sphc_replay *replay) const { sphc_replay_close(&replay); }
};
using Replay = std::unique_ptr<sphc_replay, ReplayCloser>;

Replay openStreams(const ConvertOptions &options) {
  sphc_replay *replay = nullptr;
  const RecordingOptions &in = options.in;
  const char *calibration = in.calibration.empty() ? nullptr : in.calibration.c_str();
  sphc_replay_config config;
  sphc_replay_config_init(&config, sizeof config);
  config.first = in.first;
  config.last = in.last;
  config.step = in.step;
  orThrow("cannot open the recording", [&](sphc_message *message) {
    return sphc_replay_open(in.folder.c_str(), calibration, &config, &replay, message);
  });
  return Replay(replay);
}

sphc_replay_info infoOf(const sphc_replay *replay) {
  sphc_replay_info info = {};
  info.struct_size = sizeof info;
  orThrow("recording", [&](sphc_message *) { return sphc_replay_get_info(replay, &info); });
  return info;
}

sphc_rig calibrationOf(const sphc_replay *replay) {
  sphc_rig rig;
  orThrow("calibration", [&](sphc_message *) { return sphc_replay_rig(replay, &rig); });
  return rig;
}

// What a recording holds beside images, in order of time: each goes once, and what is before `from_ns` is left out.
template <typename Value>
class Beside {
 public:
  using Read = sphc_status (*)(const sphc_replay *, uint32_t index, int64_t *time_ns, Value *);
  using Write = void (RecordingOut::*)(int64_t, const Value &);
  Beside(const sphc_replay *replay, uint32_t count, Read read, Write write)
      : replay_(replay), count_(count), read_(read), write_(write) {}

  void writeUpTo(int64_t time_ns, int64_t from_ns, RecordingOut *out) {
    for (; next_ < count_; ++next_) {
      int64_t its_ns = 0;
      Value value;
      orThrow("pose or acceleration", [&](sphc_message *) { return read_(replay_, next_, &its_ns, &value); });
      if (its_ns > time_ns) return;
      if (its_ns < from_ns) continue;
      (out->*write_)(its_ns, value);
      ++written_;
    }
  }
  uint32_t written() const { return written_; }

 private:
  const sphc_replay *replay_;
  uint32_t count_, next_ = 0, written_ = 0;
  Read read_;
  Write write_;
};

sphc_status readAcceleration(const sphc_replay *replay, uint32_t index, int64_t *time_ns, Acceleration *felt) {
  return sphc_replay_acceleration(replay, index, time_ns, felt->mps2);
}

// Told before the new recording is finished, so that nothing has its name.
void checkAny(const Result &result) {
  if (result.unreadable && !result.color && !result.depth)
    throw std::runtime_error("not one of " + counted(result.unreadable, "image") +
                             " can be read, so nothing was written; the lines above say why");
}

// Both streams in order of time, poses and accelerations among them; of a part of a recording those around it.
Result copyStreams(sphc_replay *replay, const ConvertOptions &options, const Interrupt &interrupt,
                   RecordingOut *out, const Console &console) {
  const sphc_replay_info info = infoOf(replay);
  Beside<sphc_rigid> poses(replay, info.pose_count, sphc_replay_recorded_pose, &RecordingOut::addPose);
  const uint32_t acceleration_count = out->keepsAccelerations() ? info.acceleration_count : 0;
  Beside<Acceleration> felt(replay, acceleration_count, readAcceleration, &RecordingOut::addAcceleration);
  sphc_source source = {};
  orThrow("source", [&](sphc_message *) { return sphc_replay_source(replay, &source); });
  if (source.start(source.self) < 0) throw std::runtime_error(source.message(source.self));
  ProgressBar bar("converting ");
  FewWarnings warnings(console, "left out: ", "image", "");
  Result result;
  int64_t from_ns = INT64_MIN, to_ns = INT64_MAX;
  for (uint32_t done = 1;; ++done) {
    sphc_capture capture = {};
    capture.struct_size = sizeof capture;
    const sphc_status status = source.acquire(source.self, 0, &capture);
    if (status == SPHC_END) break;
    interrupt.throwIfCame();
    bar.show(done, info.color_count + info.depth_count);
    if (status != SPHC_OK) {
      warnings.add(source.message(source.self));
      ++result.unreadable;
      continue;
    }
    if (options.in.step > 1)  // images between those that are chosen are not lost
      capture.sequence = capture.stream == SPHC_STREAM_COLOR ? capture.sequence / options.in.step : result.depth;
    if (options.in.isPart() && from_ns == INT64_MIN) from_ns = capture.time_ns - kAroundNs;
    if (options.in.isPart()) to_ns = std::min(capture.time_ns, INT64_MAX - kAroundNs) + kAroundNs;
    poses.writeUpTo(capture.time_ns, from_ns, out);
    felt.writeUpTo(capture.time_ns, from_ns, out);
    out->add(capture);
    ++(capture.stream == SPHC_STREAM_COLOR ? result.color : result.depth);
    result.amplitudes += capture.amplitude.data != nullptr;
    source.release(source.self, &capture);
  }
  checkAny(result);
  poses.writeUpTo(to_ns, from_ns, out);
  felt.writeUpTo(to_ns, from_ns, out);
  result.poses = poses.written();
  result.accelerations = felt.written();
  return result;
}

// Frames of colour and depth under one number: `add` takes a frame and its pose, which may be null.
template <typename Add>
Result copyFrames(RecordingReader *reader, const Interrupt &interrupt, const Console &console, Add &&add) {
  ProgressBar bar("converting ");
  FewWarnings warnings(console, "left out: ", "frame", "");
  Result result;
  result.unpaired = static_cast<uint32_t>(reader->recording().color.size()) - reader->frameCount();
  for (uint32_t i = 0; i < reader->frameCount(); ++i) {
    bar.show(i, reader->frameCount());
    interrupt.throwIfCame();
    std::string why;
    const std::optional<sphc_rigid> pose = reader->worldFromCamera(i);
    const std::optional<sphc_localizer_frame> frame = reader->tryRead(i, &why);
    if (!frame) {
      warnings.add(why);
      ++result.unreadable;
      result.unreadable_poses += pose ? 1 : 0;
      continue;
    }
    add(*frame, pose ? &*pose : nullptr);
    ++result.color;
    ++result.depth;
    result.amplitudes += frame->amplitude.data != nullptr;
    result.poses += pose ? 1 : 0;
  }
  checkAny(result);
  return result;
}

Result writeRaw(RecordingReader *reader, const std::string &file, const Console &console) {
  const Interrupt interrupt;  // from before there is a file
  recording::RawWriter writer(file, reader->calibration(), SPHC_FORMAT_BGR8);
  const Result result =
      copyFrames(reader, interrupt, console,
                 [&](const sphc_localizer_frame &frame, const sphc_rigid *pose) { writer.add(frame, pose); });
  writer.finish();
  return result;
}

Result write7Scenes(RecordingReader *reader, const std::string &folder, const Console &console) {
  const Interrupt interrupt;  // from before there is a folder
  NewRecording recording(folder, NewRecording::IfCut::kRemove);
  recording.makeFolder();
  recording::SevenScenesWriter writer(recording.part(), reader->calibration());
  uint32_t next = 0;
  const Result result =
      copyFrames(reader, interrupt, console, [&](sphc_localizer_frame frame, const sphc_rigid *pose) {
        frame.sequence = std::max(frame.sequence, next);  // a camera that came back counts anew
        next = frame.sequence + 1;
        writer.add(frame, pose);
      });
  writer.finish();
  recording.finish();
  return result;
}

// Frames of colour faster than depth share depth images, one after the other.
uint32_t depthInFrames(const RecordingReader &reader) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < reader.frameCount(); ++i)
    count += i == 0 || &reader.depthOf(i) != &reader.depthOf(i - 1);
  return count;
}

Result convertFrames(const ConvertOptions &options, const Console &console, Facts *facts) {
  const auto reader = openRecording(options.in);
  noteDamage(*reader, console);
  const recording::Recording &recording = reader->recording();
  *facts = {recording.layout == recording::Layout::kMcap, static_cast<uint32_t>(recording.depth.size()),
            static_cast<uint32_t>(recording.poses.poses().size()),
            static_cast<uint32_t>(recording.accelerations.size()), depthInFrames(*reader)};
  return options.target == Target::kRaw ? writeRaw(reader.get(), options.out, console)
                                        : write7Scenes(reader.get(), options.out, console);
}

Result convertStreams(const ConvertOptions &options, const Console &console, Facts *facts) {
  const Replay replay = openStreams(options);
  const sphc_replay_info info = infoOf(replay.get());
  noteDamage(*replay::readerOf(replay.get()), console);
  *facts = {info.layout == SPHC_REPLAY_MCAP, info.depth_count, info.pose_count, info.acceleration_count};
  sphc_recorder_config recorder = options.recorder;
  // One that lost nothing has numbers of files, or of frames that somebody chose.
  recorder.gaps_are_losses = info.lost_count > 0 || info.bad_chunk_count > 0;
  const Interrupt interrupt;  // from before there is a recording
  const auto out = createRecording(options.out, calibrationOf(replay.get()), recorder);
  const Result result = copyStreams(replay.get(), options, interrupt, out.get(), console);
  out->close();
  return result;
}

// What the new layout does not keep.
void tellLosses(const ConvertOptions &options, const Facts &facts, const Result &result, const Console &console) {
  if (options.target == Target::k7Scenes)
    console.warn("note: the 7-Scenes layout has no times: frame N is at N / 30 s from now on");
  if (result.amplitudes && options.target != Target::kMcap)
    console.warn("note: left out: amplitudes of " + counted(result.amplitudes, "depth image") +
                 "; an MCAP file keeps them");
  if (facts.acceleration_count && options.target != Target::kMcap)
    console.warn("note: left out: " +
                 (options.in.isPart() ? "accelerations" : counted(facts.acceleration_count, "acceleration")) +
                 "; an MCAP file keeps them");
  const uint32_t posed = result.poses + result.unreadable_poses;
  if (options.isByFrame() && facts.depth_count > facts.depth_in_frames)
    console.warn("note: left out: " + counted(facts.depth_count - facts.depth_in_frames, "depth image") +
                 " without a colour image near in time");
  if (options.isByFrame() && !options.in.isPart() && facts.pose_count > posed)
    console.warn("note: left out: " + counted(facts.pose_count - posed, "pose") + " between frames");
  if (options.target == Target::kTum && facts.is_mcap)
    console.warn("note: the TUM layout has no sequence numbers, clocks and exposures");
  if (result.unpaired)
    console.warn("note: left out: " + counted(result.unpaired, "colour image") + " without depth");
}

Target targetByName(const std::string &out) {
  if (isMcap(out)) return Target::kMcap;
  return isRaw(out) ? Target::kRaw : Target::kTum;
}

int convert(ConvertOptions options, const Console &console) {
  checkSelection(options.in);
  if (options.out.empty()) throw UsageError("the new recording has no name; give one");
  const Target by_name = targetByName(options.out);
  if (options.target == Target::kByName) options.target = by_name;
  const bool is_folder = options.target == Target::kTum || options.target == Target::k7Scenes;
  if (is_folder ? by_name != Target::kTum : by_name != options.target)
    throw UsageError("a file's name must end with .mcap or .raw, as --to says, and a folder's name with neither: " +
                     options.out);
  if (options.recorder.jpeg_quality && options.target != Target::kMcap)
    throw UsageError("--jpeg is of an MCAP file; give the new recording a name that ends in .mcap");
  if (options.depth_codec && options.target != Target::kMcap)
    throw UsageError("--depth-codec is of an MCAP file; give the new recording a name that ends in .mcap");
  if (!options.isByFrame() && options.in.pose_gap_ms != RecordingOptions().pose_gap_ms)
    throw UsageError("--pose-gap-ms is of raw and 7scenes, whose frames have a pose each; leave it out");
  options.recorder.depth_codec = options.depth_codec.value_or(options.recorder.depth_codec);
  FileUse files(false);
  files.reads("the recording", options.in.folder);
  files.reads("--calibration", options.in.calibration);
  files.writesRecording("the new recording", options.out);
  files.check();
  Facts facts = {};
  const Result result =
      options.isByFrame() ? convertFrames(options, console, &facts) : convertStreams(options, console, &facts);
  tellLosses(options, facts, result, console);
  console.say("Wrote " + options.out + ": " + counted(result.color, "colour image") + ", " +
              counted(result.depth, "depth image") + ", " + counted(result.poses, "pose") +
              (result.accelerations ? ", " + counted(result.accelerations, "acceleration") + "." : "."));
  console.give({{"recording", options.out},
                {"color", result.color},
                {"depth", result.depth},
                {"poses", result.poses},
                {"accelerations", result.accelerations},
                {"unreadable", result.unreadable},
                {"unpaired", result.unpaired}});
  return result.unreadable ? kExitFailure : kExitDone;
}

const char kConvertHelp[] =
    "Reads a recording in any layout (TUM, 7-Scenes, MCAP, other programs') and writes it in another, with its\n"
    "calibration and poses.  Images stay the same to the bit, unless --jpeg is given.  A recording that was cut "
    "off becomes "
    "whole.\n"
    "Raw is for devices: frames as they are in memory, which drivers/raw reads without a library.";
const char kConvertExample[] =
    "Example:\n"
    "  spherecloud convert walk walk.mcap                 a folder into one file\n"
    "  spherecloud convert walk.mcap walk                 a file into a folder of the TUM layout\n"
    "  spherecloud convert walk.mcap seq-01 --to 7scenes  times become N / 30 s\n"
    "  spherecloud convert walk.mcap walk.raw --to raw    to replay on a device\n"
    "  spherecloud convert walk.mcap part.mcap --first 300 --last 599   a part of it\n"
    "  spherecloud convert seq-01 a.mcap --calibration kinect.json --jpeg 95";

}  // namespace

Command convertCommand(CLI::App *root) {
  auto options = std::make_shared<ConvertOptions>();
  options->recorder = patientRecorderConfig();
  CLI::App *app = root->add_subcommand("convert");
  app->description("Turn a recording into another layout.\n\n" + std::string(kConvertHelp));
  app->footer(kConvertExample);
  app->add_option("in", options->in.folder, "Recording: a folder, a .mcap or .raw file, or another program's")
      ->required()
      ->type_name("IN");
  app->add_option("out", options->out, "New folder, or new file X.mcap or X.raw")->required()->type_name("OUT");
  addFrameOptions(app, &options->in);
  app->add_option("--to", options->target, "Layout of OUT [by its name: mcap or raw for a file, tum for a folder]")
      ->transform(oneOf<Target>(
          {{"tum", Target::kTum}, {"7scenes", Target::k7Scenes}, {"mcap", Target::kMcap}, {"raw", Target::kRaw}}))
      ->type_name("tum|7scenes|mcap|raw");
  app->add_option("--depth-codec", options->depth_codec, "Codec of depth in a file; all are lossless [zstd]")
      ->transform(
          oneOf<sphc_depth_codec>({{"zstd", SPHC_DEPTH_ZSTD}, {"rvl", SPHC_DEPTH_RVL}, {"raw", SPHC_DEPTH_RAW}}))
      ->type_name("zstd|rvl|raw");
  app->add_option("--jpeg", options->recorder.jpeg_quality, "Colour in a file as JPEG of this quality [raw]")
      ->transform(wholeFrom(1, 100))
      ->type_name("Q");
  return {app, [options](const Console &console) { return convert(*options, console); }};
}

}  // namespace sphc::host
