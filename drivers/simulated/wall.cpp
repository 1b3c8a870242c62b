#include "drivers/simulated/wall.h"

#include <algorithm>

#include "drivers/simulated/furniture.h"
#include "drivers/simulated/simulated.h"

namespace sphc::simulated {
namespace {

constexpr double kHangingTop = 2.5;     // nothing hangs higher
constexpr double kFrame = 0.09;         // of a doorway, on each side
constexpr double kBesideDoorway = 0.2;  // where nothing stands

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
    case Piece::kBinders:
      return {1.7, 2.2};
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
    case Piece::kBinders:
      return addBinderShelf(b, place, 1.66);
  }
}

// A stretch of a wall, x along it.
struct Stretch {
  double begin, end;
};

// What the corners and the doorway leave of a wall.
std::vector<Stretch> stretchesOf(const Wall &wall, double corner, double beside_doorway) {
  const double begin = -wall.half + corner, end = wall.half - corner;
  if (!wall.doorway) return {{begin, end}};
  const double clear = kDoorwayHalf + beside_doorway;
  return {{begin, *wall.doorway - clear}, {*wall.doorway + clear, end}};
}

// From one end to the other, and spreads the gaps.
void furnishStretch(Builder &b, Wall &wall, const Stretch &stretch, std::vector<Piece> &pieces, bool low,
                    uint64_t doubles_seed) {
  std::vector<Piece> chosen;
  double left = stretch.end - stretch.begin;
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
  double x = stretch.begin + gap;
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

}  // namespace

bool Wall::isFree(const Taken &r) const {
  return std::none_of(taken.begin(), taken.end(),
                      [&](const Taken &t) { return r.x0 < t.x1 && r.x1 > t.x0 && r.z0 < t.z1 && r.z1 > t.z0; });
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
  if ((with & SPHC_SIMULATED_BINDERS) != 0) pieces.insert(pieces.begin(), 5, Piece::kBinders);
  if ((with & SPHC_SIMULATED_MIRROR) != 0) pieces.insert(pieces.begin(), Piece::kMirror);
  return pieces;
}

void furnish(Builder &b, Wall &wall, std::vector<Piece> &pieces, bool low, uint64_t doubles_seed) {
  for (const Stretch &stretch : stretchesOf(wall, kCorner, kBesideDoorway))
    furnishStretch(b, wall, stretch, pieces, low, doubles_seed);
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

void addTrim(Builder &b, const Wall &wall, double ceiling) {
  for (const Stretch &s : stretchesOf(wall, 0, kFrame)) {
    const double half = 0.5 * (s.end - s.begin);
    b.box(wall.place, {s.begin + half, 0.008, 0.05}, {half, 0.008, 0.05}, {Material::kWood, 0.004f});
  }
  b.box(wall.place, {0, 0.02, ceiling - 0.04}, {wall.half, 0.02, 0.04}, {Material::kWood, 0.004f});
}

}  // namespace sphc::simulated
