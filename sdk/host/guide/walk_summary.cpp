#include "host/guide/walk_summary.h"

#include <algorithm>

#include "host/base/in_seconds.h"

namespace sphc::host {
namespace {

constexpr int64_t kGapNs = 500000000;     // good frames between two hard stretches; fewer are part of one
constexpr int64_t kPauseNs = 3000000000;  // without a frame between two hard ones
constexpr size_t kFewestFrames = 2;       // of a stretch
constexpr GuideAdvice kAll[] = {kGoBack, kMoreLight, kOtherRange, kSlower, kMoreTexture, kLookAgain};

class Stretches {
 public:
  explicit Stretches(int64_t begin_ns) : begin_ns_(begin_ns) {}

  void add(int64_t time_ns, GuideAdvice advice) {
    was_good_ = was_good_ || !advice;
    if (!advice) return;
    if (!advices_.empty() && time_ns - to_ns_ > (was_good_ ? kGapNs : kPauseNs)) end();
    if (advices_.empty()) from_ns_ = time_ns;
    to_ns_ = time_ns;
    was_good_ = false;
    advices_.push_back(advice);
  }
  std::vector<HardStretch> all() {
    end();
    return all_;
  }

 private:
  void end() {
    GuideAdvice common = 0;
    for (const GuideAdvice bit : kAll) {
      const auto with =
          std::count_if(advices_.begin(), advices_.end(), [&](GuideAdvice a) { return (a & bit) != 0; });
      if (2 * static_cast<size_t>(with) >= advices_.size()) common |= bit;
    }
    if (advices_.size() >= kFewestFrames)
      all_.push_back({inSeconds(from_ns_ - begin_ns_), inSeconds(to_ns_ - begin_ns_), common});
    advices_.clear();
  }

  int64_t begin_ns_, from_ns_ = 0, to_ns_ = 0;
  bool was_good_ = false;  // since then; a recording may have one frame a second
  std::vector<GuideAdvice> advices_;
  std::vector<HardStretch> all_;
};

}  // namespace

WalkSummary summaryOf(const std::vector<Look> &looks, const std::vector<GuidePlace> &places, uint32_t largest_part,
                      uint32_t loops) {
  WalkSummary summary;
  if (looks.empty()) return summary;
  summary.frames = static_cast<uint32_t>(looks.size());
  summary.seconds = inSeconds(looks.back().time_ns - looks.front().time_ns);
  summary.loops = loops;
  summary.places = static_cast<uint32_t>(places.size());
  std::vector<uint32_t> parts;
  for (size_t i = 0; i < places.size(); ++i) {
    parts.push_back(places[i].part);
    summary.seen_again += places[i].seen_again;
    if (places[i].seen_again && places[i].time_ns - looks.front().time_ns < kBeginNs)
      summary.begin_seen_again = true;
    if (i > 0 && places[i].part == places[i - 1].part)
      summary.path_m +=
          (places[i].part_from_camera.translation_m - places[i - 1].part_from_camera.translation_m).norm();
  }
  // A place alone is held to nothing, so that is no weakness.
  const bool may_be_thin = std::count(parts.begin(), parts.end(), largest_part) > 1;
  std::sort(parts.begin(), parts.end());
  summary.parts = static_cast<uint32_t>(std::unique(parts.begin(), parts.end()) - parts.begin());
  Stretches stretches(looks.front().time_ns);
  for (const Look &look : looks) {
    const bool is_in = look.place != UINT32_MAX && places[look.place].part == largest_part;
    summary.followed += is_in;
    GuideAdvice advice = is_in ? look.advice : look.advice | kGoBack;
    if (is_in && may_be_thin && places[look.place].support < kThinInliers) advice |= kLookAgain;
    stretches.add(look.time_ns, advice);
  }
  summary.hard = stretches.all();
  return summary;
}

}  // namespace sphc::host
