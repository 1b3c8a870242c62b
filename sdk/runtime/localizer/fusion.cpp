#include "runtime/localizer/fusion.h"

#include <algorithm>

#include "runtime/stages/pose/confidence.h"

namespace sphc {

void Fusion::layout(uint32_t capacity, Arena &state, Fusion *fusion) {
  History::layout(capacity, state, fusion ? &fusion->history_ : nullptr);
}

void Fusion::advance(const Tracker &tracker) {
  Rigid step;
  double rotation_sigma_rad = 0, translation_sigma_m = 0;
  if (tracker.step(&step, &rotation_sigma_rad, &translation_sigma_m))
    history_.advance(step, rotation_sigma_rad, translation_sigma_m);
  else
    history_.clear();
}

uint32_t Fusion::mapToRemember(const MapOrder &order) const {
  const bool likely = std::find(order.begin(), order.end(), map_) != order.end();
  return likely && history_.frames() > 0 ? map_ : order[0];
}

bool Fusion::remember(uint32_t map, const MatchSet &matched) {
  if (map != map_) history_.clear();
  map_ = map;
  for (uint32_t i = 0; i < matched.matches().size(); ++i) {
    const Correspondence &c = matched.ofThisFrame()[i];
    if (c.lifted.hasDepth()) history_.add(c.lifted, matched.matches()[i].point_index, c.quality);
  }
  return history_.frames() > 1;
}

void Fusion::addTo(const MapView &map, MatchSet *matched) const {
  const Span<const Match> own = matched->matches();
  for (const OldMatch &old : history_.matches()) {
    if (!own.empty() && old.age == 0) continue;  // this frame's, and it speaks for itself
    const auto is_same = [&](const Match &match) { return match.point_index == old.point_index; };
    if (std::none_of(own.begin(), own.end(), is_same))
      matched->add({old.lifted, directionOf(map, old.point_index), old.quality});
  }
}

void Fusion::widenByDrift(double share_of_earlier, Estimate *estimate) const {
  double turn_sigma_rad, shift_sigma_m;
  history_.driftOfEarlier(&turn_sigma_rad, &shift_sigma_m);
  widen(share_of_earlier * turn_sigma_rad, share_of_earlier * shift_sigma_m, estimate);
}

}  // namespace sphc
