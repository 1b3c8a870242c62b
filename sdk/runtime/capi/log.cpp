#include "runtime/capi/log.h"

#include "runtime/base/message.h"
#include "runtime/localizer/tuning.h"

namespace sphc {
namespace {

void logText(const sphc_localizer &localizer, sphc_log_level level, const sphc_message &text) {
  size_t length = 0;
  while (text.text[length]) ++length;
  localizer.log(localizer.log_user, level, text.text, length);
}

enum : uint32_t { kLoggedNoMap = 1, kLoggedClocks = 2, kLoggedTimes = 4, kLoggedStuck = 8 };
constexpr uint32_t kStuck = 3;  // a recording that begins anew goes back once

void warnOnce(uint32_t what, const char *words, sphc_localizer *localizer) {
  if (localizer->logged & what) return;
  localizer->logged |= what;
  sphc_message text;
  MessageWriter(&text) << words;
  logText(*localizer, SPHC_LOG_WARNING, text);
}

// Of two clocks, or so far apart that poses are less sure for it.
void warnOfTimes(const sphc_localizer_frame &frame, sphc_localizer *localizer) {
  const BetweenImages &between = localizer->localizer.betweenImages();
  // Odometry says it from the second frame on.
  const bool will_be_told = localizer->localizer.config().tracks && frame.prior &&
                            frame.prior->flags & SPHC_PRIOR_ODOMETRY &&
                            secondsOf(tuning::kReachNs) > between.apart_s;
  if (between.apart_s >= tuning::kMostApartS)
    warnOnce(
        kLoggedClocks,
        "the images of a frame are 1 s apart or more (color_time_ns, depth_time_ns, time_ns of views), so no pose "
        "is sure; give all times on one clock (sphc_clock_mapper)",
        localizer);
  else if (between.apart_s > tuning::kMostTogetherS && !will_be_told)
    warnOnce(
        kLoggedTimes,
        "the images of a frame are more than 50 ms apart (color_time_ns, depth_time_ns, time_ns of views), and "
        "nothing says how the camera moved meanwhile, so no pose is sure; give odometry (SPHC_PRIOR_ODOMETRY, "
        "SPHC_MODE_TRACKING), or images nearer in time",
        localizer);
}

// In tracking, which begins anew with each of them.
void warnOfStuckTimes(int64_t time_ns, sphc_localizer *localizer) {
  localizer->stuck = time_ns > localizer->last_time_ns ? 0 : localizer->stuck + 1;
  localizer->last_time_ns = time_ns;
  if (localizer->stuck >= kStuck && localizer->localizer.config().tracks)
    warnOnce(
        kLoggedStuck,
        "color_time_ns does not grow from frame to frame, so nothing is tracked; give times of mid-exposure, in "
        "nanoseconds of one clock",
        localizer);
}

// Each thing once, however many frames have it.
void logWarnings(const sphc_localizer_frame &frame, const sphc_localizer_result &result,
                 sphc_localizer *localizer) {
  if (!localizer->log || localizer->log_level < SPHC_LOG_WARNING) return;
  warnOfTimes(frame, localizer);
  warnOfStuckTimes(frame.color_time_ns, localizer);
  if (localizer->localizer.maps().count() == 0)
    warnOnce(kLoggedNoMap, "the localizer has no map; call sphc_localizer_set_map", localizer);
  for (uint32_t left = result.faults & ~localizer->logged_faults; left != 0; left &= left - 1) {
    sphc_message text;
    MessageWriter(&text) << "frame " << result.sequence << ": " << sphc_localizer_fault_name(left & -left)
                         << " for the first time; docs/consistency.md says what causes it";
    logText(*localizer, SPHC_LOG_WARNING, text);
  }
  localizer->logged_faults |= result.faults;
}

void logResult(const sphc_localizer &localizer, const sphc_localizer_result &result) {
  if (!localizer.log || localizer.log_level < SPHC_LOG_DEBUG) return;
  sphc_message text;
  MessageWriter(&text) << "frame " << result.sequence << ": " << sphc_localizer_outcome_name(result.outcome)
                       << ", keypoints " << result.keypoints << ", lifted " << result.lifted << ", matches "
                       << result.matches << ", inliers " << result.inliers << ", state " << result.state << ", map "
                       << result.map_id << ", hints " << result.hints;
  logText(localizer, SPHC_LOG_DEBUG, text);
}

}  // namespace

void logFrame(const sphc_localizer_frame &frame, const sphc_localizer_result &result, sphc_localizer *localizer) {
  logWarnings(frame, result, localizer);
  logResult(*localizer, result);
}

}  // namespace sphc
