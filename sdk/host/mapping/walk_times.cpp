#include "host/mapping/walk_times.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "host/base/in_seconds.h"
#include "host/base/median.h"

namespace sphc::host {
namespace {

using recording::RecordedImage;

constexpr size_t kFewestOfDrift = 10;  // frames
constexpr double kSteady = 0.1;        // of a drift: what it leaves over, root of the mean square, relative

std::vector<double> gapsOf(const std::vector<RecordedImage> &images) {
  std::vector<double> gaps_s;
  for (size_t i = 1; i < images.size(); ++i) gaps_s.push_back(inSeconds(images[i].time_ns - images[i - 1].time_ns));
  return gaps_s;
}

std::vector<Pause> pausesOf(const std::vector<RecordedImage> &images) {
  std::vector<Pause> pauses;
  const std::vector<double> gaps_s = gapsOf(images);
  const double usual_s = median(gaps_s);
  for (size_t i = 0; i < gaps_s.size(); ++i)
    if (isPause(gaps_s[i], usual_s))
      pauses.push_back(
          {inSeconds(images[i].time_ns - images[0].time_ns), inSeconds(images[i + 1].time_ns - images[0].time_ns)});
  return pauses;
}

// Two streams, as if they were those of a recording; the rarer one looks for partners.
recording::Recording rarerFirst(const recording::Recording &recording) {
  recording::Recording streams;
  streams.color = recording.color;
  streams.depth = recording.depth;
  if (recording.depth.size() < recording.color.size()) std::swap(streams.color, streams.depth);
  return streams;
}

// How far the nearest image of the other stream is from one of the rarer stream.
struct Offset {
  double at_s, offset_s;
};

std::vector<Offset> offsetsOf(const recording::Recording &streams) {
  std::vector<Offset> offsets;
  for (const recording::FramePair &pair : pairFrames(streams, INT64_MAX)) {
    const int64_t time_ns = streams.color[pair.color].time_ns;
    offsets.push_back(
        {inSeconds(time_ns - streams.color[0].time_ns), inSeconds(streams.depth[pair.depth].time_ns - time_ns)});
  }
  return offsets;
}

// The nearest image changes as streams move past each other: offsets are equal but for whole periods.
void unwrap(double period_s, std::vector<Offset> *offsets) {
  for (size_t i = 1; i < offsets->size(); ++i) {
    Offset &offset = (*offsets)[i];
    offset.offset_s += period_s * std::round(((*offsets)[i - 1].offset_s - offset.offset_s) / period_s);
  }
}

// The line through the offsets, where they lie on one.
void addDrift(const std::vector<Offset> &offsets, WalkTimes *times) {
  double at = 0, mean = 0;
  for (const Offset &o : offsets) at += o.at_s, mean += o.offset_s;
  at /= static_cast<double>(offsets.size());
  mean /= static_cast<double>(offsets.size());
  double across = 0, along = 0, all = 0;
  for (const Offset &o : offsets) {
    along += (o.at_s - at) * (o.at_s - at);
    across += (o.at_s - at) * (o.offset_s - mean);
    all += (o.offset_s - mean) * (o.offset_s - mean);
  }
  if (!(along > 0)) return;
  const double slope = across / along, duration_s = offsets.back().at_s - offsets.front().at_s;
  const double left_over = std::sqrt(std::max(0.0, all - slope * across) / static_cast<double>(offsets.size()));
  if (left_over > kSteady * std::abs(slope) * duration_s) return;
  times->drift_s_per_s = slope;
  times->drifted_s = slope * duration_s;
}

}  // namespace

WalkTimes timesOf(const recording::RecordingReader &reader) {
  const recording::Recording &recording = reader.recording();
  WalkTimes times;
  times.backward = recording.backward_count;
  times.pauses = pausesOf(recording.color);
  const size_t rarer = std::min(recording.color.size(), recording.depth.size());
  if (rarer > 0) times.unpaired = 1 - static_cast<double>(reader.frameCount()) / static_cast<double>(rarer);
  times.unpaired = std::max(0.0, times.unpaired);
  std::vector<double> apart_s;
  for (uint32_t i = 0; i < reader.frameCount(); ++i)
    apart_s.push_back(inSeconds(std::abs(reader.depthOf(i).time_ns - reader.colorOf(i).time_ns)));
  times.apart_s = median(std::move(apart_s));
  const recording::Recording streams = rarerFirst(recording);
  std::vector<Offset> offsets = offsetsOf(streams);
  const double period_s = median(gapsOf(streams.depth));
  if (offsets.size() < kFewestOfDrift || !(period_s > 0)) return times;
  unwrap(period_s, &offsets);
  addDrift(offsets, &times);
  return times;
}

}  // namespace sphc::host
