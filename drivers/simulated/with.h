// with.h - what makes the world hard, by name: feet, people, tiles ...
#pragma once

#include "drivers/simulated/simulated.h"

namespace sphc::simulated {

constexpr uint32_t kFloors = SPHC_SIMULATED_CARPET | SPHC_SIMULATED_PARQUET | SPHC_SIMULATED_TILES;
constexpr uint32_t kLights = SPHC_SIMULATED_DAY | SPHC_SIMULATED_NIGHT | SPHC_SIMULATED_DARK;
constexpr uint32_t kActors = SPHC_SIMULATED_HANDS | SPHC_SIMULATED_FEET | SPHC_SIMULATED_PEOPLE;

// ARGUMENT: a bit that is none, two floors, two lights.
sphc_status checkWith(uint32_t with, sphc_message *message);

}  // namespace sphc::simulated
