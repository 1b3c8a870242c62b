#include "drivers/simulated/with.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "handle.h"

namespace sphc::simulated::test {
namespace {

// The bits of names; the message of what is refused.
std::string refusal(const char *names) {
  uint32_t with = 77;
  sphc_message message{};
  EXPECT_EQ(sphc_simulated_parse_with(names, &with, &message), SPHC_E_ARGUMENT) << names;
  EXPECT_EQ(with, 77u) << "untouched";
  return message.text;
}

TEST(SimulatedWith, NamesBecomeBits) {
  uint32_t with = 77;
  EXPECT_EQ(sphc_simulated_parse_with("", &with, nullptr), SPHC_OK);
  EXPECT_EQ(with, 0u);
  EXPECT_EQ(sphc_simulated_parse_with("tiles,feet,flat", &with, nullptr), SPHC_OK);
  EXPECT_EQ(with, uint32_t{SPHC_SIMULATED_FEET | SPHC_SIMULATED_TILES | SPHC_SIMULATED_FLAT});
}

TEST(SimulatedWith, AnUnknownNameIsNamedWithTheOthers) {
  for (const char *names : {"foot", "feet,foot", "foot,feet"}) {
    EXPECT_THAT(refusal(names), testing::AllOf(testing::HasSubstr("'foot'"), testing::HasSubstr("feet,people")));
  }
  EXPECT_THAT(refusal("feet,,people"), testing::HasSubstr("''"));
  EXPECT_THAT(refusal("feet, people"), testing::HasSubstr("' people'"));
  EXPECT_EQ(sphc_simulated_parse_with(nullptr, nullptr, nullptr), SPHC_E_ARGUMENT);
}

TEST(SimulatedWith, OneFloorAndOneLight) {
  sphc_message message{};
  EXPECT_EQ(checkWith(kActors | SPHC_SIMULATED_TILES | SPHC_SIMULATED_NIGHT, &message), SPHC_OK);
  EXPECT_EQ(checkWith(SPHC_SIMULATED_CARPET | SPHC_SIMULATED_TILES, &message), SPHC_E_ARGUMENT);
  EXPECT_THAT(std::string(message.text), testing::HasSubstr("carpet,tiles; a room has one floor"));
  EXPECT_EQ(checkWith(SPHC_SIMULATED_DAY | SPHC_SIMULATED_DARK, &message), SPHC_E_ARGUMENT);
  EXPECT_THAT(std::string(message.text), testing::HasSubstr("day,dark; a room has one light"));
  EXPECT_EQ(checkWith(1u << 31, &message), SPHC_E_ARGUMENT);
}

}  // namespace
}  // namespace sphc::simulated::test
