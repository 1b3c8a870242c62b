#include "drivers/simulated/shell.h"

#include "drivers/simulated/furniture.h"
#include "drivers/simulated/simulated.h"

namespace sphc::simulated {
namespace {

constexpr float kTexel = 0.0037f, kCeilingTexel = 0.007f;
constexpr Finish kUnseen{Material::kBare, 0.05f}, kJamb{Material::kWood, 0.0037f};

struct Surfaces {
  std::vector<Material> walls;
  Material floor, ceiling;
};

Material floorOf(uint32_t with) {
  if ((with & SPHC_SIMULATED_CARPET) != 0) return Material::kFittedCarpet;
  if ((with & SPHC_SIMULATED_PARQUET) != 0) return Material::kParquet;
  return (with & SPHC_SIMULATED_TILES) != 0 ? Material::kTiles : Material::kFloor;
}

Surfaces chooseSurfaces(Builder &b, uint32_t with) {
  Surfaces surfaces{{Material::kBrick, Material::kWallpaper, Material::kPlaster, Material::kPlaster,
                     Material::kPanelling, Material::kWallpaper},
                    floorOf(with),
                    Material::kCeiling};
  shuffle(surfaces.walls, b.rng());
  if ((with & SPHC_SIMULATED_BARE) != 0) {
    for (Material &wall : surfaces.walls) wall = Material::kBare;
    surfaces.ceiling = Material::kBare;
  }
  if ((with & SPHC_SIMULATED_WALLPAPER) != 0) {
    b.newStyle();  // the paper
    for (Material &wall : surfaces.walls) wall = Material::kRepeatingWallpaper;
  }
  return surfaces;
}

// A piece of a wall, from x0 to x1 along it and z0 to z1 above the floor.
void wallPiece(Builder &b, const Wall &wall, double x0, double x1, double z0, double z1, Material material) {
  constexpr double kHalf = 0.5 * kWallThickness;
  const Vec3d center{0.5 * (x0 + x1), -kHalf, 0.5 * (z0 + z1)}, half{0.5 * (x1 - x0), kHalf, 0.5 * (z1 - z0)};
  const Finish faces[kMaxFaces] = {kJamb, kJamb, kUnseen, {material, kTexel}, kJamb, kUnseen};
  const Mat3d turn = yawRotation(wall.place.yaw);
  b.solid(Kind::kBox, wall.place.origin + turn * center, turn, half, faces);
}

void buildWall(Builder &b, const Wall &wall, double ceiling, Material material) {
  const double end = wall.half + kWallThickness;
  if (!wall.doorway) return wallPiece(b, wall, -end, end, 0, ceiling, material);
  const double left = *wall.doorway - kDoorwayHalf, right = *wall.doorway + kDoorwayHalf;
  wallPiece(b, wall, -end, left, 0, ceiling, material);
  wallPiece(b, wall, right, end, 0, ceiling, material);
  wallPiece(b, wall, left, right, kDoorwayHeight, ceiling, material);
  addDoorway(b, at(wall.place, *wall.doorway, 0), kDoorwayHalf, kDoorwayHeight);
}

}  // namespace

void buildClosedShell(Builder &b, const Vec3d &half, uint32_t with) {
  const Surfaces own = chooseSurfaces(b, with);
  const Finish faces[kMaxFaces] = {{own.walls[0], kTexel}, {own.walls[1], kTexel}, {own.walls[2], kTexel},
                                   {own.walls[3], kTexel}, {own.floor, kTexel},    {own.ceiling, kCeilingTexel}};
  b.room(half, faces);
}

void buildOpenShell(Builder &b, const Vec3d &center, const Vec3d &half, const Wall (&walls)[4], uint32_t with) {
  constexpr double kSlab = 0.05;  // half of its thickness
  const Surfaces own = chooseSurfaces(b, with);
  const double ceiling = 2 * half.z;
  const Vec3d slab{half.x + kWallThickness, half.y + kWallThickness, kSlab};
  const Place middle{center, 0};
  b.boxWithTop(middle, {0, 0, -kSlab}, slab, kUnseen, {own.floor, kTexel});
  const Finish above[kMaxFaces] = {kUnseen, kUnseen, kUnseen, kUnseen, {own.ceiling, kCeilingTexel}, kUnseen};
  b.solid(Kind::kBox, center + Vec3d{0, 0, ceiling + kSlab}, yawRotation(0), slab, above);
  for (int i = 0; i < 4; ++i) buildWall(b, walls[i], ceiling, own.walls[static_cast<size_t>(i)]);
}

void buildBounds(Builder &b, const Vec3d &center, const Vec3d &half) {
  const Finish faces[kMaxFaces] = {kUnseen, kUnseen, kUnseen, kUnseen, kUnseen, kUnseen};
  b.solid(Kind::kRoom, center, yawRotation(0), half, faces);
}

}  // namespace sphc::simulated
