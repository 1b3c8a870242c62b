#include "runtime/map/packed_direction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/map/map_view.h"
#include "runtime/stages/features/extractor.h"
#include "tests/support/map_bytes.h"
#include "tests/support/random_numbers.h"

namespace sphc {
namespace {

TEST(PackedDirection, EveryCodeUnpacksToAUnitVector) {
  for (uint32_t u = 1; u < 65536; u += 127)
    for (uint32_t v = 1; v < 65536; v += 131) {
      const Direction d = unpackDirection({static_cast<uint16_t>(u), static_cast<uint16_t>(v)});
      const double norm2 = static_cast<double>(d.x) * static_cast<double>(d.x) +
                           static_cast<double>(d.y) * static_cast<double>(d.y) +
                           static_cast<double>(d.z) * static_cast<double>(d.z);
      ASSERT_NEAR(norm2, 1, 1e-6) << u << " " << v;
    }
}

TEST(PackedDirection, AxesAndCorners) {
  const auto unpacked = [](uint16_t u, uint16_t v) {
    const Direction d = unpackDirection({u, v});
    return Vector3(static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z));
  };
  EXPECT_EQ(unpacked(32768, 32768), Vector3(0, 0, 1));
  EXPECT_EQ(unpacked(65535, 32768), Vector3(1, 0, 0));
  EXPECT_EQ(unpacked(1, 32768), Vector3(-1, 0, 0));
  EXPECT_EQ(unpacked(32768, 1), Vector3(0, -1, 0));
  for (uint16_t u : {uint16_t{1}, uint16_t{65535}})
    for (uint16_t v : {uint16_t{1}, uint16_t{65535}}) EXPECT_EQ(unpacked(u, v), Vector3(0, 0, -1));
}

TEST(PackedDirection, QuantisationLosesAtMostWhatTheFormatSays) {
  Random random(2);
  std::vector<test::MapPoint> points;
  for (int i = 0; i < 20000; ++i) {
    test::MapPoint point = {test::randomDirection(&random), {}};
    if (i < 200) point.direction = (Vector3(0, 0, -1) + 1e-3 * test::normalVector(&random)).normalized();
    points.push_back(point);
  }
  const std::vector<uint8_t> file = test::encodeMap(points, kExtractorId);
  MapView view;
  ASSERT_EQ(MapView::open(file.data(), file.size(), kExtractorId, &view, nullptr), SPHC_OK);
  double worst = 0;
  for (uint32_t i = 0; i < view.pointCount(); ++i) {
    const Direction d = view.direction(i);
    worst = std::max(worst, (Vector3(static_cast<double>(d.x), static_cast<double>(d.y), static_cast<double>(d.z)) -
                             points[i].direction)
                                .norm());
  }
  EXPECT_LT(worst, 0.07e-3);
  EXPECT_GT(worst, 0.05e-3);  // the bound is no idle one
}

}  // namespace
}  // namespace sphc
