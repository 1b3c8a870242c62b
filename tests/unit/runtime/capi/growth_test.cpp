#include "runtime/capi/growth.h"

#include <gtest/gtest.h>

#include <cstring>

namespace sphc {
namespace {

// A frame as headers before and after this one might have it: the kinds below say where this library stands.
struct Later {
  uint32_t struct_size = sizeof(Later);
  uint32_t first = 1;
  double second = 2;
  uint64_t third = 3;
};
constexpr size_t kFirst = 16;                                          // struct_size, first, second
constexpr StructKind kKnowsAll = {"later", kFirst, sizeof(Later), 8};  // this library has all three
constexpr StructKind kKnowsTwo = {"later", kFirst, kFirst, 8};         // this library is the older one
static_assert(offsetof(Later, third) == kFirst && sizeof(Later) == kFirst + 8);

TEST(Growth, WhatAnOlderCallerLacksKeepsItsDefault) {
  Later from, known;
  from.struct_size = kFirst;
  from.first = 11;
  from.second = 12;
  from.third = 13;  // is not the caller's: memory behind the struct
  EXPECT_EQ(readStructBytes(kKnowsAll, "later", &from, &known, nullptr), SPHC_OK);
  EXPECT_EQ(known.struct_size, sizeof(Later));
  EXPECT_EQ(known.first, 11u);
  EXPECT_EQ(known.second, 12);
  EXPECT_EQ(known.third, 3u);
}

TEST(Growth, WhatANewerCallerLeavesZeroIsTaken) {
  Later from, known;
  from.first = 11;
  from.third = 0;
  sphc_message message = {};
  EXPECT_EQ(readStructBytes(kKnowsTwo, "later", &from, &known, &message), SPHC_OK);
  EXPECT_EQ(known.first, 11u);
  EXPECT_EQ(known.third, 3u);  // is not this library's to write

  const auto *bytes = reinterpret_cast<unsigned char *>(&from);
  for (size_t i = kFirst; i < sizeof(Later); ++i) {
    Later set = from;
    std::memcpy(&set, bytes, sizeof set);
    reinterpret_cast<unsigned char *>(&set)[i] = 1;
    EXPECT_EQ(readStructBytes(kKnowsTwo, "later", &set, &known, &message), SPHC_E_UNSUPPORTED) << i;
    EXPECT_NE(std::strstr(message.text, "newer header"), nullptr) << message.text;
  }
}

TEST(Growth, WhatIsReservedMustBeZero) {
  StructKind kind = kKnowsAll;
  kind.reserved[0] = {offsetof(Later, third), sizeof(uint64_t)};
  Later from, known;
  from.third = uint64_t{1} << 56;
  sphc_message message = {};
  EXPECT_EQ(readStructBytes(kind, "later", &from, &known, &message), SPHC_E_UNSUPPORTED);
  EXPECT_NE(std::strstr(message.text, "reserved"), nullptr) << message.text;
  from.third = 0;
  EXPECT_EQ(readStructBytes(kind, "later", &from, &known, &message), SPHC_OK);
  from.third = 9;
  from.struct_size = kFirst;  // the caller has no such field
  known.third = 0;
  EXPECT_EQ(readStructBytes(kind, "later", &from, &known, &message), SPHC_OK);
}

TEST(Growth, SizesThatNeverWereAreRefused) {
  for (uint32_t size : {0u, 8u, 15u, 17u, 20u, 4104u, 0x5A5A5A58u, UINT32_MAX}) {
    Later from, known;
    from.struct_size = size;
    sphc_message message = {};
    uint32_t checked = 0;
    EXPECT_EQ(readStructBytes(kKnowsAll, "later", &from, &known, &message), SPHC_E_STRUCT_SIZE) << size;
    EXPECT_NE(std::strstr(message.text, "sizeof(later)"), nullptr) << message.text;
    EXPECT_EQ(checkStructBytes(kKnowsAll, "later", &from, &message, &checked), SPHC_E_STRUCT_SIZE) << size;
    EXPECT_EQ(initStructBytes(kKnowsAll, &known, size, &from), SPHC_E_STRUCT_SIZE) << size;
    EXPECT_EQ(from.first, 1u);
  }
  EXPECT_EQ(readStructBytes(kKnowsAll, "later", nullptr, nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(checkStructBytes(kKnowsAll, "later", nullptr, nullptr, nullptr), SPHC_E_ARGUMENT);
  EXPECT_EQ(initStructBytes(kKnowsAll, nullptr, sizeof(Later), nullptr), SPHC_E_ARGUMENT);
}

TEST(Growth, AnOlderCallerGetsWhatItHasRoomFor) {
  const Later result;
  Later to;
  to.struct_size = kFirst;
  to.first = 77;
  to.third = 77;
  writeStructBytes(kKnowsAll, &result, to.struct_size, &to);
  EXPECT_EQ(to.struct_size, kFirst);
  EXPECT_EQ(to.first, 1u);
  EXPECT_EQ(to.third, 77u);
}

TEST(Growth, ANewerCallerGetsZeroesForWhatIsNotKnown) {
  const Later result;
  Later to;
  to.first = 77;
  to.third = 77;
  writeStructBytes(kKnowsTwo, &result, to.struct_size, &to);
  EXPECT_EQ(to.struct_size, sizeof(Later));
  EXPECT_EQ(to.first, 1u);
  EXPECT_EQ(to.third, 0u);
}

// As by another thread of a careless caller.
TEST(Growth, AStructThatChangesDuringACallIsWrittenAsFarAsItWasChecked) {
  const Later result;
  Later to;
  uint32_t checked = 0;
  to.struct_size = kFirst;
  EXPECT_EQ(checkStructBytes(kKnowsAll, "later", &to, nullptr, &checked), SPHC_OK);
  to.third = 77;
  for (uint32_t meanwhile : {0u, UINT32_MAX}) {
    to.struct_size = meanwhile;
    to.first = 77;
    writeStructBytes(kKnowsAll, &result, checked, &to);
    EXPECT_EQ(to.first, 1u);
    EXPECT_EQ(to.third, 77u);
  }
}

TEST(Growth, DefaultsFillWhatTheCallerTells) {
  const Later defaults;
  Later to;
  to.struct_size = 5;
  to.third = 77;
  EXPECT_EQ(initStructBytes(kKnowsAll, &defaults, kFirst, &to), SPHC_OK);
  EXPECT_EQ(to.struct_size, kFirst);
  EXPECT_EQ(to.third, 77u);
  EXPECT_EQ(initStructBytes(kKnowsTwo, &defaults, sizeof(Later), &to), SPHC_OK);
  EXPECT_EQ(to.struct_size, sizeof(Later));
  EXPECT_EQ(to.third, 0u);
}

}  // namespace
}  // namespace sphc
