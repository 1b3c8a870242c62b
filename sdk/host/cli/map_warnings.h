// What `spherecloud map` warns of.
#pragma once
#include "host/cli/common/console.h"
#include "host/cli/map_outcome.h"

namespace sphc::host {

void warnOfMap(const MapOutcome &outcome, const Console &console);
// Which stretches have no place, and what was measured there.
void noteStretchesLeftOut(const MapOutcome &outcome, const Console &console);

}  // namespace sphc::host
