// The Gaussian scale space, octave by octave (Lowe 2004, section 3): its sizes and blurs, and the levels from which
// descriptors are read.  A sweep (sweep.h) fills it.
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

  int32_t end() const { return first + count; }
  bool has(int32_t y) const { return y >= first && y < end(); }
};

struct BlurKernel {
  int16_t weights[kMaxBlurRadius + 1];  // of kOneQ15
  int32_t radius;
};

// Standard deviation at a level or between two, 0 <= layer <= kLevels, in pixels of the octave.
float sigmaOfLayer(float layer);
// Of the image that the first octave is made of: twice as wide where that is octave -1.
inline int32_t firstOctaveSide(const FeatureConfig &config, int32_t side) {
  return config.first_octave < 0 ? 2 * side : side;
}

inline Plane takePlane(Arena &arena, const char *name, int32_t width, int32_t rows, int32_t row_mask) {
  const int32_t stride = paddedWidth(width);
  return {arena.take<int16_t>(name, static_cast<size_t>(stride) * static_cast<size_t>(rows)).data(), stride,
          row_mask};
}

class ScaleSpace {
 public:
  static void layout(const FeatureConfig &config, Arena &scratch, ScaleSpace *out);
  void init();
  // Of the images that follow, no larger than layout was told.
  void setSize(const FeatureConfig &config);

  int32_t octaves() const { return octaves_; }
  int32_t width(int32_t octave) const { return widths_[octave]; }
  int32_t height(int32_t octave) const { return heights_[octave]; }
  // Pixels of the input image in one of the octave's.
  float pixelSize(int32_t octave) const;
  bool isDoubled() const { return first_octave_ < 0; }

  // What the next sweeps are of.
  void beginOctave(int32_t octave, GrayView gray) { beginBand(octave, {0, heights_[octave]}, gray); }
  // These rows alone, as an image of their own: rows of levels and differences are counted from the first one.
  void beginBand(int32_t octave, Rows rows, GrayView gray);
  int32_t octave() const { return octave_; }
  const GrayView &gray() const { return gray_; }

  // What was begun of an octave.
  Rows rows(int32_t octave) const { return rows_[octave]; }
  // Levels 1 .. kScales of any octave swept.
  const Plane &kept(int32_t octave, int32_t level) const { return kept_[octave][level - 1]; }
  static bool isKept(int32_t level) { return level >= 1 && level <= kScales; }

  // Makes a level from the one below it, and in the first octave level 0 from the image.
  const BlurKernel &kernel(int32_t level) const { return level == 0 ? base_kernel_ : kernels_[level]; }
  // Makes level kScales: in the first octave from the image, in others from level 0.
  const BlurKernel &skimKernel(int32_t octave) const { return skim_kernels_[octave == 0 ? 0 : 1]; }
  // Rows that a level of a sweep is behind the first row.  In the first octave level 0 is itself blurred from the
  // source rows and follows them.
  int32_t lag(int32_t octave, int32_t level) const {
    return base_lags_[level] + (octave == 0 ? base_kernel_.radius : 0);
  }
  // Rows that a sweep reads on both sides of those that it searches.
  int32_t reach(int32_t octave) const { return lag(octave, kLevels - 1) + kRefineReach + 1; }

 private:
  static BlurKernel gaussian(double sigma);
  static int32_t octaveCount(const FeatureConfig &config);

  int32_t first_octave_ = 0, octaves_ = 0;
  int32_t widths_[kMaxOctaves] = {}, heights_[kMaxOctaves] = {};
  BlurKernel base_kernel_ = {}, kernels_[kLevels] = {}, skim_kernels_[2] = {};
  int32_t base_lags_[kLevels] = {};
  Plane kept_[kMaxOctaves][kScales];
  Rows rows_[kMaxOctaves] = {};

  int32_t octave_ = 0;
  GrayView gray_;
};

}  // namespace sphc
