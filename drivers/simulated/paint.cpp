#include "drivers/simulated/paint.h"

namespace sphc::simulated {

bool isBright(Material material) { return material == Material::kWindow || material == Material::kLampshade; }

void paint(Canvas &canvas, Material material, uint64_t seed) {
  Rng rng(seed);
  switch (material) {
    case Material::kBrick:
      return paintBrick(canvas, rng);
    case Material::kWallpaper:
      return paintWallpaper(canvas, rng);
    case Material::kPlaster:
      return paintPlaster(canvas, rng);
    case Material::kPanelling:
      return paintPlanks(canvas, rng, 0.14f, 2.6f, true);
    case Material::kCeiling:
      return paintCeiling(canvas, rng);
    case Material::kFloor:
      return paintPlanks(canvas, rng, 0.11f, 1.1f, false);
    case Material::kCarpet:
      return paintCarpet(canvas, rng);
    case Material::kWood:
      return paintWood(canvas, rng);
    case Material::kCabinetDoor:
      return paintCabinetDoor(canvas, rng);
    case Material::kDoor:
      return paintDoor(canvas, rng);
    case Material::kSpine:
      return paintSpine(canvas, rng);
    case Material::kPaper:
      return paintPaper(canvas, rng);
    case Material::kFabric:
      return paintFabric(canvas, rng);
    case Material::kCurtain:
      return paintCurtain(canvas, rng);
    case Material::kPicture:
      return paintPicture(canvas, rng);
    case Material::kWindow:
      return paintWindow(canvas, rng);
    case Material::kScreen:
      return paintScreen(canvas, rng);
    case Material::kCardboard:
      return paintCardboard(canvas, rng);
    case Material::kCeramic:
      return paintCeramic(canvas, rng);
    case Material::kLeaves:
      return paintLeaves(canvas, rng);
    case Material::kLampshade:
      return paintLampshade(canvas, rng);
    case Material::kMetal:
      return paintMetal(canvas, rng);
    case Material::kClock:
      return paintClock(canvas, rng);
    case Material::kMagazine:
      return paintMagazine(canvas, rng);
  }
}

}  // namespace sphc::simulated
