#include "host/mapping/told_pieces.h"

#include <gtest/gtest.h>

namespace sphc::host {
namespace {

std::vector<recording::TimedPose> posesAt(const std::vector<int64_t> &times_ms) {
  std::vector<recording::TimedPose> poses;
  for (int64_t time_ms : times_ms) poses.push_back({1000000 * time_ms, {}});
  return poses;
}

uint32_t pieceAt(const ToldPieces &pieces, int64_t time_ms) { return pieces.at(1000000 * time_ms); }

TEST(ToldPiecesTest, NothingAndOnePoseAreOnePiece) {
  EXPECT_EQ(ToldPieces({}).at(5), 0u);
  EXPECT_EQ(ToldPieces(posesAt({3})).at(5), 0u);
}

TEST(ToldPiecesTest, APauseDividesThem) {
  const ToldPieces pieces(posesAt({0, 100, 200, 700, 800, 1400, 1500}));  // half a second is none
  EXPECT_EQ(pieceAt(pieces, 800), 0u);
  EXPECT_EQ(pieceAt(pieces, 1400), 1u);
  EXPECT_EQ(pieces.at(1400000000 - 1000), 1u) << "a frame whose time was rounded";
}

TEST(ToldPiecesTest, ASlowPaceIsNoPause) {
  const ToldPieces pieces(posesAt({0, 2000, 4000, 8000, 10000, 17000}));
  EXPECT_EQ(pieceAt(pieces, 10000), 0u);
  EXPECT_EQ(pieceAt(pieces, 17000), 1u);
}

TEST(ToldPiecesTest, TimesOfAnySizeDoNotOverflow) {
  const ToldPieces pieces({{INT64_MIN, {}}, {INT64_MIN + 1, {}}, {INT64_MIN + 2, {}}, {INT64_MAX, {}}});
  EXPECT_EQ(pieces.at(INT64_MIN + 2), 0u);
  EXPECT_EQ(pieces.at(INT64_MAX), 1u);
}

}  // namespace
}  // namespace sphc::host
