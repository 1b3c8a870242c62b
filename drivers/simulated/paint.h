// paint.h - what a face of the room may be painted with.
#pragma once

#include "drivers/simulated/canvas.h"

namespace sphc::simulated {

enum class Material : uint8_t {
  kBrick,
  kWallpaper,
  kPlaster,
  kPanelling,
  kCeiling,
  kFloor,
  kCarpet,
  kWood,
  kCabinetDoor,
  kDoor,
  kSpine,
  kPaper,
  kFabric,
  kCurtain,
  kPicture,
  kWindow,
  kScreen,
  kCardboard,
  kCeramic,
  kLeaves,
  kLampshade,
  kMetal,
  kClock,
  kMagazine,
  kFittedCarpet,
  kParquet,
  kTiles,
  kBare,
  kMirror,
  kStreet,
  kLawn,
  kSky,
  kSkin,
  kHead,
  kShoe,
  kTrousers,
  kRepeatingWallpaper,
  kBinder,
};

// Paints the whole canvas.  `style` decides the kind of cloth or wood, which the parts of one piece share; `seed`
// the details.  The same arguments on the same canvas give the same texels.
void paint(Canvas &canvas, Material material, uint64_t style, uint64_t seed);
// Whether the surface shines by itself, so that light and shadow in the room do not change it.
bool isBright(Material material);
bool isOutdoors(Material material);

// The painters, each in the file named for its kind.
void paintBrick(Canvas &canvas, Rng &rng);
void paintWallpaper(Canvas &canvas, Rng &rng);
void paintRepeatingWallpaper(Canvas &canvas, Rng &style, Rng &rng);
void paintPlaster(Canvas &canvas, Rng &rng);
void paintCeiling(Canvas &canvas, Rng &rng);
void paintPlanks(Canvas &canvas, Rng &rng, float plank_width_m, float plank_length_m, bool upright);
void paintWood(Canvas &canvas, Rng &style, Rng &rng);
void paintCabinetDoor(Canvas &canvas, Rng &style, Rng &rng);
void paintDoor(Canvas &canvas, Rng &style, Rng &rng);
void paintCarpet(Canvas &canvas, Rng &rng);
void paintFabric(Canvas &canvas, Rng &style, Rng &rng);
void paintCurtain(Canvas &canvas, Rng &style, Rng &rng);
void paintPicture(Canvas &canvas, Rng &rng);
void paintWindow(Canvas &canvas, Rng &rng);
void paintSpine(Canvas &canvas, Rng &rng);
void paintBinder(Canvas &canvas, Rng &rng);
void paintPaper(Canvas &canvas, Rng &rng);
void paintMagazine(Canvas &canvas, Rng &rng);
void paintScreen(Canvas &canvas, Rng &rng);
void paintCardboard(Canvas &canvas, Rng &rng);
void paintCeramic(Canvas &canvas, Rng &rng);
void paintLeaves(Canvas &canvas, Rng &rng);
void paintLampshade(Canvas &canvas, Rng &rng);
void paintMetal(Canvas &canvas, Rng &rng);
void paintClock(Canvas &canvas, Rng &rng);
void paintFittedCarpet(Canvas &canvas, Rng &rng);
void paintParquet(Canvas &canvas, Rng &rng);
void paintTiles(Canvas &canvas, Rng &rng);
void paintBare(Canvas &canvas, Rng &rng);
void paintStreet(Canvas &canvas, Rng &rng);
void paintLawn(Canvas &canvas, Rng &rng);
void paintSky(Canvas &canvas);
void paintSkin(Canvas &canvas, Rng &rng);
void paintHead(Canvas &canvas, Rng &rng);
void paintShoe(Canvas &canvas, Rng &rng);

}  // namespace sphc::simulated
