// What of a replayed recording takes no part.
#pragma once
#include "drivers/replay/replay.h"
#include "host/frames/damage.h"

namespace sphc::host {

Damage damageOf(const sphc_replay_info &info);
// Throws std::runtime_error.
sphc_replay_info infoOf(const sphc_replay *replay);

}  // namespace sphc::host
