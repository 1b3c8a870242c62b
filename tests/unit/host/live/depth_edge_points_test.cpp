#include "host/live/depth_edge_points.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sphc::host {
namespace {

constexpr uint32_t kLine = 128, kLines = 3;
constexpr double kFocal_px = 100;

// The same row three times: nothing changes down the image.
std::vector<DepthEdgePoint> edgesOf(std::vector<uint16_t> row) {
  row.resize(kLine, row.back());
  std::vector<uint16_t> depth;
  for (uint32_t y = 0; y < kLines; ++y) depth.insert(depth.end(), row.begin(), row.end());
  std::vector<DepthEdgePoint> of_a_row;
  for (const DepthEdgePoint &edge : depthEdgePoints(depth, kLine, kLines, kFocal_px))
    if (edge.y_px == 1.5) of_a_row.push_back(edge);
  return of_a_row;
}

void expectOneEdge(const std::vector<DepthEdgePoint> &edges, double x_px, uint16_t near) {
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].x_px, x_px);
  EXPECT_EQ(edges[0].near, near);
}

TEST(DepthEdgePoints, LieBetweenTheTwoPixelsOfASharpEdge) {
  expectOneEdge(edgesOf({1000, 1000, 1000, 2000}), 3, 1000);
  expectOneEdge(edgesOf({2000, 2000, 1000}), 2, 1000);
}

TEST(DepthEdgePoints, LieInTheMiddleOfARamp) {
  expectOneEdge(edgesOf({1000, 1000, 1200, 1400, 1600, 1800, 2000}), 4.0, 1000);
  expectOneEdge(edgesOf({2000, 1800, 1600, 1400, 1200, 1000}), 3.0, 1000);
}

TEST(DepthEdgePoints, LieInTheMiddleOfASmallHoleAndNotBeyondALargeOne) {
  expectOneEdge(edgesOf({1000, 1000, 0, 0, 2000}), 3, 1000);
  EXPECT_TRUE(edgesOf({1000, 1000, 0, 0, 0, 2000}).empty());
}

TEST(DepthEdgePoints, AreNotOnFloorsNorOnSmallSteps) {
  std::vector<uint16_t> floor;
  for (double z = 1000; floor.size() < kLine; z *= 1.03)
    floor.push_back(static_cast<uint16_t>(std::min(z, 60000.0)));
  EXPECT_TRUE(edgesOf(floor).empty());
  EXPECT_TRUE(edgesOf({1000, 1000, 1090}).empty());
}

// A camera 1.5 m above the floor that looks ahead sees it to 5 m away.
TEST(DepthEdgePoints, AreNotOnTheFloorThatGlassesSee) {
  constexpr uint32_t kColumns = 64, kRows = 48;
  constexpr double kFocal = 52, kAboveFloor_m = 1.5;
  std::vector<uint16_t> depth;
  for (uint32_t y = 0; y < kRows; ++y) {
    const double z_m = kAboveFloor_m * kFocal / (y + 0.5);
    depth.insert(depth.end(), kColumns, static_cast<uint16_t>(z_m < 5 ? 1000 * z_m : 0));
  }
  EXPECT_TRUE(depthEdgePoints(depth, kColumns, kRows, kFocal).empty());
}

TEST(DepthEdgePoints, AreFoundDownTheImageToo) {
  std::vector<uint16_t> depth(size_t{kLine} * kLines, 1000);
  for (uint32_t x = 0; x < kLine; ++x) depth[2 * kLine + x] = 3000;
  const std::vector<DepthEdgePoint> edges = depthEdgePoints(depth, kLine, kLines, kFocal_px);
  ASSERT_EQ(edges.size(), kLine);
  for (uint32_t x = 0; x < kLine; ++x) {
    EXPECT_EQ(edges[x].x_px, x + 0.5);
    EXPECT_EQ(edges[x].y_px, 2);
  }
}

TEST(DepthEdgePoints, OfImagesWithoutDepthAreNone) {
  EXPECT_TRUE(depthEdgePoints(std::vector<uint16_t>(size_t{kLine} * kLines), kLine, kLines, kFocal_px).empty());
}

}  // namespace
}  // namespace sphc::host
