#include "lab/features/bench.h"

#include <limits>

#include "host/report/statistics.h"
#include "lab/common/interleave.h"
#include "lab/features/verify.h"

namespace sphc::host {
namespace {

constexpr double kRatio = 0.8, kVerifiedPx = 2;

struct VariantFrames {
  const FeaturesVariant *variant;
  std::vector<FoundFeatures> frames;  // of the recording; empty where no pair needs them
  std::vector<double> seconds;        // of those needed
};

// Those of any pair.
std::vector<size_t> framesOfPairs(size_t count, uint32_t every) {
  std::vector<bool> needed(count);
  for (size_t i = 0; i < count; i += every) {
    needed[i] = true;
    for (const uint32_t gap : kFeatureGaps)
      if (i + gap < count) needed[i + gap] = true;
  }
  std::vector<size_t> frames;
  for (size_t i = 0; i < count; ++i)
    if (needed[i]) frames.push_back(i);
  return frames;
}

std::vector<VariantFrames> extractAll(const GrayRecording &recording, const std::vector<FeaturesVariant> &variants,
                                      const FeaturesOptions &options, const FramesDone &frame_done) {
  const std::vector<size_t> needed = framesOfPairs(recording.frames.size(), options.every);
  std::vector<VariantFrames> all;
  for (const FeaturesVariant &variant : variants)
    if (variant.run) all.push_back({&variant, std::vector<FoundFeatures>(recording.frames.size()), {}});
  Random random(1);
  uint32_t done = 0;
  for (const size_t frame : needed) {
    const GrayView image = recording.view(frame);
    const auto seconds = interleave(all.size(), options.repeats, &random, [&](size_t chosen, uint32_t repeat) {
      FoundFeatures found = all[chosen].variant->run(image);
      const double taken = found.seconds;
      if (repeat == 0) all[chosen].frames[frame] = std::move(found);
      return taken;
    });
    for (size_t i = 0; i < all.size(); ++i) all[i].seconds.push_back(seconds[i]);
    if (frame_done) frame_done(++done, static_cast<uint32_t>(needed.size()));
  }
  return all;
}

PairQuality matchPairs(const GrayRecording &recording, const VariantFrames &of, uint32_t gap, uint32_t every) {
  PairQuality quality;
  std::vector<double> verified_px;
  size_t matched = 0;
  for (size_t i = 0; i + gap < recording.frames.size(); i += every) {
    const GrayFrame &a = recording.frames[i], &b = recording.frames[i + gap];
    if (!a.has_pose || !b.has_pose) continue;
    const auto matches = matchByRatio(*of.variant, of.frames[i], of.frames[i + gap], kRatio);
    const Rigid b_from_a = b.world_from_camera.inverse() * a.world_from_camera;
    for (const double error : sampsonErrors(recording.camera, b_from_a, of.frames[i], of.frames[i + gap], matches))
      if (error < kVerifiedPx) verified_px.push_back(error);
    matched += matches.size();
    ++quality.pairs;
  }
  if (quality.pairs == 0) return quality;
  quality.matches = static_cast<double>(matched) / static_cast<double>(quality.pairs);
  quality.verified = static_cast<double>(verified_px.size()) / static_cast<double>(quality.pairs);
  quality.sampson_px = percentile(verified_px, 0.5);
  return quality;
}

FeaturesSummary summarize(const GrayRecording &recording, const VariantFrames &of, uint32_t every) {
  FeaturesSummary s;
  s.name = of.variant->name;
  for (const FoundFeatures &found : of.frames) s.keypoints += static_cast<double>(found.pixels_px.size());
  s.keypoints /= static_cast<double>(of.seconds.size());
  s.median_ms = 1e3 * percentile(of.seconds, 0.5);
  s.p99_ms = 1e3 * percentile(of.seconds, 0.99);
  for (size_t g = 0; g < kFeatureGaps.size(); ++g) s.gaps[g] = matchPairs(recording, of, kFeatureGaps[g], every);
  return s;
}

}  // namespace

std::vector<FeaturesSummary> runFeaturesBench(const GrayRecording &recording,
                                              const std::vector<FeaturesVariant> &variants,
                                              const FeaturesOptions &options, const FramesDone &frame_done) {
  std::vector<FeaturesSummary> summaries;
  double opencv_ms = std::numeric_limits<double>::quiet_NaN();
  for (const VariantFrames &of : extractAll(recording, variants, options, frame_done)) {
    summaries.push_back(summarize(recording, of, options.every));
    if (summaries.back().name == kOpenCvSiftName) opencv_ms = summaries.back().median_ms;
  }
  for (FeaturesSummary &summary : summaries) summary.times_faster_than_opencv = opencv_ms / summary.median_ms;
  return summaries;
}

}  // namespace sphc::host
