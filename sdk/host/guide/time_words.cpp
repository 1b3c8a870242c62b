#include "host/guide/time_words.h"

#include <cmath>

#include "host/base/counted.h"
#include "host/report/run.h"

namespace sphc::host {
namespace {

constexpr double kMostUnpaired = 0.1, kMostApartS = 0.01, kMostDriftedS = 0.005;
constexpr const char *kOneClock =
    "trigger both cameras together, or stamp their images by one clock (docs/capture.md)";

std::string milliseconds(double seconds) { return fixed(1000 * std::abs(seconds), 0) + " ms"; }

}  // namespace

std::vector<std::string> complaintsOf(const WalkTimes &times) {
  std::vector<std::string> said;
  if (times.backward > 0)
    said.push_back("the times of " + counted(times.backward, "image") +
                   " go backwards, and these are left out: a clock was set while it recorded; stamp images "
                   "by a clock that only goes forwards, and record once more");
  for (const Pause &pause : times.pauses)
    said.push_back("no frame was taken from " + fixed(pause.from_s, 1) + " to " + fixed(pause.to_s, 1) +
                   " s: record without a pause; where there was none, a clock was set while it recorded");
  if (times.unpaired > kMostUnpaired)
    said.push_back(fixed(100 * times.unpaired, 0) +
                   " % of the images have no partner of their time and are left out: " + kOneClock);
  if (std::abs(times.drifted_s) > kMostDriftedS)
    said.push_back("colour and depth move past each other by " + milliseconds(60 * times.drift_s_per_s) +
                   " a minute: the clocks drift, or the cameras run at rates of their own; " + kOneClock);
  if (times.apart_s > kMostApartS)
    said.push_back("colour and depth of a frame are " + milliseconds(times.apart_s) +
                   " apart (median), and the camera moves between them: walk slower, and " + kOneClock);
  return said;
}

}  // namespace sphc::host
