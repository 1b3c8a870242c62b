#include "host/cli/record_guide.h"

#include "host/live/pair_frame.h"

namespace sphc::host {

RecordGuide::RecordGuide(const sphc_rig &calibration, const WalkGuide::Options &options, bool may_wait,
                         const Console &console)
    : may_wait_(may_wait),
      guide_(calibration, options),
      thread_([this, console](const sphc_localizer_frame &frame) { look(frame, console); }) {}

void RecordGuide::look(const sphc_localizer_frame &frame, const Console &console) {
  const GuideStep step = guide_.look(frame);
  const std::string &text = line_.hear(step);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    text_ = text;
  }
  console.giveLine(stepJson(step));
}

void RecordGuide::see(const CapturePair &pair) {
  const sphc_localizer_frame frame = frameOf(pair);
  if (!pace_.isDue(frame.color_time_ns)) return;
  if (may_wait_) thread_.wait();
  if (thread_.offer(frame))
    pace_.looked(frame.color_time_ns);
  else if (thread_.failure().empty())
    ++skipped_;
}

std::string RecordGuide::text() {
  const std::string failure = thread_.failure();
  if (!failure.empty()) return "NO GUIDANCE: " + failure;  // what was said last is no advice any more
  const std::lock_guard<std::mutex> lock(mutex_);
  return text_;
}

nlohmann::ordered_json RecordGuide::end(const Console &console) {
  thread_.wait();
  const std::string failure = thread_.failure();
  if (!failure.empty()) console.warn("note: the guide ended before the recording: " + failure);
  const WalkSummary summary = guide_.summary();
  console.say(tableText(summaryRows(summary)) + nextSteps(summary));
  nlohmann::ordered_json json = summaryJson(summary);
  json["skipped"] = skipped_;
  return json;
}

}  // namespace sphc::host
