#include "runtime/localizer/hints.h"

#include <algorithm>

#include "runtime/localizer/tuning.h"

namespace sphc {
namespace {

using namespace tuning;

constexpr int32_t kGrayLevels = 256;

// Counts of values from 0 on; those beyond the last bin are in it.
class Histogram {
 public:
  void add(int32_t value) {
    ++counts_[std::min(value, kGrayLevels - 1)];
    ++total_;
  }
  uint32_t total() const { return total_; }
  // Value below which a share of them lies: linear within a bin, which reaches half a level to either side.
  double quantile(double share) const {
    const double wanted = share * total_;
    double below = 0;
    for (int32_t value = 0; value < kGrayLevels; ++value) {
      const double here = counts_[value];
      if (here > 0 && below + here >= wanted) return std::max(0.0, value - 0.5 + (wanted - below) / here);
      below += here;
    }
    return 0;
  }

 private:
  uint32_t counts_[kGrayLevels] = {};
  uint32_t total_ = 0;
};

// Calls `visit` with the middles of the cells of a grid over what lies `border` or more inside the image.
template <typename Visit>
void forGrid(GrayView gray, int32_t columns, int32_t rows, int32_t border, const Visit &visit) {
  const int32_t width = gray.width - 2 * border, height = gray.height - 2 * border;
  if (width < 1 || height < 1) return;
  for (int32_t row = 0; row < rows; ++row)
    for (int32_t column = 0; column < columns; ++column)
      visit(border + (2 * column + 1) * width / (2 * columns), border + (2 * row + 1) * height / (2 * rows));
}

// The difference of two Laplacians is blind to edges: J. Immerkaer, "Fast noise variance estimation" (1996).
int32_t differenceOfLaplacians(GrayView gray, int32_t x, int32_t y) {
  const uint8_t *above = gray.row(y - 1) + x, *here = gray.row(y) + x, *below = gray.row(y + 1) + x;
  return (above[-1] + above[1] + below[-1] + below[1]) - 2 * (above[0] + below[0] + here[-1] + here[1]) +
         4 * here[0];
}

void measureLight(GrayView gray, ImageQuality *quality) {
  Histogram levels, differences;
  forGrid(gray, kLightColumns, kLightRows, 1, [&](int32_t x, int32_t y) {
    const int32_t level = gray.row(y)[x];
    levels.add(level);
    if (level >= kFewestLevels && level < kGrayLevels - kFewestLevels)  // else it may be clipped
      differences.add(absOf(differenceOfLaplacians(gray, x, y)));
  });
  quality->level = levels.quantile(0.5);
  quality->brightest = levels.quantile(1 - kMostClipped);
  quality->noise = kLeastNoise;
  if (differences.total() * kFewestUnclipped < levels.total()) return;
  // The quiet part of the image has least texture.
  quality->noise = std::max(kLeastNoise, differences.quantile(kQuietShare) / kQuietQuantile);
}

// Sums of squared differences over few pixels and over many.
struct Contrast {
  int64_t fine = 0, coarse = 0;
};

int64_t squared(int32_t a, int32_t b) { return int64_t{a - b} * (a - b); }

void measureSharpness(GrayView gray, int32_t step, ImageQuality *quality) {
  constexpr int32_t kDirections[4][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}};
  Contrast found[4];
  double samples = 0;
  forGrid(gray, kSharpColumns, kSharpRows, kCoarseSteps * step, [&](int32_t x, int32_t y) {
    const int32_t here = gray.row(y)[x];
    ++samples;
    for (int32_t i = 0; i < 4; ++i) {
      const int32_t dx = kDirections[i][0] * step, dy = kDirections[i][1] * step;
      found[i].fine += squared(here, gray.row(y + kFineSteps * dy)[x + kFineSteps * dx]);
      found[i].coarse += squared(here, gray.row(y + kCoarseSteps * dy)[x + kCoarseSteps * dx]);
    }
  });
  if (!(samples > 0)) return;
  const double noise2 = 2 * quality->noise * quality->noise;
  double sum = 0, least = 1, most = 0;
  for (const Contrast &contrast : found) {
    const double fine = std::max(0.0, static_cast<double>(contrast.fine) / samples - noise2),
                 coarse = std::max(0.0, static_cast<double>(contrast.coarse) / samples - noise2);
    const double sharp = coarse > 0 ? std::min(1.0, fine / coarse) : 1;
    sum += coarse;
    least = std::min(least, sharp);
    most = std::max(most, sharp);
  }
  quality->contrast = sqrtOf(sum / 4);
  quality->least_sharp = least;
  quality->most_sharp = most;
}

// The first that holds: noise hides blur, and where little is seen neither shows.
Hints hintsOfImage(const FrameEvidence &frame) {
  if (frame.image.isDark()) return kTooDark;
  if (frame.image.isPlain() || (!frame.was_cut && frame.salient < kFewestSalient)) return kTooPlain;
  return frame.image.isBlurredAlongALine() ? kTooFast : Hints{0};
}

// Only what a good image shows can be missed in a map.
bool isNotInMap(const FrameEvidence &frame, const Hypothesis &best) {
  const bool found_nothing = best.outcome == Outcome::kFewMatches || best.outcome == Outcome::kNoConsensus;
  return frame.was_asked && !frame.was_cut && found_nothing &&
         frame.clear < kFewestClear + kStrangersClear * frame.keypoints &&
         best.evidence.log_chance_first > kMostLogChanceOfRival;
}

}  // namespace

