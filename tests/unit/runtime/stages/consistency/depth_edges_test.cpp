#include "runtime/stages/consistency/depth_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/arena_memory.h"

namespace sphc {
namespace {

constexpr int32_t kWidth = 320, kHeight = 240, kEdge = 100;
constexpr uint16_t kNear = 1000, kFar = 2000;

// A wall before another, whose border `ramp` pixels are smeared over.
struct MadeEdge {
  int32_t ramp;
  bool along_y, near_is_first;

  uint16_t at(int32_t i) const {
    const double share = ramp ? std::clamp((i + 0.5 - kEdge) / ramp + 0.5, 0.0, 1.0) : (i < kEdge ? 0 : 1);
    return static_cast<uint16_t>(kNear + (kFar - kNear) * (near_is_first ? share : 1 - share));
  }
  std::vector<uint16_t> image() const {
    std::vector<uint16_t> depth;
    for (int32_t y = 0; y < kHeight; ++y)
      for (int32_t x = 0; x < kWidth; ++x) depth.push_back(at(along_y ? y : x));
    return depth;
  }
};

class Edges {
 public:
  Edges()
      : memory_(
            [this](Arena &arena, bool has_memory) { DepthEdges::layout(arena, has_memory ? &edges_ : nullptr); }) {}
  Span<const DepthEdge> find(const std::vector<uint16_t> &depth) {
    edges_.find({depth.data(), kWidth, kHeight, kWidth}, {0.001, 0.25, 6, 0.004, 0.002});
    return edges_.edges();
  }

 private:
  DepthEdges edges_;
  test::ArenaMemory memory_;
};

TEST(DepthEdges, LieWhereTheNearSideEndsHoweverSmoothTheyAre) {
  Edges edges;
  for (const int32_t ramp : {0, 2, 3, 6})
    for (const bool along_y : {false, true})
      for (const bool near_is_first : {false, true}) {
        const Span<const DepthEdge> found = edges.find(MadeEdge{ramp, along_y, near_is_first}.image());
        EXPECT_GE(found.size(), 20u) << ramp;
        for (const DepthEdge &edge : found) {
          EXPECT_EQ(edge.along_y, along_y);
          EXPECT_NEAR(along_y ? edge.y_px : edge.x_px, kEdge, ramp ? 1 : 0) << ramp << along_y << near_is_first;
          EXPECT_EQ(edge.near, kNear) << ramp;
        }
      }
}

TEST(DepthEdges, AreOnNoSurfaceThatIsSlanted) {
  Edges edges;
  EXPECT_TRUE(edges.find(MadeEdge{40, false, true}.image()).empty());
}

}  // namespace
}  // namespace sphc
