#include "drivers/simulated/room.h"

#include <algorithm>
#include <cmath>

#include "drivers/simulated/furniture.h"
#include "drivers/simulated/shell.h"
#include "drivers/simulated/wall.h"
#include "drivers/simulated/with.h"

namespace sphc::simulated {
namespace {

constexpr double kQuarter = 1.5707963267948966;

// All of them face the room.
void placeWalls(const Vec3d &center, const Vec3d &half, Wall (&walls)[4]) {
  const Vec3d middles[4] = {{0, -half.y, 0}, {half.x, 0, 0}, {0, half.y, 0}, {-half.x, 0, 0}};
  for (int i = 0; i < 4; ++i) {
    walls[i].place = {center + middles[i], kQuarter * i};
    walls[i].half = i % 2 == 0 ? half.x : half.y;
  }
}

void placeWindow(Builder &b, Wall &wall, RoomPlan &plan, bool large) {
  const double width = b.rng().real(1.2, 1.7) * (large ? 1.3 : 1.0), reach = 0.5 * width + 0.45;
  const double x = b.rng().real(-0.7, 0.7) * (wall.half - kCorner - 0.5 * width);
  addWindow(b, at(wall.place, x, 0), width);
  wall.taken.push_back({x - reach, x + reach, 0.85, 2.5});
  plan.window = toFloat(at(wall.place, x, 0.3, 1.55).origin);
  plan.window_half_m = static_cast<float>(0.5 * width);
  plan.window_normal = toFloat(yawRotation(wall.place.yaw) * Vec3d{0, 1, 0});
}

void fillCorners(Builder &b, RoomPlan &plan) {
  const double x = plan.half.x - 0.33, y = plan.half.y - 0.33;
  const Vec3d &c = plan.center;
  const Vec3d corners[4] = {
      {c.x + x, c.y + y, 0}, {c.x - x, c.y + y, 0}, {c.x - x, c.y - y, 0}, {c.x + x, c.y - y, 0}};
  const int lamp = b.rng().index(4);
  for (int i = 0; i < 4; ++i) {
    const Place place{corners[i], kQuarter * (i + 1) + 0.5 * kQuarter};
    if (i == lamp || (i == (lamp + 2) % 4 && b.rng().chance(0.4f))) {
      addFloorLamp(b, place);
      plan.lamps.push_back({toFloat(corners[i] + Vec3d{0, 0, 1.8}), 0.35f, false});
    } else if (b.rng().chance(0.6f)) {
      b.movable(place, 0.12, [&](const Place &own) { addPlant(b, own); });
    } else {
      b.movable(at(place, 0, -0.28), 0.12, [&](const Place &own) { addBoxes(b, own); });
    }
  }
}

void hangAll(Builder &b, Wall (&walls)[4], uint32_t with, uint64_t doubles_seed) {
  if (doubles_seed != 0) {
    for (Wall &wall : walls) hangPosters(b, wall, hash64(doubles_seed, 1000));
  }
  if ((with & SPHC_SIMULATED_BARE) != 0) return;
  for (Wall &wall : walls) hangPictures(b, wall);
}

void placeCenter(Builder &b, const Vec3d &middle, uint32_t with) {
  Rng &rng = b.rng();
  const double x = rng.real(-0.15, 0.15), y = rng.real(-0.1, 0.1);
  const Place center{{middle.x + x, middle.y + y, 0}, rng.real(-0.15, 0.15)};
  if ((with & kFloors) == 0) addCarpet(b, center, rng.real(1.25, 1.5), rng.real(0.9, 1.1));
  addCoffeeTable(b, at(center, 0, 0, 0.01));
}

void hangLamps(Builder &b, RoomPlan &plan) {
  const Vec3d &c = plan.center;
  const double ceiling = 2 * plan.half.z;
  const double x = b.rng().real(-0.3, 0.3), y = b.rng().real(-0.3, 0.3);
  addCeilingLamp(b, Place{{c.x + x, c.y + y, 0}, 0}, ceiling);
  const auto lamp = [&](float to_x, float to_y, float below, float strength) {
    plan.lamps.push_back({toFloat(c) + Vec3f{to_x, to_y, static_cast<float>(ceiling) - below}, strength, true});
  };
  lamp(0, 0, 0.45f, 1);
  const float spread = static_cast<float>(plan.half.x) * 0.55f;
  for (const float side : {-1.0f, 1.0f}) lamp(side * spread, side * 0.6f, 0.15f, 0.55f);
}

// What stands and hangs in a room whose walls there are.  `window_wall`: -1 leaves it to the seed.
void fill(Builder &b, RoomPlan &plan, Wall (&walls)[4], int window_wall, uint64_t doubles_seed, uint32_t with) {
  for (Wall &wall : walls) addTrim(b, wall, 2 * plan.half.z);
  std::vector<int> order{0, 1, 2, 3};
  shuffle(order, b.rng());
  if (window_wall >= 0) std::iter_swap(order.begin(), std::find(order.begin(), order.end(), window_wall));
  std::vector<Piece> pieces = choosePieces(b.rng(), with);
  // The low pieces go to the window's wall before others claim them.
  placeWindow(b, walls[order[0]], plan, (with & SPHC_SIMULATED_WINDOW) != 0);
  for (const int i : order) furnish(b, walls[i], pieces, i == order[0], doubles_seed);
  hangAll(b, walls, with, doubles_seed);
  fillCorners(b, plan);
  placeCenter(b, plan.center, with);
  hangLamps(b, plan);
}

Doorway openDoorway(Wall (&walls)[4], const Vec3d &center, const RoomSite::Gap &gap) {
  Wall &wall = walls[gap.wall];
  const Mat3d turn = yawRotation(wall.place.yaw);
  const Vec3d along = turn * Vec3d{1, 0, 0};
  const bool is_x = gap.wall % 2 == 0;
  const double x = is_x ? (gap.world - center.x) * along.x : (gap.world - center.y) * along.y;
  wall.doorway = x;
  wall.taken.push_back({x - kDoorwayHalf - 0.2, x + kDoorwayHalf + 0.2, 0, kDoorwayHeight + 0.2});
  return {at(wall.place, x, 0).origin, turn * Vec3d{0, 1, 0}};
}

}  // namespace

const RoomPlan &FloorPlan::roomAt(const Vec3f &point) const {
  const auto outside = [&](const RoomPlan &room) {
    const float x = std::fabs(point.x - static_cast<float>(room.center.x)) - static_cast<float>(room.half.x);
    const float y = std::fabs(point.y - static_cast<float>(room.center.y)) - static_cast<float>(room.half.y);
    return std::max({x, y, 0.0f});
  };
  return *std::min_element(rooms.begin(), rooms.end(),
                           [&](const RoomPlan &a, const RoomPlan &b) { return outside(a) < outside(b); });
}

uint64_t drawDoublesSeed(Rng &rng, uint32_t with) {
  return (with & SPHC_SIMULATED_DOUBLES) != 0 ? rng.next() | 1 : 0;
}

RoomPlan layOutRoom(Builder &b, uint32_t with) {
  Rng &rng = b.rng();
  RoomPlan plan;
  plan.half = {rng.real(2.85, 3.2), rng.real(2.4, 2.7), rng.real(1.35, 1.45)};
  const uint64_t doubles_seed = drawDoublesSeed(rng, with);
  buildClosedShell(b, plan.half, with);
  Wall walls[4];
  placeWalls(plan.center, plan.half, walls);
  fill(b, plan, walls, -1, doubles_seed, with);
  return plan;
}

RoomPlan layOutRoomOfFlat(Builder &b, const RoomSite &site, uint32_t with) {
  RoomPlan plan;
  plan.center = site.center;
  plan.half = site.half;
  Wall walls[4];
  placeWalls(site.center, site.half, walls);
  plan.in = openDoorway(walls, site.center, site.in);
  plan.out = openDoorway(walls, site.center, site.out);
  buildOpenShell(b, site.center, site.half, walls, with);
  fill(b, plan, walls, site.window_wall, site.doubles_seed, with);
  return plan;
}

}  // namespace sphc::simulated
