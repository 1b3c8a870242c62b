// One pass over rows of an octave from top to bottom, every level following the one below it by the radius of its
// blur, so the rows in work stay in the cache; the differences are taken while a row is there.  The levels that are
// not kept and the differences live in rings of rows that exist just long enough for the next blur and the extrema
// search.
//
// Several sweeps may share an octave, each with a piece of its rows.  Beyond its piece a sweep makes what it needs
// for itself and writes nothing that another one does.
#pragma once
#include "runtime/stages/features/scale_space.h"

namespace sphc {

class Sweep {
 public:
  // `shares`: will it have pieces of octaves?
  static void layout(const FeatureConfig &config, bool shares, Arena &scratch, Sweep *out);

  // Of what `space` has begun, these rows.  Both are borrowed; the space is written to by way of its planes alone.
  void begin(const ScaleSpace &space, Rows piece, const FeatureKernels &kernels);

  // Step y = firstStep(), firstStep() + kRowsAtOnce, ... below endStep() computes rows y - lag(level) and the next
  // of every level, where they are needed, and of the difference between it and the level below.
  int32_t firstStep() const;
  int32_t endStep() const { return piece_.end() + reach() + 1; }
  void step(int32_t y);
  int32_t lag(int32_t level) const { return space_->lag(octave_, level); }
  // Rows on both sides of the piece that the first row's steps are for.
  int32_t reach() const { return space_->reach(octave_); }

  // In place of a sweep of all rows: makes no more of the octave than the next one is made from.  Steps y = 0,
  // kRowsAtOnce, ... below skimCount().
  void skim(int32_t y);
  int32_t skimCount() const { return height_ + skimLag(); }

  // Level layer + 1 less level layer: the rows around the one searched.
  const Plane &difference(int32_t layer) const { return differences_[layer]; }
  int32_t octave() const { return octave_; }
  int32_t width() const { return width_; }
  int32_t height() const { return height_; }
  // Of the octave, what row 0 is.
  int32_t top() const { return top_; }
  const Rows &piece() const { return piece_; }

 private:
  static constexpr int32_t kSource = -1;  // in place of a level: the image

  int16_t *row(int32_t level, int32_t y) const;
  Rows neededOf(int32_t level) const;
  void firstRow(int32_t y);
  void blurInto(const BlurKernel &kernel, int32_t from, int32_t to, Rows rows);
  // Even: only every second row of the level is made.
  int32_t skimLag() const { return space_->skimKernel(octave_).radius & ~1; }

  // Of a level that is kept, rows that are another sweep's.
  Plane ring_[kLevels], source_, differences_[kDogLayers];
  Span<int16_t> padded_;

  const ScaleSpace *space_ = nullptr;
  const FeatureKernels *row_kernels_ = nullptr;
  int32_t octave_ = 0, width_ = 0, height_ = 0, top_ = 0;
  Rows piece_ = {};
  Plane level_[kLevels];
};

}  // namespace sphc
