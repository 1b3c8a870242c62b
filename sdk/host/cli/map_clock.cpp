#include "host/cli/map_clock.h"

#include "host/base/in_seconds.h"
#include "host/guide/stretch_causes.h"
#include "host/report/hint_words.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

nlohmann::ordered_json causesJson(const Stretch &stretch) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const StretchCause &cause : causesOf(stretch))
    json.push_back({{"name", cause.name}, {"measured", cause.measured}, {"cure", cause.cure}});
  return json;
}

}  // namespace

const MappedRecording &MapClock::recordingOf(const Stretch &s) const {
  return outcome_.recordings[outcome_.walk.keyframes[s.first].recording];
}

double MapClock::secondsOf(uint32_t keyframe) const {
  const WalkFrame &frame = outcome_.walk.keyframes[keyframe];
  return inSeconds(frame.time_ns - outcome_.recordings[frame.recording].reader->colorOf(0).time_ns);
}

std::string MapClock::timesOf(const std::vector<Stretch> &stretches) const {
  std::string text;
  for (const Stretch &s : stretches)
    text += (text.empty() ? "" : ", ") + (outcome_.recordings.size() > 1 ? recordingOf(s).name + " " : "") +
            fixed(secondsOf(s.first), 1) + " to " + fixed(secondsOf(s.last), 1) + " s";
  return text;
}

nlohmann::ordered_json MapClock::jsonOf(const std::vector<Stretch> &stretches) const {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Stretch &s : stretches)
    json.push_back({{"recording", recordingOf(s).name},
                    {"from_s", secondsOf(s.first)},
                    {"to_s", secondsOf(s.last)},
                    {"frames", s.frames},
                    {"hints", hintNames(s.hints)},
                    {"causes", causesJson(s)}});
  return json;
}

uint32_t framesOf(const std::vector<Stretch> &stretches) {
  uint32_t frames = 0;
  for (const Stretch &s : stretches) frames += s.frames;
  return frames;
}

}  // namespace sphc::host
