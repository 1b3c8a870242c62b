// Eight rooms that a walk goes through, seen without paint.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "drivers/simulated/scene.h"
#include "drivers/simulated/walk.h"
#include "handle.h"

namespace sphc::simulated::test {
namespace {

constexpr double kTour_s = 150;
constexpr uint64_t kFlats = 12;

Scene flatOf(uint64_t seed, uint32_t with = 0, std::vector<Job> *jobs_out = nullptr) {
  sphc_simulated_config config = defaults();
  config.seed = seed;
  config.with = with | SPHC_SIMULATED_FLAT;
  std::vector<Job> jobs;
  Scene scene = buildScene(config, jobs);
  if (jobs_out) *jobs_out = std::move(jobs);
  return scene;
}

bool isIn(const RoomPlan &room, const Vec3d &point) {
  return std::fabs(point.x - room.center.x) < room.half.x && std::fabs(point.y - room.center.y) < room.half.y;
}

// Rooms in the order in which a lap comes into them.
std::vector<size_t> visitedIn(const Scene &scene, const Walk &walk, double begin_s) {
  std::vector<size_t> visited;
  for (double time_s = begin_s; time_s < begin_s + kTour_s; time_s += 0.1) {
    for (size_t i = 0; i < scene.plan.rooms.size(); ++i) {
      if (!isIn(scene.plan.rooms[i], walk.at(time_s).center)) continue;
      if (visited.empty() || visited.back() != i) visited.push_back(i);
    }
  }
  return visited;
}

TEST(SimulatedFlat, ALapGoesThroughAllRoomsAndTouchesNothing) {
  for (uint64_t seed = 1; seed <= kFlats; ++seed) {
    const Scene scene = flatOf(seed);
    ASSERT_EQ(scene.plan.rooms.size(), 8u);
    const Walk walk(scene, seed, kTour_s, false);
    EXPECT_GT(walk.clearance(), 0.25f) << seed;
    for (const double begin_s : {0.0, kTour_s}) {
      const std::vector<size_t> visited = visitedIn(scene, walk, begin_s);
      EXPECT_EQ(std::set<size_t>(visited.begin(), visited.end()).size(), 8u) << seed;
      const size_t step = (visited[1] + 8 - visited[0]) % 8;
      EXPECT_TRUE(step == 1 || step == 7) << seed;
      for (size_t i = 1; i < visited.size(); ++i)
        EXPECT_EQ((visited[i] + 8 - visited[i - 1]) % 8, step) << "it turned round, seed " << seed;
    }
  }
}

TEST(SimulatedFlat, TheWalkIsAsSmoothAsOneOfARoom) {
  for (uint64_t seed = 1; seed <= kFlats; ++seed) {
    const Scene scene = flatOf(seed);
    const Walk walk(scene, seed, kTour_s, false);
    constexpr double kStep_s = 0.1;
    double turned = 0, moved = 0;
    for (double time_s = 0; time_s < 2 * kTour_s; time_s += kStep_s) {
      const Pose now = walk.at(time_s), next = walk.at(time_s + kStep_s);
      const Mat3d between = transposed(now.rotation) * next.rotation;
      const double trace = between.row[0].x + between.row[1].y + between.row[2].z;
      turned = std::max(turned, std::acos(std::min(1.0, 0.5 * (trace - 1))) / kStep_s);
      moved = std::max(moved, norm(next.center - now.center) / kStep_s);
    }
    EXPECT_LT(turned * 180 / kPi, 90) << "degrees a second, seed " << seed;
    EXPECT_LT(moved, 1.0) << "metres a second, seed " << seed;
  }
}

// Everything of a lap is seen from elsewhere in the next.
TEST(SimulatedFlat, LapTwoIsBesideLapOne) {
  const Scene scene = flatOf(1);
  const Walk walk(scene, 1, kTour_s, false);
  double apart = 0;
  int count = 0;
  for (double time_s = 0; time_s < kTour_s; time_s += 1, ++count) {
    double nearest = 1e9;
    for (double other_s = kTour_s; other_s < 2 * kTour_s; other_s += 0.1)
      nearest = std::min(nearest, norm(walk.at(time_s).center - walk.at(other_s).center));
    apart += nearest;
  }
  EXPECT_GT(apart / count, 0.05);
  EXPECT_LT(apart / count, 0.4);
}

TEST(SimulatedFlat, DoorwaysAreOpenAndLeadFromRoomToRoom) {
  for (uint64_t seed = 1; seed <= kFlats; ++seed) {
    const Scene scene = flatOf(seed);
    for (size_t i = 0; i < scene.plan.rooms.size(); ++i) {
      const RoomPlan &room = scene.plan.rooms[i], &next = scene.plan.rooms[(i + 1) % 8];
      EXPECT_LT(norm(room.out.middle - next.in.middle), 0.2) << seed << " " << i;
      for (const Doorway &doorway : {room.in, room.out}) {
        for (const double before_m : {0.0, 0.3, 0.6, 0.9}) {
          const Vec3d point = doorway.middle + doorway.inwards * before_m + Vec3d{0, 0, 1};
          EXPECT_GT(clearance(scene, toFloat(point)), 0.25f) << seed << " " << i << " " << before_m;
        }
      }
    }
  }
}

TEST(SimulatedFlat, WithDoublesTheRoomsHaveEqualPieces) {
  std::vector<Job> jobs;
  flatOf(7, SPHC_SIMULATED_DOUBLES, &jobs);
  std::map<uint64_t, int> seeds;
  int most = 0;
  for (const Job &job : jobs)
    if (job.material == Material::kCabinetDoor) most = std::max(most, ++seeds[job.seed]);
  EXPECT_GE(most, 4) << "in several rooms";
}

TEST(SimulatedFlat, OneMirrorShowsItAll) {
  const Scene scene = flatOf(7, SPHC_SIMULATED_MIRROR | SPHC_SIMULATED_WINDOW);
  EXPECT_EQ(std::count_if(scene.portals.begin(), scene.portals.end(), [](const Portal &p) { return p.mirrors; }),
            1);
  EXPECT_EQ(std::count_if(scene.portals.begin(), scene.portals.end(), [](const Portal &p) { return !p.mirrors; }),
            8);
}

}  // namespace
}  // namespace sphc::simulated::test
