#include "host/guide/place_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/base/random.h"

namespace sphc::host {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::IsEmpty;
using testing::Not;

WalkFrame madeUpFrame(uint64_t seed) {
  Random random(seed);
  WalkFrame frame;
  for (int i = 0; i < 60; ++i) {
    Descriptor descriptor;
    for (uint8_t &byte : descriptor.bytes) byte = static_cast<uint8_t>(random.below(256));
    frame.descriptors.push_back(descriptor);
  }
  return frame;
}

PlaceWords wordsOfPlaces(uint32_t count) {
  PlaceWords words;
  std::vector<WalkFrame> frames;
  for (uint32_t i = 0; i < count; ++i) {
    frames.push_back(madeUpFrame(i));
    words.add(frames);
  }
  return words;
}

bool any(uint32_t) { return true; }

TEST(PlaceWordsTest, AFrameIsMostLikeItsOwnPlace) {
  const PlaceWords words = wordsOfPlaces(40);
  for (const uint32_t place : {0u, 5u, 20u, 39u}) {
    const std::vector<uint32_t> likely = words.likely(madeUpFrame(place), any, 3);
    ASSERT_FALSE(likely.empty());
    EXPECT_EQ(likely[0], place);
  }
}

TEST(PlaceWordsTest, NoneIsBesideAnotherAndNoneThatMayNotBe) {
  const PlaceWords words = wordsOfPlaces(40);
  const std::vector<uint32_t> likely = words.likely(
      madeUpFrame(20), [](uint32_t p) { return p != 20; }, 5);
  EXPECT_GE(likely.size(), 2u);
  for (size_t i = 0; i < likely.size(); ++i) {
    EXPECT_NE(likely[i], 20u);
    for (size_t j = 0; j < i; ++j) EXPECT_GE(std::max(likely[i], likely[j]) - std::min(likely[i], likely[j]), 4u);
  }
}

TEST(PlaceWordsTest, WhatIsRemovedIsForgotten) {
  PlaceWords words = wordsOfPlaces(40);
  EXPECT_THAT(words.likely(madeUpFrame(39), any, 40), Contains(39u));
  words.removeLast();
  EXPECT_THAT(words.likely(madeUpFrame(39), any, 40), AllOf(Not(IsEmpty()), Not(Contains(39u))));
}

TEST(PlaceWordsTest, BeforeThereAreWordsNothingIsLikely) {
  EXPECT_TRUE(wordsOfPlaces(3).likely(madeUpFrame(1), any, 3).empty());
}

}  // namespace
}  // namespace sphc::host
