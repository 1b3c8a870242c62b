// A place whose left and right are changed, in a map with fakes that are mirrored pieces of it.
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/capi/translate.h"
#include "runtime/localizer/localizer.h"
#include "runtime/stages/features/mirrored_descriptor.h"
#include "tests/support/arena_memory.h"
#include "tests/unit/runtime/localizer/room_points.h"

namespace sphc {
namespace {

const Vector3 kCentre(0, 0, 1);

Vector3 directionOf(const test::WorldPoint &point) { return (point.position_m - kCentre).normalized(); }

// The points of a cone of 10 degrees, the one with most of them.
std::vector<test::WorldPoint> spotOf(const std::vector<test::WorldPoint> &points) {
  std::vector<test::WorldPoint> spot;
  for (const test::WorldPoint &middle : points) {
    std::vector<test::WorldPoint> here;
    for (const test::WorldPoint &point : points)
      if (directionOf(point).dot(directionOf(middle)) > 0.985) here.push_back(point);
    if (here.size() > spot.size()) spot = here;
  }
  return spot;
}

// All points of the room, and one spot of them again, left and right changed.
std::vector<test::SceneMap> mapWithMirroredSpot() {
  std::vector<test::WorldPoint> points = test::pointsOfTheRoom();
  for (test::WorldPoint point : spotOf(points)) {
    const Vector3 from_centre_m = point.position_m - kCentre;
    const Vector3 across_m(-from_centre_m.x(), from_centre_m.y(), from_centre_m.z());
    points.push_back({kCentre + across_m, mirrored(point.descriptor)});
  }
  return test::mapOf(points, kCentre);
}

template <typename Pixel>
void turnOver(std::vector<Pixel> *image, uint32_t width) {
  for (auto row = image->begin(); row != image->end(); row += width) std::reverse(row, row + width);
}

void turnOver(sphc_rig *rig) {
  for (sphc_camera *camera : {&rig->color_camera, &rig->depth_camera})
    camera->params[2] = camera->width - camera->params[2];
  sphc_rigid &pose = rig->color_from_depth;  // x -> -x on both sides
  pose.q_wxyz[2] = -pose.q_wxyz[2];
  pose.q_wxyz[3] = -pose.q_wxyz[3];
  pose.t_m[0] = -pose.t_m[0];
}

class LocalizerMirrorTest : public testing::Test {
 protected:
  LocalizerResult localize(bool is_turned_over) {
    sphc_localizer_config config = test::sceneConfig();
    const auto frame = test::sceneFrame(config, 0);
    if (is_turned_over) {
      turnOver(&config.rig);
      turnOver(&frame->images.gray, config.rig.color_camera.width);
      turnOver(&frame->images.depth_mm, config.rig.depth_camera.width);
    }
    const LocalizerConfig own = localizerConfigFrom(config);
    Localizer localizer;
    test::ArenaMemory memory(
        [&](Arena &arena, bool real) { Localizer::layout(own, arena, arena, real ? &localizer : nullptr); });
    localizer.init(own);
    MapView view;
    EXPECT_EQ(MapView::open(map_[0].file.data(), map_[0].file.size(), kExtractorId, &view, nullptr), SPHC_OK);
    localizer.setMap(0, view);
    return localizer.process(frameFrom(frame->frame, MapSet()));
  }

  const std::vector<test::SceneMap> map_ = mapWithMirroredSpot();
};

TEST_F(LocalizerMirrorTest, AMirrorImageIsNamedAndHasNoPose) {
  const LocalizerResult result = localize(true);
  EXPECT_EQ(result.outcome, Outcome::kContradiction);
  EXPECT_EQ(result.faults, kMirrored);
}

TEST_F(LocalizerMirrorTest, ThePlaceItselfIsLocalized) {
  const LocalizerResult result = localize(false);
  EXPECT_EQ(result.outcome, Outcome::kLocalized);
  EXPECT_EQ(result.faults, Faults{0});
}

}  // namespace
}  // namespace sphc
