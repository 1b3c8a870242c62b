#include "runtime/stages/features/extrema.h"

#include "runtime/base/elementary.h"

namespace sphc {
namespace {

constexpr int32_t kBorder = 5;           // pixels at the image's edge without keypoints
constexpr int32_t kRefineSteps = 5;      // times the fit may move to a neighbouring sample
constexpr float kEarlyThreshold = 0.8f;  // of the contrast threshold: what a sample must exceed to be refined

Derivatives derivativesAt(const Sweep &sweep, int32_t x, int32_t y, int32_t l) {
  const int16_t *rows[3][3];
  for (int32_t k = 0; k < 3; ++k) {
    for (int32_t j = 0; j < 3; ++j) rows[k][j] = sweep.difference(l + k - 1).row(y + j - 1) + x;
  }
  const auto at = [&](int32_t k, int32_t j, int32_t i) { return int32_t{rows[k + 1][j + 1][i]}; };
  const int32_t value = at(0, 0, 0), right = at(0, 0, 1), left = at(0, 0, -1), down = at(0, 1, 0),
                up = at(0, -1, 0), above = at(1, 0, 0), below = at(-1, 0, 0);
  Derivatives r;
  r.value = static_cast<float>(value);
  r.dx = 0.5f * static_cast<float>(right - left);
  r.dy = 0.5f * static_cast<float>(down - up);
  r.ds = 0.5f * static_cast<float>(above - below);
  r.dxx = static_cast<float>(right + left - 2 * value);
  r.dyy = static_cast<float>(down + up - 2 * value);
  r.dss = static_cast<float>(above + below - 2 * value);
  r.dxy = 0.25f * static_cast<float>(at(0, 1, 1) - at(0, 1, -1) - at(0, -1, 1) + at(0, -1, -1));
  r.dxs = 0.25f * static_cast<float>(at(1, 0, 1) - at(1, 0, -1) - at(-1, 0, 1) + at(-1, 0, -1));
  r.dys = 0.25f * static_cast<float>(at(1, 1, 0) - at(1, -1, 0) - at(-1, 1, 0) + at(-1, -1, 0));
  return r;
}

// The extremum of the quadratic through the derivatives: offset = -Hessian^-1 gradient (Lowe 2004, equation 3), by
// Cramer's rule.  False where the Hessian is singular.
bool solveOffset(const Derivatives &d, float offset[3]) {
  const float a = d.dyy * d.dss - d.dys * d.dys, b = d.dxs * d.dys - d.dxy * d.dss,
              c = d.dxy * d.dys - d.dxs * d.dyy;
  const float determinant = d.dxx * a + d.dxy * b + d.dxs * c;
  if (absOf(determinant) < 1e-6f) return false;
  const float inverse = -1.0f / determinant;
  const float e = d.dxx * d.dss - d.dxs * d.dxs, f = d.dxy * d.dxs - d.dxx * d.dys,
              g = d.dxx * d.dyy - d.dxy * d.dxy;
  offset[0] = (a * d.dx + b * d.dy + c * d.ds) * inverse;
  offset[1] = (b * d.dx + e * d.dy + f * d.ds) * inverse;
  offset[2] = (c * d.dx + f * d.dy + g * d.ds) * inverse;
  return true;
}

// A little over half a sample, so that a point between two samples does not go to and fro.
int32_t towards(float offset) { return offset > 0.6f ? 1 : (offset < -0.6f ? -1 : 0); }

int32_t clampLevel(int32_t level) { return level < 1 ? 1 : (level > kScales ? kScales : level); }

// The quadratic is trusted up to the neighbouring sample.
bool isNear(const float offset[3]) {
  return absOf(offset[0]) < 1.0f && absOf(offset[1]) < 1.0f && absOf(offset[2]) < 1.0f;
}

}  // namespace

void ExtremaFinder::layout(const FeatureConfig &config, Arena &scratch, ExtremaFinder *out) {
  ExtremaFinder measured;
  ExtremaFinder &self = out ? *out : measured;
  const auto width = static_cast<size_t>(firstOctaveSide(config, config.width));
  self.columns_ = scratch.take<uint16_t>("features.extrema_columns", width);
  self.threshold_ = config.contrast_threshold * kSamplesPerUnit;
  const float early = kEarlyThreshold * self.threshold_;
  self.early_threshold_ = static_cast<int16_t>(early < 32767.0f ? early : 32767.0f);
  self.edge_limit_ = (config.edge_ratio + 1.0f) * (config.edge_ratio + 1.0f) / config.edge_ratio;
}

void ExtremaFinder::step(const FeatureKernels &kernels, const Sweep &sweep, int32_t y, CandidateList *found) {
  const int32_t searched = y - sweep.reach(), width = sweep.width();
  if (!sweep.piece().has(searched) || searched < kBorder || searched >= sweep.height() - kBorder) return;
  for (int32_t l = 1; l <= kScales; ++l) {
    DogRows rows;
    for (int32_t k = 0; k < 3; ++k) {
      for (int32_t j = 0; j < 3; ++j) rows.rows[k][j] = sweep.difference(l + k - 1).row(searched + j - 1);
    }
    const uint32_t count = kernels.find_extrema(rows, early_threshold_, kBorder, width - kBorder, columns_.data());
    for (uint32_t i = 0; i < count; ++i) examine(sweep, columns_[i], searched, l, found);
  }
}

void ExtremaFinder::examine(const Sweep &sweep, int32_t x, int32_t y, int32_t level, CandidateList *found) const {
  const int32_t start = y;
  for (int32_t i = 0;; ++i) {
    const Derivatives d = derivativesAt(sweep, x, y, level);
    float offset[3];
    if (!solveOffset(d, offset)) return;
    const int32_t move_x = towards(offset[0]), move_y = towards(offset[1]);
    // An extremum just beyond the searched scales stays: the next octave sees it just beyond its own.
    const int32_t move_s = clampLevel(level + towards(offset[2])) - level;
    if (i == kRefineSteps || (move_x == 0 && move_y == 0 && move_s == 0)) {
      if (isNear(offset)) accept(sweep, d, offset, x, y, level, found);
      return;
    }
    x += move_x;
    y += move_y;
    level += move_s;
    if (x < kBorder || x >= sweep.width() - kBorder || y < kBorder || y >= sweep.height() - kBorder ||
        absOf(y - start) > kRefineReach) {
      return;
    }
  }
}

// Contrast and shape (Lowe 2004, sections 4 and 4.1).
void ExtremaFinder::accept(const Sweep &sweep, const Derivatives &d, const float offset[3], int32_t x, int32_t y,
                           int32_t level, CandidateList *found) const {
  const float response = absOf(d.value + 0.5f * (d.dx * offset[0] + d.dy * offset[1] + d.ds * offset[2]));
  const float trace = d.dxx + d.dyy, determinant = d.dxx * d.dyy - d.dxy * d.dxy;
  // negated, so that a NaN does not pass
  if (!(response >= threshold_) || !(trace * trace < edge_limit_ * determinant)) return;
  Candidate c;
  c.response = response * (1.0f / kSamplesPerUnit);
  c.x = static_cast<float>(x) + offset[0];
  c.y = static_cast<float>(sweep.top() + y) + offset[1];
  c.layer = static_cast<float>(level) + offset[2];
  // A blur of sigma leaves white noise with a standard deviation in proportion to 1 / sigma.
  c.strength = c.response * sigmaOfLayer(c.layer) * static_cast<float>(1 << sweep.octave());
  c.octave = static_cast<int8_t>(sweep.octave());
  c.level = static_cast<int8_t>(level);
  c.is_near_duplicate = false;
  found->push(c);
}

}  // namespace sphc
