// shell.h - walls, floor and ceiling of a room.
#pragma once

#include "drivers/simulated/builder.h"
#include "drivers/simulated/wall.h"

namespace sphc::simulated {

constexpr double kWallThickness = 0.06;  // of a room of a flat: two of them are between two rooms

// Of a room alone: a box seen from inside.  `with`: as in sphc_simulated_config.
void buildClosedShell(Builder &builder, const Vec3d &half, uint32_t with);
// Of a room of a flat: slabs outside of its inner faces, with gaps where its walls have doorways.
void buildOpenShell(Builder &builder, const Vec3d &center, const Vec3d &half, const Wall (&walls)[4],
                    uint32_t with);
// What nothing is beyond: a box around a flat.
void buildBounds(Builder &builder, const Vec3d &center, const Vec3d &half);

}  // namespace sphc::simulated
