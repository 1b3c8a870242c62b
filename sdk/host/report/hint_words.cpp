#include "host/report/hint_words.h"

#include <spherecloud/spherecloud.h>

namespace sphc::host {

const std::array<BitWords, 6> kHintWords = {{
    {SPHC_HINT_TOO_DARK, "too dark", "more light"},
    {SPHC_HINT_TOO_FAST, "too fast", "move slower, or expose for a shorter time"},
    {SPHC_HINT_TOO_PLAIN, "too plain", "look at something with more texture"},
    {SPHC_HINT_NO_DEPTH_IN_RANGE, "no depth in range", "step back or closer; glass and black things have no depth"},
    {SPHC_HINT_NOT_IN_MAP, "not in the map",
     "you are somewhere else, or much has changed: another map, or a newer one"},
    {SPHC_HINT_AMBIGUOUS, "ambiguous", "what is seen fits two places: look around"},
}};

std::string hintNames(uint32_t hints) { return namesOf(kHintWords, hints); }

}  // namespace sphc::host
