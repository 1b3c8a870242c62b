// Which sectors of the map's grid of directions a cap on the sphere touches.
#pragma once
#include "runtime/base/arena.h"
#include "runtime/stages/match/cap.h"

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
  // For a grid of side x side sectors (runtime/map/sector.h).
  void prepare(uint32_t side);
  // The sectors that the cap may touch, none that it touches left out; returns how many runs, at most kMaxRuns.
  uint32_t touched(const Cap &cap, Span<SectorRun> runs) const;

 private:
  // A cone around each sector: its axis, and cosine and sine of its half angle.
  Span<float> x_, y_, z_, cosine_, sine_;
  uint32_t count_ = 0;
};

}  // namespace sphc
