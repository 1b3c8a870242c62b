#include "runtime/stages/pose/sampler.h"

namespace sphc {
namespace {

// A sample whose points are this close, in units of the points' spread, says little about the pose.
constexpr float kLeastSide = 0.3f;
constexpr int kTries = 4;
constexpr uint32_t kSpreadRows = 64;
// Ordered sampling starts from this share of the best and grows to all over so many samples (after PROSAC: Chum and
// Matas 2005).
constexpr uint32_t kGrowth = 256;
constexpr uint32_t kFirstShare = 4;  // a quarter

}  // namespace

void Sampler::layout(uint32_t capacity, Arena &scratch, Sampler *sampler) {
  const Span<uint32_t> order = scratch.take<uint32_t>("pose.order", capacity);
  if (sampler) sampler->order_ = order;
}

void Sampler::start(const PoseRows &rows, Span<const float> quality, uint32_t size, uint64_t seed) {
  rows_ = &rows;
  size_ = size;
  drawn_ = 0;
  random_ = Random(seed);
  sortByQuality(quality);
  // Rows come in random order: the first ones speak for all.
  const uint32_t some = rows.count < kSpreadRows ? rows.count : kSpreadRows;
  float square = 0;
  for (int k = 0; k < 3; ++k) {
    const float *x = rows.field[kPointX + k];
    float mean = 0, mean_square = 0;
    for (uint32_t i = 0; i < some; ++i) {
      mean += x[i] / static_cast<float>(some);
      mean_square += x[i] * x[i] / static_cast<float>(some);
    }
    square += mean_square - mean * mean;
  }
  least_side2_ = square > 0 ? kLeastSide * kLeastSide * square : 0.0f;
}

// Counting sort into classes of quality: the order within a class does not matter.
void Sampler::sortByQuality(Span<const float> quality) {
  constexpr uint32_t kClasses = 64;
  const uint32_t count = rows_->count;
  float low = quality[0], high = quality[0];
  for (uint32_t i = 1; i < count; ++i) {
    low = quality[i] < low ? quality[i] : low;
    high = quality[i] > high ? quality[i] : high;
  }
  ordered_ = high > low;
  if (!ordered_) {
    for (uint32_t i = 0; i < count; ++i) order_[i] = i;
    return;
  }
  uint32_t begin[kClasses + 1] = {};
  const float scale = static_cast<float>(kClasses - 1) / (high - low);
  const auto classOf = [&](uint32_t i) { return static_cast<uint32_t>((high - quality[i]) * scale); };
  for (uint32_t i = 0; i < count; ++i) ++begin[classOf(i) + 1];
  for (uint32_t c = 0; c < kClasses; ++c) begin[c + 1] += begin[c];
  for (uint32_t i = 0; i < count; ++i) order_[begin[classOf(i)]++] = i;
}

bool Sampler::isSpreadOut(const uint32_t *sample) const {
  for (uint32_t i = 0; i < size_; ++i)
    for (uint32_t j = i + 1; j < size_; ++j) {
      float square = 0;
      for (int k = 0; k < 3; ++k) {
        const float off = rows_->field[kPointX + k][sample[i]] - rows_->field[kPointX + k][sample[j]];
        square += off * off;
      }
      if (!(square > least_side2_)) return false;  // also when a point was drawn twice
    }
  return true;
}

void Sampler::draw(MinimalBatch *batch) {
  for (uint32_t lane = 0; lane < kMinimalBatch; ++lane, ++drawn_) {
    uint32_t pool = rows_->count;
    if (ordered_ && drawn_ < kGrowth) pool = pool / kFirstShare + (pool - pool / kFirstShare) * drawn_ / kGrowth;
    if (pool < 8) pool = rows_->count;
    uint32_t sample[3] = {};
    for (int attempt = 0; attempt < kTries; ++attempt) {
      for (uint32_t k = 0; k < size_; ++k) sample[k] = order_[random_.below(pool)];
      if (isSpreadOut(sample)) break;
    }
    for (uint32_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis) {
        batch->point_m[k][axis][lane] = rows_->field[kPointX + axis][sample[k]];
        batch->direction[k][axis][lane] = rows_->field[kDirectionX + axis][sample[k]];
      }
  }
}

}  // namespace sphc
