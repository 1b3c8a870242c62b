#include "runtime/localizer/map_set.h"

namespace sphc {

void MapSet::layout(uint32_t capacity, Arena &state, MapSet *set) {
  const Span<Slot> slots = state.take<Slot>("localizer.maps", capacity);
  if (!set) return;
  set->slots_ = slots;
  for (Slot &slot : set->slots_) slot = {};
}

uint32_t MapSet::slotOf(uint32_t id) const {
  for (uint32_t slot = 0; slot < slotCount() && id != kNoMap; ++slot)
    if (slots_[slot].id == id) return slot;
  return kNoMap;
}

uint32_t MapSet::set(uint32_t id, const MapView &view) {
  uint32_t slot = slotOf(id);
  for (uint32_t i = 0; i < slotCount() && slot == kNoMap; ++i)
    if (!isTaken(i)) slot = i;
  if (slot == kNoMap) return kNoMap;
  if (!isTaken(slot)) ++count_;
  slots_[slot].view = view;
  slots_[slot].id = id;
  return slot;
}

Placement MapSet::placementIn(uint32_t other, uint32_t slot) const {
  const Placement &to = slots_[other].placement, &from = slots_[slot].placement;
  if (!to.is_known || !from.is_known) return {};
  return {true, to.common_from_map.inverse() * from.common_from_map,
          hypotOf(to.rotation_sigma_rad, from.rotation_sigma_rad),
          hypotOf(to.translation_sigma_m, from.translation_sigma_m)};
}

void MapSet::remove(uint32_t slot) {
  slots_[slot] = {};
  --count_;
}

}  // namespace sphc
