// Rows of the pose kernels in memory of their own.
#pragma once
#include <algorithm>

#include "runtime/stages/pose/kernels.h"
#include "tests/support/arena_memory.h"
#include "tests/support/pose_world.h"

namespace sphc::test {

struct OwnedRows {
  explicit OwnedRows(uint32_t capacity, bool has_centres = false)
      : memory([&](Arena &arena, bool real) {
          PoseRows::layout("rows", capacity, has_centres, arena, real ? &rows : nullptr);
        }) {}
  // Set and padded, but not prepared.
  explicit OwnedRows(const std::vector<Correspondence> &correspondences)
      : OwnedRows(static_cast<uint32_t>(correspondences.size()), haveCentres(correspondences)) {
    for (const Correspondence &c : correspondences) rows.set(rows.count++, c);
    rows.pad();
  }
  // Prepared by `kernels` as they are, uncorrected.
  OwnedRows(const std::vector<Correspondence> &correspondences, const PoseKernels &kernels)
      : OwnedRows(correspondences) {
    kernels.prepare(&rows, {0, 0, 0, 1});
  }

  PoseRows rows;
  ArenaMemory memory;

 private:
  static bool haveCentres(const std::vector<Correspondence> &correspondences) {
    return std::any_of(correspondences.begin(), correspondences.end(),
                       [](const Correspondence &c) { return !c.lifted.centre_m.isZero(); });
  }
};

}  // namespace sphc::test
