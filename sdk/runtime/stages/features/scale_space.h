// The Gaussian scale space, octave by octave (Lowe 2004, section 3).
//
// An octave is swept once from top to bottom, every level following the one below it by the radius of its blur, so
// the rows in work stay in the cache; the differences are taken while a row is there.  The levels from which
// descriptors are read are kept whole; the others and the differences live in rings of rows that exist just long
// enough for the next blur and the extrema search.
#pragma once
#include <cstdint>

#include "runtime/base/arena.h"
#include "runtime/stages/features/config.h"
#include "runtime/stages/features/kernels.h"
#include "runtime/stages/features/plane.h"
#include "runtime/types/image_view.h"

namespace sphc {

constexpr int32_t kScales = kSearchedLayers;  // per octave
constexpr int32_t kLevels = kScales + 3;      // Gaussian images per octave
constexpr int32_t kMaxOctaves = 11;           // 2 * 8192 down to 16
constexpr double kBaseSigma = 1.0;            // of level 0, in pixels of its octave
constexpr int32_t kRefineReach = 5;           // rows an extremum may wander in refinement

// Of an octave, from the first on.
struct Rows {
  int32_t first, count;
};

// Standard deviation at a level or between two, 0 <= layer <= kLevels, in pixels of the octave.
float sigmaOfLayer(float layer);

class ScaleSpace {
 public:
  static void layout(const FeatureConfig &config, Arena &state, Arena &scratch, ScaleSpace *out);
  void init(const FeatureKernels &kernels);
  // Of the images that follow, no larger than layout was told.
  void setSize(const FeatureConfig &config);

  int32_t octaves() const { return octaves_; }
  int32_t width(int32_t octave) const { return widths_[octave]; }
  int32_t height(int32_t octave) const { return heights_[octave]; }
  // Pixels of the input image in one of the octave's.
  float pixelSize(int32_t octave) const;

  void beginOctave(int32_t octave, GrayView gray) { beginBand(octave, {0, heights_[octave]}, gray); }
  // These rows alone, as an image of their own: rows of levels and differences are counted from the first one.
  void beginBand(int32_t octave, Rows rows, GrayView gray);
  // Sweep step y = 0, kRowsAtOnce, ... below stepCount() computes rows y - lag(level) and the next of every level,
  // where there are any, and of the difference between it and the level below.
  void step(int32_t y);
  int32_t stepCount() const { return height_ + stepsBeyond(octave_); }
  // More than there are rows.
  int32_t stepsBeyond(int32_t octave) const { return lagIn(octave, kLevels - 1) + kRefineReach + 2; }
  int32_t lag(int32_t level) const { return lagIn(octave_, level); }

  // In place of a sweep: makes no more of the octave than the next one is made from.  Steps y = 0, kRowsAtOnce, ...
  // below skimCount().
  void skim(int32_t y);
  int32_t skimCount() const { return height_ + skimLag(); }

  // Level layer + 1 less level layer, in the octave of the sweep: the rows around the one searched.
  const Plane &difference(int32_t layer) const { return differences_[layer]; }
  // What was begun of an octave.
  Rows rows(int32_t octave) const { return rows_[octave]; }
  // Levels 1 .. kScales of any octave swept.
  const Plane &kept(int32_t octave, int32_t level) const { return kept_[octave][level - 1]; }

 private:
  // In the first octave level 0 is itself blurred from the source rows and follows them.
  int32_t lagIn(int32_t octave, int32_t level) const {
    return base_lags_[level] + (octave == 0 ? base_kernel_.radius : 0);
  }

  struct Kernel {
    int16_t weights[kMaxBlurRadius + 1];  // of kOneQ15
    int32_t radius;
  };
  static Kernel gaussian(double sigma);
  static int32_t octaveCount(const FeatureConfig &config);

  void firstRow(int32_t y);
  void blurInto(const Kernel &kernel, const Plane &from, const Plane &to, const Plane *difference, int32_t y,
                int32_t rows = kRowsAtOnce);
  const Kernel &skimKernel() const { return skim_kernels_[octave_ == 0 ? 0 : 1]; }
  // Even: only every second row of the level is made.
  int32_t skimLag() const { return skimKernel().radius & ~1; }

  int32_t first_octave_ = 0, octaves_ = 0;
  int32_t widths_[kMaxOctaves] = {}, heights_[kMaxOctaves] = {};
  Kernel base_kernel_ = {}, kernels_[kLevels] = {};  // kernels_[l] makes level l from level l - 1
  Kernel skim_kernels_[2] = {};  // make level kScales: of the first octave from the source, of others from level 0
  int32_t base_lags_[kLevels] = {};

  Plane kept_[kMaxOctaves][kScales];
  Plane source_, ring_[kLevels], differences_[kDogLayers];
  Span<int16_t> padded_;
  const FeatureKernels *row_kernels_ = nullptr;

  // the sweep
  int32_t octave_ = 0, width_ = 0, height_ = 0;
  Rows rows_[kMaxOctaves] = {};
  GrayView gray_;
  Plane level_[kLevels];
};

}  // namespace sphc
