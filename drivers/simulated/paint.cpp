#include "drivers/simulated/paint.h"

namespace sphc::simulated {

bool isBright(Material material) { return isOutdoors(material) || material == Material::kLampshade; }

bool isOutdoors(Material material) {
  return material == Material::kWindow || material == Material::kStreet || material == Material::kLawn ||
         material == Material::kSky;
}

void paint(Canvas &canvas, Material material, uint64_t style_seed, uint64_t seed) {
  Rng rng(seed), style(style_seed);
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
      return paintWood(canvas, style, rng);
    case Material::kCabinetDoor:
      return paintCabinetDoor(canvas, style, rng);
    case Material::kDoor:
      return paintDoor(canvas, style, rng);
    case Material::kSpine:
      return paintSpine(canvas, rng);
    case Material::kPaper:
      return paintPaper(canvas, rng);
    case Material::kFabric:
      return paintFabric(canvas, style, rng);
    case Material::kCurtain:
      return paintCurtain(canvas, style, rng);
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
    case Material::kFittedCarpet:
      return paintFittedCarpet(canvas, rng);
    case Material::kParquet:
      return paintParquet(canvas, rng);
    case Material::kTiles:
      return paintTiles(canvas, rng);
    case Material::kBare:
      return paintBare(canvas, rng);
    case Material::kMirror:
      return canvas.fill([](float, float) { return Ink{0.7f, 0.72f, 0.72f, 0.1f}; });
    case Material::kStreet:
      return paintStreet(canvas, rng);
    case Material::kLawn:
      return paintLawn(canvas, rng);
    case Material::kSky:
      return paintSky(canvas);
    case Material::kSkin:
      return paintSkin(canvas, rng);
    case Material::kHead:
      return paintHead(canvas, rng);
    case Material::kTrousers:
      style = Rng(hash64(style_seed));  // of another cloth than the shirt
      return paintFabric(canvas, style, rng);
    case Material::kShoe:
      return paintShoe(canvas, rng);
    case Material::kRepeatingWallpaper:
      return paintRepeatingWallpaper(canvas, style, rng);
    case Material::kBinder:
      return paintBinder(canvas, rng);
  }
}

}  // namespace sphc::simulated
