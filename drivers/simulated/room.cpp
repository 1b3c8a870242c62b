#include "drivers/simulated/room.h"

#include <algorithm>

#include "drivers/simulated/furniture.h"
#include "drivers/simulated/with.h"

namespace sphc::simulated {
namespace {

constexpr double kQuarter = 1.5707963267948966;
constexpr double kCorner = 0.62;     // floor kept for what stands in the corners
constexpr double kHangingTop = 2.5;  // nothing hangs higher

// A rectangle of a wall that is taken: x along the wall, z up.
struct Taken {
  double x0, x1, z0, z1;
};

struct Wall {
  Place place;  // in the middle of the wall, on the floor
  double half = 0;
  std::vector<Taken> taken;

  bool isFree(const Taken &r) const {
    return std::none_of(taken.begin(), taken.end(),
                        [&](const Taken &t) { return r.x0 < t.x1 && r.x1 > t.x0 && r.z0 < t.z1 && r.z1 > t.z0; });
  }
};

enum class Piece {
  kSofa,
  kShelf,
  kShelfSmall,
  kCabinet,
  kDresser,
  kTv,
  kDesk,
  kDining,
  kDoor,
  kBoxes,
  kArmchair,
  kMirror
};

struct PieceSize {
  double width, height;
};
PieceSize sizeOf(Piece piece) {
  switch (piece) {
    case Piece::kSofa:
      return {2.05, 0.95};
    case Piece::kShelf:
      return {1.7, 2.2};
    case Piece::kShelfSmall:
      return {1.1, 1.6};
    case Piece::kCabinet:
      return {1.5, 1.25};
    case Piece::kDresser:
      return {1.0, 1.35};
    case Piece::kTv:
      return {1.6, 1.4};
    case Piece::kDesk:
      return {1.3, 1.3};
    case Piece::kDining:
      return {2.1, 1.1};
    case Piece::kDoor:
      return {1.06, 2.2};
    case Piece::kBoxes:
      return {0.75, 1.0};
    case Piece::kArmchair:
      return {0.95, 0.95};
    case Piece::kMirror:
      return {1.2, 2.2};
  }
  return {1, 1};
}

void addPiece(Builder &b, Piece piece, const Place &place) {
  switch (piece) {
    case Piece::kSofa:
      return addSofa(b, place, 2.05);
    case Piece::kShelf:
      return addBookshelf(b, place, 1.66, b.rng().real(1.75, 2.0));
    case Piece::kShelfSmall:
      return addBookshelf(b, place, 1.06, b.rng().real(1.1, 1.4));
    case Piece::kCabinet:
      return addCabinet(b, place, 1.44, b.rng().real(0.75, 0.95), 3, 1 + b.rng().index(2));
    case Piece::kDresser:
      return addCabinet(b, place, 0.94, b.rng().real(0.9, 1.1), 1 + b.rng().index(2), 4);
    case Piece::kTv:
      return addTvBench(b, place, 1.55);
    case Piece::kDesk:
      return addDesk(b, place, 1.25);
    case Piece::kDining:
      return addDiningSet(b, place);
    case Piece::kDoor:
      return addDoor(b, place);
    case Piece::kBoxes:
      return addBoxes(b, place);
    case Piece::kArmchair:
      return addSofa(b, place, 0.92);
    case Piece::kMirror:
      return addMirror(b, place, 1.1, 2.05);
  }
}

template <class T>
void shuffle(std::vector<T> &items, Rng &rng) {
  for (size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[static_cast<size_t>(rng.index(static_cast<int>(i)))]);
}

// Stands pieces along a wall from one corner to the other until no more fit, and spreads the gaps.
// Tall ones keep away from the wall with the window.  `doubles_seed`: other than 0, pieces of one kind are equal.
void furnish(Builder &b, Wall &wall, std::vector<Piece> &pieces, bool low, uint64_t doubles_seed) {
  std::vector<Piece> chosen;
  double left = 2 * (wall.half - kCorner);
  for (size_t i = 0; i < pieces.size();) {
    const double width = sizeOf(pieces[i]).width + 0.08;
    if (width > left || (low && sizeOf(pieces[i]).height > 1.3)) {
      ++i;
      continue;
    }
    left -= width;
    chosen.push_back(pieces[i]);
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(i));
  }
  const double gap = left / static_cast<double>(chosen.size() + 1);
  double x = -wall.half + kCorner + gap;
  for (const Piece piece : chosen) {
    const PieceSize size = sizeOf(piece);
    const double middle = x + 0.5 * size.width + 0.04;
    const bool flat = piece == Piece::kDoor || piece == Piece::kMirror;
    const Place place = at(wall.place, middle, flat ? 0 : 0.03);
    if (doubles_seed != 0) {
      b.repeatably(hash64(doubles_seed, static_cast<uint64_t>(piece)), [&] { addPiece(b, piece, place); });
    } else {
      addPiece(b, piece, place);
    }
    wall.taken.push_back({x, x + size.width + 0.08, 0, size.height});
    x += size.width + 0.08 + gap;
  }
}

void hangPictures(Builder &b, Wall &wall) {
  Rng &rng = b.rng();
  int clocks = 0;
  for (int attempt = 0; attempt < 60; ++attempt) {
    const bool shelf = attempt < 4, clock = attempt >= 4 && attempt < 7;
    const double w = shelf ? rng.real(0.7, 1.1) : clock ? 0.36 : rng.real(0.3, 0.85);
    const double h = shelf ? 0.36 : clock ? 0.36 : rng.real(0.3, 0.85);
    const double x = rng.real(-wall.half + 0.15 + 0.5 * w, wall.half - 0.15 - 0.5 * w);
    const double z = rng.real(1.2, 2.2);
    const Taken area{x - 0.5 * w - 0.07, x + 0.5 * w + 0.07, z - 0.5 * h - 0.07, z + 0.5 * h + 0.07};
    if (area.z1 > kHangingTop || !wall.isFree(area) || (clock && clocks > 0)) continue;
    if (shelf) {
      addWallShelf(b, at(wall.place, x, 0), w, z - 0.15);
    } else if (clock) {
      addClock(b, at(wall.place, x, 0), z);
      ++clocks;
    } else {
      b.movable(at(wall.place, x, 0), 0, [&](const Place &own) { addPicture(b, own, w, h, z); });
    }
    wall.taken.push_back(area);
  }
}

// Up to two prints of one poster.
void hangPosters(Builder &b, Wall &wall, uint64_t doubles_seed) {
  constexpr double kWidth = 0.6, kHeight = 0.84, kMiddle = 1.75;
  int hung = 0;
  for (int attempt = 0; attempt < 30 && hung < 2; ++attempt) {
    const double x = b.rng().real(-wall.half + 0.5, wall.half - 0.5);
    const Taken area{x - 0.37, x + 0.37, kMiddle - 0.5 * kHeight - 0.05, kMiddle + 0.5 * kHeight + 0.05};
    if (!wall.isFree(area)) continue;
    b.repeatably(doubles_seed, [&] { addPicture(b, at(wall.place, x, 0), kWidth, kHeight, kMiddle); });
    wall.taken.push_back(area);
    ++hung;
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
  const Vec3d corners[4] = {{x, y, 0}, {-x, y, 0}, {-x, -y, 0}, {x, -y, 0}};
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

Material floorOf(uint32_t with) {
  if ((with & SPHC_SIMULATED_CARPET) != 0) return Material::kFittedCarpet;
  if ((with & SPHC_SIMULATED_PARQUET) != 0) return Material::kParquet;
  return (with & SPHC_SIMULATED_TILES) != 0 ? Material::kTiles : Material::kFloor;
}

void buildShell(Builder &b, const RoomPlan &plan, uint32_t with) {
  constexpr float kTexel = 0.0037f;
  std::vector<Material> walls{Material::kBrick,   Material::kWallpaper, Material::kPlaster,
                              Material::kPlaster, Material::kPanelling, Material::kWallpaper};
  shuffle(walls, b.rng());
  Material ceiling = Material::kCeiling;
  if ((with & SPHC_SIMULATED_BARE) != 0) {
    for (Material &wall : walls) wall = Material::kBare;
    ceiling = Material::kBare;
  }
  const Finish faces[kMaxFaces] = {{walls[0], kTexel}, {walls[1], kTexel},      {walls[2], kTexel},
                                   {walls[3], kTexel}, {floorOf(with), kTexel}, {ceiling, 0.007f}};
  b.room(plan.half, faces);
}

void addTrim(Builder &b, const Wall &wall, double ceiling) {
  b.box(wall.place, {0, 0.008, 0.05}, {wall.half, 0.008, 0.05}, {Material::kWood, 0.004f});
  b.box(wall.place, {0, 0.02, ceiling - 0.04}, {wall.half, 0.02, 0.04}, {Material::kWood, 0.004f});
}

std::vector<Piece> choosePieces(Rng &rng, uint32_t with) {
  std::vector<Piece> pieces{Piece::kSofa,    Piece::kShelf,    Piece::kDoor,   Piece::kDesk,
                            Piece::kTv,      Piece::kCabinet,  Piece::kDining, Piece::kShelfSmall,
                            Piece::kDresser, Piece::kArmchair, Piece::kBoxes};
  shuffle(pieces, rng);
  if ((with & SPHC_SIMULATED_DOUBLES) != 0) {
    // What comes first finds room: the first half of them, twice.
    pieces.resize(pieces.size() / 2);
    if (std::find(pieces.begin(), pieces.end(), Piece::kDesk) == pieces.end()) pieces[0] = Piece::kDesk;
    const std::vector<Piece> once = pieces;
    pieces.insert(pieces.end(), once.begin(), once.end());
  }
  if ((with & SPHC_SIMULATED_MIRROR) != 0) pieces.insert(pieces.begin(), Piece::kMirror);
  return pieces;
}

void hangAll(Builder &b, Wall (&walls)[4], uint32_t with, uint64_t doubles_seed) {
  if (doubles_seed != 0) {
    for (Wall &wall : walls) hangPosters(b, wall, hash64(doubles_seed, 1000));
  }
  if ((with & SPHC_SIMULATED_BARE) != 0) return;
  for (Wall &wall : walls) hangPictures(b, wall);
}

void placeCenter(Builder &b, uint32_t with) {
  Rng &rng = b.rng();
  const Place center{{rng.real(-0.15, 0.15), rng.real(-0.1, 0.1), 0}, rng.real(-0.15, 0.15)};
  if ((with & kFloors) == 0) addCarpet(b, center, rng.real(1.25, 1.5), rng.real(0.9, 1.1));
  addCoffeeTable(b, at(center, 0, 0, 0.01));
}

}  // namespace

RoomPlan layOut(Builder &b, uint32_t with) {
  Rng &rng = b.rng();
  RoomPlan plan;
  plan.half = {rng.real(2.85, 3.2), rng.real(2.4, 2.7), rng.real(1.35, 1.45)};
  const double ceiling = 2 * plan.half.z;
  const uint64_t doubles_seed = (with & SPHC_SIMULATED_DOUBLES) != 0 ? rng.next() | 1 : 0;
  buildShell(b, plan, with);
  // All of them face the room: y to the middle, x = y cross z.
  Wall walls[4];
  const Vec3d middles[4] = {{0, -plan.half.y, 0}, {plan.half.x, 0, 0}, {0, plan.half.y, 0}, {-plan.half.x, 0, 0}};
  std::vector<int> order{0, 1, 2, 3};
  for (int i = 0; i < 4; ++i) {
    walls[i].place = {middles[i], kQuarter * i};
    walls[i].half = i % 2 == 0 ? plan.half.x : plan.half.y;
    addTrim(b, walls[i], ceiling);
  }
  shuffle(order, rng);
  std::vector<Piece> pieces = choosePieces(rng, with);
  // The low pieces go to the window's wall before others claim them.
  placeWindow(b, walls[order[0]], plan, (with & SPHC_SIMULATED_WINDOW) != 0);
  for (const int i : order) furnish(b, walls[i], pieces, i == order[0], doubles_seed);
  hangAll(b, walls, with, doubles_seed);
  fillCorners(b, plan);
  placeCenter(b, with);
  addCeilingLamp(b, Place{{rng.real(-0.3, 0.3), rng.real(-0.3, 0.3), 0}, 0}, ceiling);
  plan.lamps.push_back({{0, 0, static_cast<float>(ceiling) - 0.45f}, 1, true});
  const float spread = static_cast<float>(plan.half.x) * 0.55f;
  for (const float side : {-1.0f, 1.0f}) {
    plan.lamps.push_back({{side * spread, side * 0.6f, static_cast<float>(ceiling) - 0.15f}, 0.55f, true});
  }
  return plan;
}

}  // namespace sphc::simulated
