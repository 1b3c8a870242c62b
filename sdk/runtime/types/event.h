// What a pose that is given does to a world that was drawn by earlier ones.
#pragma once
#include <cstdint>

namespace sphc {

using Events = uint32_t;  // bits

constexpr Events kRelocalized = 1;  // nothing was expected
constexpr Events kJumped = 2;       // not where it was expected
constexpr Events kMapChanged = 4;   // in another map than the one expected

}  // namespace sphc
