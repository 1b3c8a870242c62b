#include "runtime/stages/consistency/edge_agreement.h"

#include <algorithm>

namespace sphc {
namespace {

constexpr int32_t kWindowPx = 5, kReachPx = EdgeAgreement::kWindows * kWindowPx / 2;
constexpr double kFocalOfAStep = 500;  // px: a finer image is sampled in larger steps
constexpr int32_t kFlat = 24;          // sum of three differences of grey: beneath it there is nothing to see

// The image's gradient along a line across an edge.
class Profile {
 public:
  Profile(GrayView gray, int32_t step, bool along_y) : gray_(gray), step_(step), along_y_(along_y) {}

  bool fits(int32_t x, int32_t y) const {
    const int32_t along = (kReachPx + 1) * step_, across = step_;
    const int32_t rx = along_y_ ? across : along, ry = along_y_ ? along : across;
    return x >= rx && y >= ry && x < gray_.width - rx && y < gray_.height - ry;
  }
  // Strongest gradient in a window.
  int32_t strongest(int32_t x, int32_t y, int32_t window) const {
    int32_t most = 0;
    const int32_t begin = window * kWindowPx - kReachPx;
    for (int32_t j = begin; j < begin + kWindowPx; ++j) {
      const int32_t gradient = along_y_ ? down(x, y + j * step_) : across(x + j * step_, y);
      most = std::max(most, absOf(gradient));
    }
    return most;
  }

 private:
  int32_t across(int32_t x, int32_t y) const {
    int32_t sum = 0;
    for (int32_t r = -step_; r <= step_; r += step_) {
      const uint8_t *row = gray_.row(y + r);
      sum += row[x + step_] - row[x - step_];
    }
    return sum;
  }
  int32_t down(int32_t x, int32_t y) const {
    const uint8_t *above = gray_.row(y - step_), *below = gray_.row(y + step_);
    int32_t sum = 0;
    for (int32_t r = -step_; r <= step_; r += step_) sum += below[x + r] - above[x + r];
    return sum;
  }

  GrayView gray_;
  int32_t step_;
  bool along_y_;
};

// Adds the ranks of one edge's windows; false where the image is flat.
bool addRanks(const int32_t (&strongest)[EdgeAgreement::kWindows], double *rank) {
  constexpr int32_t n = EdgeAgreement::kWindows;
  if (*std::max_element(strongest, strongest + n) < kFlat) return false;
  for (int32_t w = 0; w < n; ++w) {
    int32_t halves = -1;  // itself
    for (int32_t other = 0; other < n; ++other)
      halves += strongest[other] < strongest[w] ? 2 : strongest[other] == strongest[w] ? 1 : 0;
    rank[w] += halves / (2.0 * (n - 1));
  }
  return true;
}

}  // namespace

EdgeAgreement agreementOf(Span<const DepthEdge> edges, double depth_unit_m, GrayView gray, const Camera &color,
                          const Camera &depth, const Rigid &color_from_depth) {
  const auto step = static_cast<int32_t>(std::max(1.0, color.focal() / kFocalOfAStep + 0.5));
  // The cameras may be turned against each other by a quarter.
  const Vector3 right = color_from_depth.rotation.col(0);
  const bool turned = absOf(right.y()) > absOf(right.x());
  EdgeAgreement found;
  for (const DepthEdge &edge : edges) {
    Vector2 ray, px;
    if (!depth.unproject({edge.x_px, edge.y_px}, &ray)) continue;
    const double z = edge.near * depth_unit_m;
    if (!color.project(color_from_depth * Vector3(z * ray.x(), z * ray.y(), z), &px)) continue;
    if (!(px.x() >= 0 && px.y() >= 0 && px.x() < gray.width && px.y() < gray.height)) continue;
    const auto x = static_cast<int32_t>(px.x()), y = static_cast<int32_t>(px.y());
    const Profile profile(gray, step, edge.along_y != turned);
    if (!profile.fits(x, y)) continue;
    int32_t strongest[EdgeAgreement::kWindows];
    for (int32_t w = 0; w < EdgeAgreement::kWindows; ++w) strongest[w] = profile.strongest(x, y, w);
    if (addRanks(strongest, found.rank)) ++found.edges;
  }
  for (double &rank : found.rank)
    if (found.edges) rank /= found.edges;
  return found;
}

}  // namespace sphc