bool ImageQuality::isDark() const { return level < kLeastLightOverNoise * noise; }

bool ImageQuality::isOverexposed() const { return brightest > kWhite; }

bool ImageQuality::isPlain() const { return contrast < std::max(kLeastContrast, noise); }

bool ImageQuality::isBlurredAlongALine() const {
  return most_sharp > kLeastAcross && least_sharp < kMostAlong && least_sharp * kAcrossOverAlong < most_sharp;
}

ImageQuality qualityOf(GrayView gray, double focal_px) {
  ImageQuality quality;
  measureLight(gray, &quality);
  measureSharpness(gray, static_cast<int32_t>(std::max(1.0, focal_px / kFocalOfAStep + 0.5)), &quality);
  return quality;
}

bool hidesEdges(GrayView gray) {
  ImageQuality quality;
  measureLight(gray, &quality);
  return quality.isDark() || quality.isOverexposed();
}

uint32_t countSalient(Span<const Keypoint> keypoints, double noise) {
  // White noise of 1 leaves a difference of Gaussians of this at scale 1, in grey levels.
  constexpr double kNoiseOfDifference = 0.082;
  const double least = kSalient * kNoiseOfDifference * noise / (kGrayLevels - 1);
  return static_cast<uint32_t>(std::count_if(keypoints.begin(), keypoints.end(), [&](const Keypoint &k) {
    return static_cast<double>(k.response) * static_cast<double>(k.scale_px) > least;
  }));
}

uint32_t countClear(Span<const Match> matches) {
  return static_cast<uint32_t>(std::count_if(matches.begin(), matches.end(), [](const Match &m) {
    return static_cast<double>(m.distance2) < kClearRatio * kClearRatio * static_cast<double>(m.second2);
  }));
}

Hints hintsOf(const FrameEvidence &frame, const Hypothesis &best) {
  Hints hints = hintsOfImage(frame);
  const bool is_lifted = frame.lifted >= kFewestLifted && frame.lifted * kOneWithDepthIn >= frame.keypoints;
  const bool may_be_lifted = frame.was_cut && frame.keypoints < kOneWithDepthIn * kFewestLifted;
  if (!is_lifted && !may_be_lifted) hints |= kNoDepthInRange;
  if (hints == 0 && isNotInMap(frame, best)) hints |= kNotInMap;
  if (best.is_ambiguous && best.outcome == Outcome::kUncertain) hints |= kAmbiguous;
  return hints;
}

}  // namespace sphc
