// Rows of the pose kernels in memory of their own.
#pragma once
#include "runtime/stages/pose/kernels.h"
#include "tests/support/arena_memory.h"
#include "tests/support/pose_world.h"

namespace sphc::test {

struct OwnedRows {
  explicit OwnedRows(uint32_t capacity)
      : memory(
            [&](Arena &arena, bool real) { PoseRows::layout("rows", capacity, arena, real ? &rows : nullptr); }) {}
  // Set and padded, but not prepared.
  explicit OwnedRows(const std::vector<Correspondence> &correspondences)
      : OwnedRows(static_cast<uint32_t>(correspondences.size())) {
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
};

}  // namespace sphc::test
