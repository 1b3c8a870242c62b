// The lossless depth codecs, on images that are hard on them.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "host/recording/mcap/depth_rvl.h"
#include "host/recording/mcap/depth_zstd.h"

namespace sphc::recording {

namespace {

using Depth = std::vector<uint16_t>;

Depth made(size_t count, const std::function<uint32_t(size_t)> &pixel) {
  Depth depth(count);
  for (size_t i = 0; i < count; ++i) depth[i] = static_cast<uint16_t>(pixel(i));
  return depth;
}

std::vector<Depth> hardImages() {
  std::mt19937 random(7);
  std::vector<Depth> images = {{},
                               {0},
                               {1},
                               {65535},
                               made(1000, [](size_t) { return 0; }),
                               made(1000, [](size_t) { return 65535; }),
                               made(1001, [](size_t i) { return i % 2 ? 65535 : 0; }),
                               made(1001, [](size_t i) { return i % 2 ? 65535 : 1; }),
                               made(1003, [](size_t i) { return i % 3 ? 32768 + i : 0; }),
                               made(65536, [](size_t i) { return i; }),
                               made(65536, [](size_t i) { return 65535 - i; })};
  for (int k = 0; k < 20; ++k) images.push_back(made(999, [&](size_t) { return random(); }));
  for (int k = 0; k < 20; ++k) images.push_back(made(999, [&](size_t) { return random() % 3 ? 0 : random(); }));
  return images;
}

TEST(DepthRvl, GivesBackEveryImageWithinItsBound) {
  for (const Depth &image : hardImages()) {
    Bytes encoded(rvlMostBytes(image.size()) + 1, 0xAB);
    const size_t bytes = encodeRvl(image.data(), image.size(), encoded.data());
    ASSERT_LE(bytes, rvlMostBytes(image.size()));
    EXPECT_EQ(encoded.back(), 0xAB);
    Depth back(image.size());
    ASSERT_TRUE(decodeRvl({encoded.data(), bytes}, back.data(), back.size()));
    EXPECT_EQ(back, image);
  }
}

// Counts by hand: 2 holes, 3 measured: 5, then +1, -1; the paper's nibbles, first on top of a little-endian word.
TEST(DepthRvl, WritesTheBytesOfThePaper) {
  const Depth image = {0, 0, 5, 6, 5};
  Bytes encoded(rvlMostBytes(image.size()));
  encoded.resize(encodeRvl(image.data(), image.size(), encoded.data()));
  // 2, 3, zigzag(5) = 10 = nibbles 2 | more, 1; zigzag(1) = 2; zigzag(-1) = 1; padding
  EXPECT_EQ(encoded, (Bytes{0x00, 0x21, 0xA1, 0x23}));
}

TEST(DepthRvl, RefusesWhatIsTooShortOrTooMuch) {
  const Depth image = made(100, [](size_t i) { return 100 + i * i; });
  Bytes encoded(rvlMostBytes(image.size()));
  encoded.resize(encodeRvl(image.data(), image.size(), encoded.data()));
  Depth back(101);
  EXPECT_TRUE(decodeRvl(viewOf(encoded), back.data(), 100));
  EXPECT_FALSE(decodeRvl(viewOf(encoded), back.data(), 99)) << "more pixels than asked for";
  EXPECT_FALSE(decodeRvl(viewOf(encoded), back.data(), 101));
  EXPECT_FALSE(decodeRvl({encoded.data(), encoded.size() - 4}, back.data(), 100));
  EXPECT_FALSE(decodeRvl({}, back.data(), 100));
  const Bytes nothing_for_ever(4000, 0x00);
  EXPECT_FALSE(decodeRvl(viewOf(nothing_for_ever), back.data(), 100));
  const Bytes endless_number(64, 0xFF);
  EXPECT_FALSE(decodeRvl(viewOf(endless_number), back.data(), 100));
}

TEST(DepthZstd, GivesBackEveryImageWithinItsBound) {
  DepthZstdEncoder encoder(65536);
  DepthZstdDecoder decoder;
  for (const Depth &image : hardImages()) {
    Bytes encoded(DepthZstdEncoder::mostBytes(image.size()));
    const size_t bytes = encoder.encode(image.data(), image.size(), encoded.data(), encoded.size());
    ASSERT_GT(bytes, 0u);
    Depth back(image.size());
    ASSERT_TRUE(decoder.decode({encoded.data(), bytes}, back.data(), back.size()));
    EXPECT_EQ(back, image);
  }
}

// From every last pixel to every next one.
TEST(DepthZstd, EveryStepHasACodeOfItsOwn) {
  DepthZstdEncoder encoder(131072);
  DepthZstdDecoder decoder;
  for (const size_t last : std::vector<size_t>{1, 2, 77, 32767, 32768, 32769, 65534, 65535}) {
    const Depth image = made(131072, [&](size_t i) { return i % 2 ? i / 2 : last; });
    Bytes encoded(DepthZstdEncoder::mostBytes(image.size()));
    const size_t bytes = encoder.encode(image.data(), image.size(), encoded.data(), encoded.size());
    Depth back(image.size());
    ASSERT_TRUE(decoder.decode({encoded.data(), bytes}, back.data(), back.size()));
    EXPECT_EQ(back, image) << last;
  }
}

TEST(DepthZstd, RefusesWhatIsTooShortOrTooMuch) {
  DepthZstdEncoder encoder(100);
  DepthZstdDecoder decoder;
  const Depth image = made(100, [](size_t i) { return 100 + i * i; });
  Bytes encoded(DepthZstdEncoder::mostBytes(100));
  encoded.resize(encoder.encode(image.data(), 100, encoded.data(), encoded.size()));
  Depth back(101);
  EXPECT_TRUE(decoder.decode(viewOf(encoded), back.data(), 100));
  EXPECT_FALSE(decoder.decode(viewOf(encoded), back.data(), 99));
  EXPECT_FALSE(decoder.decode(viewOf(encoded), back.data(), 101));
  EXPECT_FALSE(decoder.decode({encoded.data(), encoded.size() - 1}, back.data(), 100));
  EXPECT_FALSE(decoder.decode({}, back.data(), 100));
}

}  // namespace

}  // namespace sphc::recording
