#include "host/frames/recording.h"

#include <new>
#include <stdexcept>

#include "host/base/counted.h"
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
