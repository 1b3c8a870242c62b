#include "drivers/simulated/with.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "drivers/simulated/config.h"

namespace sphc::simulated {
namespace {

constexpr struct {
  const char *name;
  uint32_t bit;
} kNames[] = {
    {"hands", SPHC_SIMULATED_HANDS},         {"feet", SPHC_SIMULATED_FEET},       {"people", SPHC_SIMULATED_PEOPLE},
    {"carpet", SPHC_SIMULATED_CARPET},       {"tiles", SPHC_SIMULATED_TILES},     {"bare", SPHC_SIMULATED_BARE},
    {"parquet", SPHC_SIMULATED_PARQUET},     {"doubles", SPHC_SIMULATED_DOUBLES}, {"mirror", SPHC_SIMULATED_MIRROR},
    {"window", SPHC_SIMULATED_WINDOW},       {"day", SPHC_SIMULATED_DAY},         {"night", SPHC_SIMULATED_NIGHT},
    {"dark", SPHC_SIMULATED_DARK},           {"flat", SPHC_SIMULATED_FLAT},       {"menu", SPHC_SIMULATED_MENU},
    {"wallpaper", SPHC_SIMULATED_WALLPAPER}, {"binders", SPHC_SIMULATED_BINDERS},
};

// The names of the bits that are set, with commas.
std::string namesOf(uint32_t with) {
  std::string names;
  for (const auto &entry : kNames) {
    if ((with & entry.bit) != 0) names += (names.empty() ? "" : ",") + std::string(entry.name);
  }
  return names;
}

sphc_status checkOneOf(const char *what, uint32_t with, sphc_message *message) {
  if ((with & (with - 1)) == 0) return SPHC_OK;  // none or one bit
  explain(message, "simulated: with has %s; a room has one %s: choose one of them", namesOf(with).c_str(), what);
  return SPHC_E_ARGUMENT;
}

}  // namespace

sphc_status checkWith(uint32_t with, sphc_message *message) {
  uint32_t known = 0;
  for (const auto &entry : kNames) known |= entry.bit;
  if ((with & ~known) != 0) {
    explain(message, "simulated: with is 0x%x and has bits that mean nothing; all that do are 0x%x", with, known);
    return SPHC_E_ARGUMENT;
  }
  const sphc_status floors = checkOneOf("floor", with & kFloors, message);
  return floors != SPHC_OK ? floors : checkOneOf("light", with & kLights, message);
}

}  // namespace sphc::simulated

sphc_status sphc_simulated_parse_with(const char *names, uint32_t *with, sphc_message *message) {
  using namespace sphc::simulated;
  if (names == nullptr || with == nullptr) {
    explain(message, "simulated: names or the place for their bits is null; give both");
    return SPHC_E_ARGUMENT;
  }
  uint32_t bits = 0;
  const std::string all = names;
  for (size_t begin = 0; begin < all.size();) {
    const size_t end = std::min(all.find(',', begin), all.size());
    const std::string name = all.substr(begin, end - begin);
    const auto *entry =
        std::find_if(std::begin(kNames), std::end(kNames), [&](const auto &e) { return name == e.name; });
    if (entry == std::end(kNames)) {
      explain(message, "simulated: with '%s' is unknown; there are %s", name.c_str(), namesOf(~0u).c_str());
      return SPHC_E_ARGUMENT;
    }
    bits |= entry->bit;
    begin = end + 1;
  }
  *with = bits;
  return SPHC_OK;
}
