#include "drivers/simulated/flat.h"

#include "drivers/simulated/shell.h"
#include "drivers/simulated/simulated.h"

namespace sphc::simulated {
namespace {

constexpr int kColumns = 4, kRooms = 2 * kColumns;
constexpr double kOffMiddle = 0.5;  // of a doorway, at most

// Rooms of a column are equally long, those of a row equally wide.
struct Grid {
  double half_x[kColumns], half_y[2], half_z;

  explicit Grid(Rng &rng) {
    for (double &half : half_x) half = rng.real(2.85, 3.2);
    for (double &half : half_y) half = rng.real(2.4, 2.7);
    half_z = rng.real(1.35, 1.45);
  }
  Vec3d center(int column, int row) const {
    double x = 0;
    for (int c = 1; c <= column; ++c) x += half_x[c - 1] + half_x[c] + 2 * kWallThickness;
    return {x, row == 0 ? 0 : half_y[0] + half_y[1] + 2 * kWallThickness, 0};
  }
  Vec3d half(int column, int row) const { return {half_x[column], half_y[row], half_z}; }
};

// The ring: the first row to the right, the second back to the left.
int columnOf(int room) { return room < kColumns ? room : kRooms - 1 - room; }
int rowOf(int room) { return room < kColumns ? 0 : 1; }

// The walls that a room and the next one share, and where their doorway is.
struct Passage {
  int wall, wall_of_next;
  double world;
};

Passage passageAfter(int room, const Grid &grid, Rng &rng) {
  const int next = (room + 1) % kRooms;
  const Vec3d center = grid.center(columnOf(room), rowOf(room));
  const double off = rng.real(-kOffMiddle, kOffMiddle);
  if (rowOf(room) == rowOf(next)) {
    const bool right = columnOf(next) > columnOf(room);
    return {right ? 1 : 3, right ? 3 : 1, center.y + off};
  }
  const bool up = rowOf(next) > rowOf(room);
  return {up ? 2 : 0, up ? 0 : 2, center.x + off};
}

void boundFlat(Builder &b, const Grid &grid) {
  constexpr double kMargin = 1;
  const Vec3d first = grid.center(0, 0), last = grid.center(kColumns - 1, 1);
  const Vec3d low{first.x - grid.half_x[0], first.y - grid.half_y[0], 0};
  const Vec3d high{last.x + grid.half_x[kColumns - 1], last.y + grid.half_y[1], 2 * grid.half_z};
  buildBounds(b, (low + high) * 0.5, (high - low) * 0.5 + Vec3d{kMargin, kMargin, kMargin});
}

}  // namespace

FloorPlan layOutFlat(Builder &b, uint32_t with) {
  const Grid grid(b.rng());
  const uint64_t doubles_seed = drawDoublesSeed(b.rng(), with);
  Passage passages[kRooms];
  for (int room = 0; room < kRooms; ++room) passages[room] = passageAfter(room, grid, b.rng());
  boundFlat(b, grid);
  FloorPlan plan;
  for (int room = 0; room < kRooms; ++room) {
    const Passage &from = passages[(room + kRooms - 1) % kRooms], &to = passages[room];
    RoomSite site;
    site.center = grid.center(columnOf(room), rowOf(room));
    site.half = grid.half(columnOf(room), rowOf(room));
    site.window_wall = rowOf(room) == 0 ? 0 : 2;
    site.in = {from.wall_of_next, from.world};
    site.out = {to.wall, to.world};
    site.doubles_seed = doubles_seed;
    // One mirror is in the first room: each shows the whole flat once more.
    plan.rooms.push_back(layOutRoomOfFlat(b, site, room == 0 ? with : with & ~uint32_t{SPHC_SIMULATED_MIRROR}));
  }
  return plan;
}

}  // namespace sphc::simulated
