#include "runtime/base/arena.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "tests/support/arena_memory.h"

namespace sphc {
namespace {

struct Layout {
  Span<uint8_t> bytes;
  Span<double> numbers;
  Span<uint32_t> none;
  Span<uint16_t> words;
};

Layout walk(Arena &arena) {
  Layout layout;
  layout.bytes = arena.take<uint8_t>("a", 3);
  layout.numbers = arena.take<double>("b", 9);
  layout.none = arena.take<uint32_t>("c", 0);
  layout.words = arena.take<uint16_t>("d", 33);
  return layout;
}

TEST(Arena, MeasuringGivesNoMemory) {
  Arena arena;
  const Layout layout = walk(arena);
  EXPECT_TRUE(arena.measuring());
  EXPECT_EQ(layout.bytes.data(), nullptr);
  EXPECT_EQ(layout.numbers.size(), 0u);
  EXPECT_EQ(arena.used(), 64u + 128u + 0u + 128u);
}

TEST(Arena, BothWalksAgreeAndPiecesAreAlignedAndApart) {
  Arena measure;
  walk(measure);
  std::vector<uint8_t> storage(measure.used() + kArenaAlignment);
  uint8_t *const start = test::alignedStart(&storage);
  Arena arena(start);
  const Layout layout = walk(arena);
  EXPECT_EQ(arena.used(), measure.used());
  EXPECT_EQ(static_cast<void *>(layout.bytes.data()), start);
  EXPECT_EQ(layout.numbers.size(), 9u);
  EXPECT_EQ(reinterpret_cast<uintptr_t>(layout.numbers.data()) % kArenaAlignment, 0u);
  EXPECT_GE(reinterpret_cast<uint8_t *>(layout.numbers.data()), layout.bytes.end());
  EXPECT_GE(reinterpret_cast<uint8_t *>(layout.words.data()), reinterpret_cast<uint8_t *>(layout.numbers.end()));
  EXPECT_LE(reinterpret_cast<uint8_t *>(layout.words.end()), start + measure.used());
  std::memset(start, 0xAB, measure.used());  // a sanitizer would object if the walk had gone too far
}

TEST(Arena, VisitorSeesEveryPieceAndTheirSumIsUsed) {
  std::vector<std::pair<std::string, size_t>> seen;
  Arena arena(
      [](void *user, const char *name, size_t bytes) {
        static_cast<std::vector<std::pair<std::string, size_t>> *>(user)->emplace_back(name, bytes);
      },
      &seen);
  walk(arena);
  ASSERT_EQ(seen.size(), 4u);
  EXPECT_EQ(seen[1].first, "b");
  size_t sum = 0;
  for (const auto &piece : seen) sum += piece.second;
  EXPECT_EQ(sum, arena.used());
}

}  // namespace
}  // namespace sphc
