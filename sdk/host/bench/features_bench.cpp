#include "host/bench/features_bench.h"

#include <limits>

#include "host/bench/features_verify.h"
#include "host/bench/interleave.h"
#include "host/report/statistics.h"

namespace sphc::host {
namespace {

constexpr double kRatio = 0.8, kVerifiedPx = 2;

struct VariantFrames {
  const FeaturesVariant *variant;
  std::vector<FoundFeatures> frames;
  std::vector<double> seconds;  // a frame
};

std::vector<VariantFrames> extractAll(const GrayRecording &recording, const std::vector<FeaturesVariant> &variants,
                                      uint32_t repeats, const FramesDone &frame_done) {
  std::vector<VariantFrames> all;
  for (const FeaturesVariant &variant : variants)
    if (variant.run) all.push_back({&variant, {}, {}});
  Random random(1);
  const size_t count = recording.frames.size();
  for (size_t frame = 0; frame < count; ++frame) {
    const GrayView image = recording.view(frame);
    const auto seconds = interleave(all.size(), repeats, &random, [&](size_t chosen, uint32_t repeat) {
      FoundFeatures found = all[chosen].variant->run(image);
      const double taken = found.seconds;
      if (repeat == 0) all[chosen].frames.push_back(std::move(found));
      return taken;
    });
    for (size_t i = 0; i < all.size(); ++i) all[i].seconds.push_back(seconds[i]);
    if (frame_done) frame_done(static_cast<uint32_t>(frame + 1), static_cast<uint32_t>(count));
  }
  return all;
}

MatchQuality matchPairs(const GrayRecording &recording, const VariantFrames &of, uint32_t gap, uint32_t every) {
  MatchQuality quality;
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
  s.keypoints /= static_cast<double>(of.frames.size());
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
  for (const VariantFrames &of : extractAll(recording, variants, options.repeats, frame_done)) {
    summaries.push_back(summarize(recording, of, options.every));
    if (summaries.back().name == kOpenCvSiftName) opencv_ms = summaries.back().median_ms;
  }
  for (FeaturesSummary &summary : summaries) summary.times_faster_than_opencv = opencv_ms / summary.median_ms;
  return summaries;
}

}  // namespace sphc::host
