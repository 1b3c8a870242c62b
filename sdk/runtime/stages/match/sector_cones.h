// Which sectors of the map's grid of directions a cone on the sphere touches.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/stages/match/search_cone.h"

namespace sphc {

// First and last of sectors in sequence.
struct SectorRun {
  uint32_t first, last;
};

class SectorCones {
 public:
  static constexpr uint32_t kMaxSectors = kMapMaxSectorSide * kMapMaxSectorSide;
  static constexpr uint32_t kMaxRuns = kMaxSectors / 2;

  static void layout(Arena &scratch, SectorCones *cones);
  // For a grid of side x side sectors (runtime/map/sector.h) and cones of one size.
  void prepare(uint32_t side, float cone_cosine);
  // The sectors that the cone around a unit direction may touch, none that it touches left out; returns how many
  // runs, at most kMaxRuns.
  uint32_t touched(const Direction &axis, Span<SectorRun> runs) const;

 private:
  // A cone around each sector: its axis, and the cosine from which a cone around a direction touches it.
  Span<float> x_, y_, z_, least_;
  uint32_t count_ = 0;
};

}  // namespace sphc
