// wall.h - a wall of a room, and what stands along it and hangs on it.
#pragma once

#include <optional>
#include <vector>

#include "drivers/simulated/builder.h"

namespace sphc::simulated {

constexpr double kDoorwayHalf = 0.5, kDoorwayHeight = 2.1;
constexpr double kCorner = 0.62;  // of a wall: the floor is kept for what stands in the corners

// A rectangle of a wall that is taken: x along the wall, z up.
struct Taken {
  double x0, x1, z0, z1;
};

struct Wall {
  Place place;  // in the middle of the wall, on the floor; y to the middle of the room, x = y cross z
  double half = 0;
  std::optional<double> doorway;  // where its middle is, x
  std::vector<Taken> taken;

  bool isFree(const Taken &r) const;
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
  kMirror,
  kBinders
};

// In the order in which they are to find room.  `with`: as in sphc_simulated_config.
std::vector<Piece> choosePieces(Rng &rng, uint32_t with);
// Stands pieces along a wall, beside its doorway, until no more fit, and takes them from the list.  `low`: none
// that is tall.  `doubles_seed`: other than 0, pieces of one kind are equal.
void furnish(Builder &builder, Wall &wall, std::vector<Piece> &pieces, bool low, uint64_t doubles_seed);
void hangPictures(Builder &builder, Wall &wall);
// Up to two prints of one poster.
void hangPosters(Builder &builder, Wall &wall, uint64_t doubles_seed);
// Skirting and moulding.
void addTrim(Builder &builder, const Wall &wall, double ceiling);

template <class T>
void shuffle(std::vector<T> &items, Rng &rng) {
  for (size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[static_cast<size_t>(rng.index(static_cast<int>(i)))]);
}

}  // namespace sphc::simulated
