#include "runtime/stages/features/sweep.h"

namespace sphc {
namespace {

// As many rows as the widest blur reads; and of the differences, what lies between the first and the last one's
// lag, with the rows that refinement may visit on both sides.
constexpr int32_t kRingRows = 16, kDogRows = 32;

int32_t clampRow(int32_t y, int32_t height) { return y < 0 ? 0 : (y < height ? y : height - 1); }

// What lies in both.
Rows common(Rows a, Rows b) {
  const int32_t first = a.first > b.first ? a.first : b.first, end = a.end() < b.end() ? a.end() : b.end();
  return {first, end > first ? end - first : 0};
}

}  // namespace

void Sweep::layout(const FeatureConfig &config, bool shares, Arena &scratch, Sweep *out) {
  Sweep measured;
  Sweep &self = out ? *out : measured;
  const int32_t width = firstOctaveSide(config, config.width);
  const auto ring = [&](const char *name, int32_t rows) { return takePlane(scratch, name, width, rows, rows - 1); };
  for (int32_t l = 0; l < kLevels - 1; ++l)
    if (shares || !ScaleSpace::isKept(l)) self.ring_[l] = ring("features.level_rings", kRingRows);
  self.ring_[kLevels - 1] = ring("features.level_rings", 1);  // for its difference alone
  self.source_ = ring("features.source_ring", kRingRows);
  for (Plane &plane : self.differences_) plane = ring("features.differences", kDogRows);
  // Kernels read whole vectors beyond a row's end, here beyond the last plane's.
  scratch.take<int16_t>("features.margin", 2 * kRowStep);
  self.padded_ = scratch.take<int16_t>("features.blur_row",
                                       kRowsAtOnce * static_cast<size_t>(paddedWidth(width) + 2 * kRowStep));
}

void Sweep::begin(const ScaleSpace &space, Rows piece, const FeatureKernels &kernels) {
  space_ = &space;
  row_kernels_ = &kernels;
  octave_ = space.octave();
  width_ = space.width(octave_);
  height_ = space.rows(octave_).count;
  top_ = space.rows(octave_).first;
  piece_ = piece;
  for (int32_t l = 0; l < kLevels; ++l) level_[l] = ScaleSpace::isKept(l) ? space.kept(octave_, l) : ring_[l];
  SPHC_ASSERT(lag(kLevels - 1) - lag(1) + 2 * kRefineReach + 2 + kRowsAtOnce <= kDogRows);
}

// Even, as the rows of all sweeps are made two by two.
int32_t Sweep::firstStep() const {
  const int32_t first = piece_.first - reach();
  return first > 0 ? first & ~1 : 0;
}

int16_t *Sweep::row(int32_t level, int32_t y) const {
  if (level == kSource) return source_.row(y);
  return (piece_.has(y) ? level_ : ring_)[level].row(y);
}

// Rows of a level that lead to the differences around the rows of the piece.
Rows Sweep::neededOf(int32_t level) const {
  const int32_t beyond = reach() - (level == kSource ? 0 : lag(level));
  return common({0, height_}, {piece_.first - beyond, piece_.count + 2 * beyond});
}

void Sweep::step(int32_t y) {
  const Rows source = common(neededOf(kSource), {y, kRowsAtOnce});
  for (int32_t i = source.first; i < source.end(); ++i) firstRow(i);
  if (octave_ == 0) blurInto(space_->kernel(0), kSource, 0, common(neededOf(0), {y - lag(0), kRowsAtOnce}));
  for (int32_t l = 1; l < kLevels; ++l)
    blurInto(space_->kernel(l), l - 1, l, common(neededOf(l), {y - lag(l), kRowsAtOnce}));
}

void Sweep::skim(int32_t y) {
  const Rows source = common({0, height_}, {y, kRowsAtOnce});
  for (int32_t i = source.first; i < source.end(); ++i) firstRow(i);
  blurInto(space_->skimKernel(octave_), octave_ == 0 ? kSource : 0, kScales,
           common({0, height_}, {y - skimLag(), 1}));
}

// Takes the row from the image, or every second pixel of the level with twice the base's blur.
void Sweep::firstRow(int32_t y) {
  const int32_t from = top_ + y;
  const GrayView &gray = space_->gray();
  if (octave_ > 0) {
    row_kernels_->halve_row(space_->kept(octave_ - 1, kScales).row(2 * from), level_[0].row(y), width_);
  } else if (!space_->isDoubled()) {
    row_kernels_->scale_row(gray.row(from), source_.row(y), width_);
  } else {
    const uint8_t *lower = gray.row(clampRow((from + 1) / 2, gray.height));
    row_kernels_->double_row(gray.row(from / 2), lower, source_.row(y), gray.width);
  }
}

// At most kRowsAtOnce rows; and their differences to the level below, but where that is the image or a level is
// left out.
void Sweep::blurInto(const BlurKernel &kernel, int32_t from, int32_t to, Rows rows) {
  if (rows.count == 0) return;
  BlurTask task;
  task.radius = kernel.radius;
  task.width = width_;
  task.count = rows.count;
  for (int32_t k = 0; k < 2 * kernel.radius + rows.count; ++k)
    task.rows[k] = row(from, clampRow(rows.first + k - kernel.radius, height_));
  for (int32_t k = 0; k <= kernel.radius; ++k) task.weights[k] = kernel.weights[k];
  task.padded = padded_.data();
  const bool follows = to == from + 1 && from != kSource;
  for (int32_t i = 0; i < rows.count; ++i) {
    task.out[i] = row(to, rows.first + i);
    task.difference[i] = follows ? differences_[from].row(rows.first + i) : nullptr;
  }
  row_kernels_->blur_rows(task);
}

}  // namespace sphc
