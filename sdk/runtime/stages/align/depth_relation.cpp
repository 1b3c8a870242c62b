#include "runtime/stages/align/depth_relation.h"

namespace sphc {
namespace {

// Points of one surface share their errors, so each counts as part of an independent one.
constexpr double kTrust = 0.1;
constexpr double kGate2 = 9;         // squared sigmas; beyond, the two have measured different surfaces
constexpr double kForgotten = 1e-3;  // a frame, of what was learnt: sensors warm up

}  // namespace

void DepthRelation::init(double mid_m, const Vector2 &sigma) {
  mid_m_ = mid_m;
  offset_m_ = slope_ = 0;
  prior_ = now_ = {sigma[0] * sigma[0], 0, sigma[1] * sigma[1]};
}

void DepthRelation::nextFrame() {
  now_.offset += kForgotten * (prior_.offset - now_.offset);
  now_.shared -= kForgotten * now_.shared;
  now_.slope += kForgotten * (prior_.slope - now_.slope);
}

DepthRelation::Difference DepthRelation::at(double beyond) const {
  const double offset = now_.offset + beyond * now_.shared, slope = now_.shared + beyond * now_.slope;
  return {offset_m_ + slope_ * beyond, offset, slope, offset + beyond * slope};
}

void DepthRelation::learn(const Measured &first, const Measured &second) {
  const Difference d = at(second.z_m - mid_m_);
  const double surprise = first.z_m - second.z_m - d.mean;
  const double noise = first.sigma_m * first.sigma_m + second.sigma_m * second.sigma_m;
  if (surprise * surprise > kGate2 * (d.variance + noise)) return;
  const double share = 1 / (d.variance + noise / kTrust);
  offset_m_ += share * d.offset_spread * surprise;
  slope_ += share * d.slope_spread * surprise;
  now_.offset -= share * d.offset_spread * d.offset_spread;
  now_.shared -= share * d.offset_spread * d.slope_spread;
  now_.slope -= share * d.slope_spread * d.slope_spread;
}

DepthRelation::Measured DepthRelation::asFirst(const Measured &second) const {
  const Difference d = at(second.z_m - mid_m_);
  return {second.z_m + d.mean, hypotOf(second.sigma_m, sqrtOf(d.variance > 0 ? d.variance : 0))};
}

}  // namespace sphc
