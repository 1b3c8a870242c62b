// Why a frame has no pose, as far as its image, its depths and its matches show; docs/hints.md.
#pragma once
#include "runtime/localizer/hypothesis.h"
#include "runtime/types/hint.h"
#include "runtime/types/image_view.h"

namespace sphc {

// What an image is worth, whatever it shows.
struct ImageQuality {
  double level = 0;  // median grey level
  double noise = 0;  // standard deviation of a pixel's noise, grey levels
  // Mean difference over many pixels, without that of noise: root of the mean square, grey levels.
  double contrast = 0;
  // Of four directions in the image: which share of that (squared) is there over few pixels.  Blurred along a line,
  // an image has little along that and more across.
  double least_sharp = 1, most_sharp = 1;
  double brightest = 0;  // grey level that an eighth of the image lies above

  bool isDark() const;
  bool isOverexposed() const;
  bool isPlain() const;
  bool isBlurredAlongALine() const;
};

// Reads a grid of samples.  `focal_px`: a finer image is sampled in larger steps.
ImageQuality qualityOf(GrayView gray, double focal_px);
// Is the image too dark, or too bright, to show edges where they are?
bool hidesEdges(GrayView gray);

// How many of the keypoints are stronger than noise makes them?
uint32_t countSalient(Span<const Keypoint> keypoints, double noise);

// Of these matches, how many beat their runner-up as clearly as a keypoint hardly ever does that is not in the map?
uint32_t countClear(Span<const Match> matches);

// Of a frame without a pose.
struct FrameEvidence {
  ImageQuality image;
  uint32_t keypoints = 0, salient = 0, lifted = 0;
  bool was_cut = false;    // did a deadline leave keypoints out?
  bool was_asked = false;  // were all keypoints compared with the likeliest maps?
  uint32_t clear = 0;      // matches, in the map that has most
};
Hints hintsOf(const FrameEvidence &frame, const Hypothesis &best);

}  // namespace sphc
