#include "host/evaluate/map_anatomy.h"

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"
#include "tests/unit/host/tiny_map.h"

namespace sphc::host {
namespace {

TEST(MapAnatomy, OfAnEvenSpiral) {
  const test::TempFolder folder;
  writeTinyMap(folder / "spiral.sphc", 3000);
  const MapFile file = openMapFile(folder / "spiral.sphc");
  const MapFacts facts = mapFacts(file, folder / "spiral.sphc");
  const MapAnatomy anatomy = dissect(file, facts);
  EXPECT_GT(anatomy.covered_percent, 99);
  EXPECT_LT(anatomy.lopsidedness, 0.01);
  // 3000 even directions are about sqrt(4 pi / 3000) apart.
  EXPECT_NEAR(anatomy.nearest_median_deg, 3.5, 0.5);
}

}  // namespace
}  // namespace sphc::host
