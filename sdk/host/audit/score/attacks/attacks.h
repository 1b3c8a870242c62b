// The attacks that an audit runs, in the order in which it tells them.  A new one is a file beside this, and a line
// here and in the list.
#pragma once
#include <vector>

#include "host/audit/score/attack.h"

namespace sphc::host {

Attack fileAttack();
Attack fileCuesAttack();
Attack densityAttack();
Attack realOrFakeAttack();
Attack inversionAttack();
Attack triangulationAttack();
Attack intersectionAttack();
Attack intersectionGainAttack();
Attack queryingClientAttack();
Attack turnedClientAttack();
Attack presenceAttack();
Attack photosAttack();
Attack photoSpreadAttack();

inline std::vector<Attack> allAttacks() {
  return {fileAttack(),           fileCuesAttack(),      densityAttack(),      realOrFakeAttack(),
          inversionAttack(),      triangulationAttack(), intersectionAttack(), intersectionGainAttack(),
          queryingClientAttack(), turnedClientAttack(),  presenceAttack(),     photosAttack(),
          photoSpreadAttack()};
}

}  // namespace sphc::host
