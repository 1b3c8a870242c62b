// The maps of a localizer, which come and go between frames.  Each has a slot as long as it is there.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/geometry/rigid.h"
#include "runtime/map/map_view.h"

namespace sphc {

constexpr uint32_t kNoMap = UINT32_MAX;  // neither the id of a map nor a slot

// Where a map lies in a frame that maps share; sigmas an axis.
struct Placement {
  bool is_known = false;
  Rigid common_from_map;
  double rotation_sigma_rad = 0, translation_sigma_m = 0;
};

class MapSet {
 public:
  // Over an arena with memory: no map is there.
  static void layout(uint32_t capacity, Arena &state, MapSet *set);

  // The slot of the map with this id; kNoMap where there is none.
  uint32_t slotOf(uint32_t id) const;
  // Adds a map, or replaces the one of this id; its slot, or kNoMap where all are taken.
  uint32_t set(uint32_t id, const MapView &view);
  void remove(uint32_t slot);
  // Holds for later releases of the map, too.
  void place(uint32_t slot, const Placement &placement) { slots_[slot].placement = placement; }
  // Of one map in the frame of another, which is what is common; not known where one of the two has none.
  Placement placementIn(uint32_t other, uint32_t slot) const;

  uint32_t count() const { return count_; }
  uint32_t slotCount() const { return static_cast<uint32_t>(slots_.size()); }
  bool isTaken(uint32_t slot) const { return slots_[slot].id != kNoMap; }
  uint32_t idOf(uint32_t slot) const { return slots_[slot].id; }
  const MapView &view(uint32_t slot) const { return slots_[slot].view; }

 private:
  struct Slot {
    MapView view;
    uint32_t id = kNoMap;
    Placement placement;
  };

  Span<Slot> slots_;  // in state
  uint32_t count_ = 0;
};

}  // namespace sphc
