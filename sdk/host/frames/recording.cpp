#include "host/frames/recording.h"

#include <cmath>
#include <new>
#include <stdexcept>

#include "host/base/counted.h"
#include "host/base/median.h"
#include "host/base/usage_error.h"

namespace sphc::host {
namespace {

std::string ordinal(uint32_t n) {
  const uint32_t tens = n / 10 % 10, ones = n % 10;
  const char *ending = tens == 1 || ones > 3 || ones == 0 ? "th" : ones == 1 ? "st" : ones == 2 ? "nd" : "rd";
  return std::to_string(n) + ending;
}

recording::ReaderOptions readerOptions(const RecordingOptions &options) {
  recording::ReaderOptions chosen;
  chosen.calibration = options.calibration;
  chosen.poses = options.poses;
  chosen.selection = {options.first, options.last, options.step};
  chosen.pose_gap_ns = int64_t{options.pose_gap_ms} * 1000000;
  return chosen;
}

}  // namespace

void checkSelection(const RecordingOptions &options) {
  if (options.last < options.first) throw UsageError("--last lies before --first; swap them");
  if (options.step == 0) throw UsageError("--step is 0; give 1 or more");
}

std::unique_ptr<RecordingReader> openRecording(const RecordingOptions &options) {
  checkSelection(options);
  std::unique_ptr<RecordingReader> reader;
  try {
    reader = std::make_unique<RecordingReader>(options.folder, readerOptions(options));
  } catch (const std::bad_alloc &) {
    throw;
  } catch (const std::exception &error) {
    throw std::runtime_error(std::string("cannot open the recording: ") + error.what());
  }
  if (reader->frameCount() > 0) return reader;
  if (const recording::Recording &told = reader->recording(); !told.depth.empty())
    throw std::runtime_error("none of " + counted(told.depth.size(), "depth image") + " in " + options.folder +
                             " is of the time of one of " + counted(told.color.size(), "colour image") +
                             " (at most 20 ms apart); are the times of both in seconds of one clock?");
  throw std::runtime_error("no frame of colour and depth in " + options.folder + " for " +
                           describeSelection(options) +
                           ": check --first, --last, --step, and that depth images are there");
}

std::optional<uint64_t> poseGapOf(const RecordingReader &reader, const recording::PoseTrack &poses,
                                  uint32_t index) {
  const int64_t time_ns = reader.colorOf(index).time_ns;
  return poses.at(time_ns, reader.poseGapNs()) ? std::nullopt : poses.gapAt(time_ns);
}

std::string tooFarApart(const RecordingReader &reader, const recording::PoseTrack &poses) {
  std::vector<double> gaps_ms;
  for (uint32_t i = 0; i < reader.frameCount(); ++i)
    if (const auto gap_ns = poseGapOf(reader, poses, i)) gaps_ms.push_back(1e-6 * static_cast<double>(*gap_ns));
  if (gaps_ms.empty()) return "";
  const double gap_ms = median(gaps_ms);
  return " is near enough in time to a frame that was chosen: they are " + std::to_string(std::llround(gap_ms)) +
         " ms apart there, and are interpolated over at most " + std::to_string(reader.poseGapNs() / 1000000) +
         (gap_ms <= kMostPoseGapMs ? " ms; --pose-gap-ms takes more" : " ms; record poses more often");
}

std::string ofOtherTimes(const RecordingReader &reader, const recording::PoseTrack &poses) {
  const std::string apart = tooFarApart(reader, poses);
  if (!apart.empty()) return apart;
  return " is of the time of a frame that was chosen; are the times of poses and images in seconds of one clock?";
}

void refuseUnreadable() {
  throw std::runtime_error("not one frame could be read; check the recording and its calibration");
}

std::string describeSelection(const RecordingOptions &options) {
  const bool all = options.first == 0 && options.last == UINT32_MAX;
  if (options.first == options.last) return "frame " + std::to_string(options.first);
  std::string text = all ? "all frames" : "frames " + std::to_string(options.first) + " to ";
  if (!all) text += options.last == UINT32_MAX ? "the end" : std::to_string(options.last);
  if (options.step > 1) text += ", every " + ordinal(options.step);
  return text;
}

}  // namespace sphc::host
