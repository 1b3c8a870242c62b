// The feature stage: grey image in, keypoints and descriptors out, in fixed memory.
#pragma once
#include <cstdint>

#include "runtime/base/arena.h"
#include "runtime/base/pace.h"
#include "runtime/base/span.h"
#include "runtime/stages/features/candidates.h"
#include "runtime/stages/features/config.h"
#include "runtime/stages/features/descriptor.h"
#include "runtime/stages/features/extrema.h"
#include "runtime/stages/features/gaussian_table.h"
#include "runtime/stages/features/kernels.h"
#include "runtime/stages/features/scale_space.h"
#include "runtime/types/image_view.h"
#include "runtime/types/keypoint.h"

namespace sphc {

// Written to maps; raise it whenever the same image would give other descriptors.
constexpr uint32_t kExtractorId = 2;

class FeatureExtractor {
  // Of sweeping and describing, before anything was timed: a little more than a desktop's core takes.
  static constexpr double kGuessedPixelNs = 6, kGuessedKeypointNs = 1500;

 public:
  // True where the configuration is one that layout() may be asked about.
  static bool accepts(const FeatureConfig &config);

  // One layout walk: tables into `state`, pyramids and lists into `scratch`.  `out` is null while measuring.
  static void layout(const FeatureConfig &config, Arena &state, Arena &scratch, FeatureExtractor *out);
  // Computes the tables; once, after a layout over memory.  All kernels give the same bytes.
  void init(const FeatureKernels &kernels = simdFeatureKernels());

  // `gray` is no larger than configured; `keypoints` and `descriptors` have room for as many as are wanted, at most
  // max_keypoints.  Returns how many were found, highest response first.  Scratch keeps nothing from call to call; the same image gives the same
  // bytes, but where a deadline cuts: then the finest octaves are left out but for a band of rows, for they cost
  // most, and the weakest keypoints.  How much fits is known from what earlier calls with a deadline took.
  uint32_t extract(GrayView gray, Span<Keypoint> keypoints, Span<Descriptor> descriptors,
                   const Deadline &deadline = {});
  // Did the deadline leave something out of the last call?
  bool wasCut() const { return cut_; }

 private:
  void setSize(GrayView gray);
  int32_t finestWithin(const Deadline &deadline) const;
  bool sweepFrom(int32_t finest, GrayView gray, const Deadline &deadline);
  bool skimOctave(int32_t octave, GrayView gray, Watch *watch);
  bool sweepOctave(int32_t octave, GrayView gray, const Deadline &deadline, double *pixels);
  void sweepBand(int32_t octave, GrayView gray, const Deadline &deadline);
  bool sweepRows(int32_t octave, Rows rows, GrayView gray, const Deadline &deadline, double most_for_probed,
                 double *pixels);
  void sweep(GrayView gray, const Deadline &deadline);
  // Rows before an octave's first and after its last cost as much as its own.
  double sweptPixels(int32_t octave) const {
    return static_cast<double>(space_.width(octave)) * (space_.height(octave) + space_.stepsBeyond(octave));
  }
  uint32_t describe(const Candidate &candidate, uint32_t room, Keypoint *keypoints, Descriptor *descriptors);

  FeatureConfig config_;  // of the image in work
  int32_t most_width_ = 0, most_height_ = 0;
  const FeatureKernels *kernels_ = nullptr;
  ScaleSpace space_;
  ExtremaFinder finder_;
  CandidateList candidates_;
  GaussianTable gaussian_;
  Describer describer_;
  Pace pixels_pace_{kGuessedPixelNs}, keypoints_pace_{kGuessedKeypointNs};
  bool cut_ = false;
};

}  // namespace sphc
