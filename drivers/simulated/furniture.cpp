#include "drivers/simulated/furniture.h"

#include <algorithm>

namespace sphc::simulated {
namespace {

constexpr Finish kWood{Material::kWood, 0.0037f};
constexpr Finish kHiddenWood{Material::kWood, 0.02f};
constexpr Finish kCloth{Material::kFabric, 0.003f};
constexpr Finish kBlack{Material::kMetal, 0.004f};
constexpr double kChairSlack = 0.25;

void legs(Builder &b, const Place &place, double half_x, double half_y, double height, double radius) {
  for (int i = 0; i < 4; ++i) {
    const double x = (i & 1) != 0 ? half_x : -half_x, y = (i & 2) != 0 ? half_y : -half_y;
    b.cylinder(place, {x, y, 0.5 * height}, radius, 0.5 * height, kWood, kHiddenWood);
  }
}

void vase(Builder &b, const Place &place) {
  const double radius = b.rng().real(0.035, 0.075), height = b.rng().real(0.06, 0.14);
  b.cylinder(place, {0, 0, height}, radius, height, {Material::kCeramic, 0.0025f}, {Material::kCeramic, 0.004f});
  if (b.rng().chance(0.25f)) {
    b.ellipsoid(place, {0, 0, 2 * height + 0.08}, {0.09, 0.09, 0.11}, 0, {Material::kLeaves, 0.003f});
  }
}

void pileOfBooks(Builder &b, const Place &place) {
  double z = 0;
  for (int i = 2 + b.rng().index(4); i > 0; --i) {
    const double thick = b.rng().real(0.012, 0.03);
    const Place turned = at(place, 0, 0, z, b.rng().real(-0.5, 0.5));
    b.boxWithTop(turned, {0, 0, thick}, {0.11, 0.08, thick}, {Material::kPaper, 0.003f},
                 {Material::kMagazine, 0.002f});
    z += 2 * thick;
  }
}

void smallBox(Builder &b, const Place &place) {
  const Vec3d half{b.rng().real(0.06, 0.13), b.rng().real(0.05, 0.1), b.rng().real(0.04, 0.12)};
  const Material material = b.rng().chance(0.5f) ? Material::kCardboard : Material::kMagazine;
  b.box(at(place, 0, 0, 0, b.rng().real(-0.4, 0.4)), {0, 0, half.z}, half, {material, 0.002f});
}

void addThing(Builder &b, const Place &place) {
  switch (b.rng().index(3)) {
    case 0:
      return vase(b, place);
    case 1:
      return pileOfBooks(b, place);
    default:
      return smallBox(b, place);
  }
}

// One of many that look the same.  `x`, `z`: the middle of its foot, from `place`.
void addBinder(Builder &b, const Place &place, double x, double shelf_depth, double z) {
  constexpr uint64_t kSeed = 29;
  constexpr double kWidth = 0.075, kHeight = 0.32, kDepth = 0.28;
  const Vec3d middle{x, 0.5 * shelf_depth, z + 0.5 * kHeight};
  const Vec3d extent{0.5 * kWidth, 0.5 * kDepth, 0.5 * kHeight};
  b.movable(place, 0, [&](const Place &own) {
    b.repeatably(kSeed, [&] {
      b.boxWithFront(own, middle, extent, {Material::kPaper, 0.008f}, {Material::kBinder, 0.0015f});
    });
  });
}

}  // namespace

void addBooks(Builder &b, const Place &place, double x0, double x1, double front, double z, double room) {
  double x = x0;
  while (x < x1 - 0.03) {
    if (b.rng().chance(0.05f)) {
      x += b.rng().real(0.02, 0.1);
      continue;
    }
    const double half = b.rng().real(0.010, 0.026);
    if (x + 2 * half > x1) break;
    const double height = room * b.rng().real(0.62, 0.95), depth = b.rng().real(0.08, 0.1);
    const double back = b.rng().real(0, 0.02);
    b.movable(place, 0, [&](const Place &own) {
      b.boxWithFront(own, {x + half, front - back - depth, z + 0.5 * height}, {half, depth, 0.5 * height},
                     {Material::kPaper, 0.008f}, {Material::kSpine, 0.0015f});
    });
    x += 2 * half + 0.001;
  }
}

void addBookshelf(Builder &b, const Place &place, double width, double height) {
  b.newStyle();
  constexpr double kDepth = 0.3, kBoard = 0.012;
  const double half = 0.5 * width;
  const int shelves = static_cast<int>(height / 0.34);
  const double pitch = (height - 2 * kBoard) / shelves;
  b.box(place, {0, 0.01, 0.5 * height}, {half, 0.01, 0.5 * height}, kWood);
  for (const double x : {-half, 0.0, half}) {
    b.box(place, {x, 0.5 * kDepth, 0.5 * height}, {kBoard, 0.5 * kDepth, 0.5 * height}, kWood);
  }
  for (int i = 0; i <= shelves; ++i) {
    const double z = kBoard + i * pitch;
    b.box(place, {0, 0.5 * kDepth, z}, {half, 0.5 * kDepth, kBoard}, kWood);
    if (i == shelves) break;
    for (int side = 0; side < 2; ++side) {
      const double x0 = (side == 0 ? -half : 0.0) + 0.03, x1 = x0 + half - 0.06;
      if (b.rng().chance(0.15f)) {
        addClutter(b, at(place, 0.5 * (x0 + x1), 0.17, z + kBoard), half - 0.15, 0.1, 3);
      } else {
        addBooks(b, place, x0, x1, kDepth - 0.02, z + kBoard, pitch - 2 * kBoard);
      }
    }
  }
  addClutter(b, at(place, 0, 0.16, height), width - 0.2, 0.12, 3);
}

void addBinderShelf(Builder &b, const Place &place, double width) {
  b.newStyle();
  constexpr int kBoards = 6;
  constexpr double kDepth = 0.32, kBoard = 0.012, kPitch = 0.38, kPeriod = 0.08;
  constexpr double kHeight = (kBoards - 1) * kPitch + kBoard;
  const double half = 0.5 * width;
  for (const double x : {-half, half})
    b.box(place, {x, 0.5 * kDepth, 0.5 * kHeight}, {kBoard, 0.5 * kDepth, 0.5 * kHeight}, kWood);
  const int binders = static_cast<int>((width - 4 * kBoard) / kPeriod);
  for (int board = 0; board < kBoards; ++board) {
    const double z = kBoard + board * kPitch;
    b.box(place, {0, 0.5 * kDepth, z}, {half, 0.5 * kDepth, kBoard}, kWood);
    if (board == kBoards - 1) break;
    for (int i = 0; i < binders; ++i) addBinder(b, place, (i - 0.5 * (binders - 1)) * kPeriod, kDepth, z + kBoard);
  }
}

void addSofa(Builder &b, const Place &place, double width) {
  b.newStyle();
  constexpr double kDepth = 0.88;
  const double half = 0.5 * width;
  b.box(place, {0, 0.5 * kDepth, 0.2}, {half - 0.18, 0.5 * kDepth - 0.02, 0.14}, kCloth);
  b.tiltedBox(place, {0, 0.16, 0.56}, {half - 0.16, 0.1, 0.3}, -0.16, kCloth);
  b.roll(place, {0, 0.12, 0.84}, 0.07, half - 0.14, kCloth);
  for (const double side : {-1.0, 1.0}) {
    b.box(place, {side * (half - 0.09), 0.5 * kDepth, 0.3}, {0.09, 0.5 * kDepth - 0.01, 0.25}, kCloth);
    Place arm = at(place, side * (half - 0.09), 0.5 * kDepth, 0.56, 1.5707963);
    b.roll(arm, {0, 0, 0}, 0.11, 0.5 * kDepth, kCloth);
  }
  const int seats = width > 1.5 ? 3 : 1;
  const double seat = (width - 0.38) / seats;
  for (int i = 0; i < seats; ++i) {
    const double x = -half + 0.19 + seat * (i + 0.5);
    b.box(place, {x, 0.56, 0.41}, {0.5 * seat - 0.006, 0.32, 0.075}, kCloth);
    if (seats > 1 && i == 1 && b.rng().chance(0.5f)) continue;
    b.ellipsoid(place, {x + b.rng().real(-0.06, 0.06), 0.36, 0.66}, {0.23, 0.1, 0.21}, -0.3, kCloth);
  }
}

void addCabinet(Builder &b, const Place &place, double width, double height, int columns, int rows) {
  b.newStyle();
  constexpr double kDepth = 0.42, kFoot = 0.06;
  const double half = 0.5 * width, body = height - kFoot;
  b.box(place, {0, 0.5 * kDepth, kFoot + 0.5 * body}, {half, 0.5 * kDepth, 0.5 * body}, kWood);
  b.box(place, {0, 0.5 * kDepth, 0.5 * kFoot}, {half - 0.04, 0.5 * kDepth - 0.04, 0.5 * kFoot}, kHiddenWood);
  b.box(place, {0, 0.5 * kDepth + 0.01, height + 0.012}, {half + 0.02, 0.5 * kDepth + 0.02, 0.014}, kWood);
  const double w = width / columns, h = body / rows;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      b.boxWithFront(place, {-half + w * (i + 0.5), kDepth + 0.008, kFoot + h * (j + 0.5)},
                     {0.5 * w - 0.006, 0.01, 0.5 * h - 0.006}, kHiddenWood, {Material::kCabinetDoor, 0.0025f});
    }
  }
  addClutter(b, at(place, 0, 0.5 * kDepth, height + 0.026), width - 0.2, 0.2, 2 + static_cast<int>(width * 3));
}

void addTvBench(Builder &b, const Place &place, double width) {
  addCabinet(b, place, width, 0.5, 3, 1);
  b.boxWithFront(place, {0, 0.12, 0.98}, {0.52, 0.02, 0.31}, kBlack, {Material::kScreen, 0.003f});
  b.box(place, {0, 0.12, 0.6}, {0.12, 0.04, 0.09}, kBlack);
}

void addDesk(Builder &b, const Place &place, double width) {
  b.newStyle();
  const double half = 0.5 * width;
  b.box(place, {0, 0.32, 0.73}, {half, 0.32, 0.018}, kWood);
  legs(b, at(place, 0, 0.32), half - 0.05, 0.27, 0.71, 0.025);
  b.boxWithFront(place, {half - 0.25, 0.32, 0.6}, {0.2, 0.28, 0.1}, kWood, {Material::kCabinetDoor, 0.0025f});
  b.boxWithFront(place, {-0.1, 0.14, 1.0}, {0.26, 0.015, 0.16}, kBlack, {Material::kMagazine, 0.002f});
  b.box(place, {-0.1, 0.14, 0.8}, {0.03, 0.02, 0.06}, kBlack);
  b.boxWithTop(place, {-0.1, 0.42, 0.757}, {0.2, 0.07, 0.009}, kBlack, {Material::kMagazine, 0.002f});
  addBooks(b, at(place, 0, 0), 0.25, half - 0.04, 0.24, 0.748, 0.27);
  addClutter(b, at(place, -half + 0.2, 0.35, 0.748), 0.3, 0.2, 2);
  const Place chair = at(place, 0.0, 0.72, 0, 3.1415927 + b.rng().real(-0.4, 0.4));
  b.movable(chair, kChairSlack, [&](const Place &own) { addChair(b, own); });
}

void addChair(Builder &b, const Place &place) {
  b.newStyle();
  b.box(place, {0, 0, 0.45}, {0.21, 0.2, 0.02}, kWood);
  b.box(place, {0, 0, 0.49}, {0.2, 0.19, 0.022}, kCloth);
  legs(b, place, 0.18, 0.17, 0.43, 0.02);
  for (const double side : {-0.19, 0.19}) {
    b.box(place, {side, -0.19, 0.7}, {0.018, 0.016, 0.25}, kWood);
  }
  for (int i = 0; i < 3; ++i) b.box(place, {0, -0.19, 0.62 + 0.13 * i}, {0.18, 0.01, 0.04}, kWood);
}

void addDiningSet(Builder &b, const Place &place) {
  b.newStyle();
  const Place middle = at(place, 0, 0.55);
  b.boxWithTop(middle, {0, 0, 0.74}, {0.65, 0.4, 0.018}, kWood, {Material::kFabric, 0.0025f});
  legs(b, middle, 0.58, 0.33, 0.72, 0.03);
  const auto chair = [&](const Place &place_there) {
    b.movable(place_there, kChairSlack, [&](const Place &own) { addChair(b, own); });
  };
  chair(at(middle, -0.82, 0, 0, -1.57 + b.rng().real(-0.2, 0.2)));
  chair(at(middle, 0.82, 0, 0, 1.57 + b.rng().real(-0.2, 0.2)));
  chair(at(middle, b.rng().real(-0.25, 0.25), 0.42, 0, 3.14 + b.rng().real(-0.3, 0.3)));
  addClutter(b, at(middle, 0, 0, 0.758), 1.1, 0.5, 6);
}

void addDoor(Builder &b, const Place &place) {
  b.newStyle();
  b.boxWithFront(place, {0, 0.02, 1.02}, {0.43, 0.02, 1.02}, kWood, {Material::kDoor, 0.003f});
  for (const double side : {-0.47, 0.47}) b.box(place, {side, 0.03, 1.05}, {0.045, 0.03, 1.05}, kWood);
  b.box(place, {0, 0.03, 2.1}, {0.52, 0.03, 0.045}, kWood);
}

void addDoorway(Builder &b, const Place &place, double half, double height) {
  b.newStyle();
  constexpr double kFrame = 0.045;
  for (const double side : {-half - kFrame, half + kFrame})
    b.box(place, {side, 0.015, 0.5 * height}, {kFrame, 0.015, 0.5 * height}, kWood);
  b.box(place, {0, 0.015, height + kFrame}, {half + 2 * kFrame, 0.015, kFrame}, kWood);
}

void addBoxes(Builder &b, const Place &place) {
  constexpr Finish kCarton{Material::kCardboard, 0.003f};
  b.box(at(place, -0.05, 0.3, 0, b.rng().real(-0.2, 0.2)), {0, 0, 0.2}, {0.3, 0.24, 0.2}, kCarton);
  b.box(at(place, 0.02, 0.28, 0.4, b.rng().real(-0.4, 0.4)), {0, 0, 0.16}, {0.24, 0.2, 0.16}, kCarton);
  b.box(at(place, -0.02, 0.28, 0.72, b.rng().real(-0.5, 0.5)), {0, 0, 0.1}, {0.17, 0.14, 0.1}, kCarton);
}

void addWindow(Builder &b, const Place &place, double width) {
  b.newStyle();
  constexpr double kMiddle = 1.55, kHalfHeight = 0.6;
  const double half = 0.5 * width;
  b.boxWithFront(place, {0, 0.005, kMiddle}, {half, 0.005, kHalfHeight}, kHiddenWood, {Material::kWindow, 0.004f});
  for (const double x : {-half, 0.0, half}) b.box(place, {x, 0.025, kMiddle}, {0.03, 0.025, kHalfHeight}, kWood);
  for (const double z : {-kHalfHeight, 0.15, kHalfHeight}) {
    b.box(place, {0, 0.025, kMiddle + z}, {half + 0.03, 0.024, 0.028}, kWood);
  }
  b.box(place, {0, 0.07, kMiddle - kHalfHeight - 0.04}, {half + 0.08, 0.08, 0.015}, kWood);
  b.roll(place, {0, 0.1, 2.3}, 0.015, half + 0.4, kBlack);
  const Finish curtain{Material::kCurtain, 0.003f};
  for (const double side : {-1.0, 1.0}) {
    for (int fold = 0; fold < 4; ++fold) {
      const double x = side * (half - 0.02 + 0.085 * fold), y = 0.1 + (fold % 2 == 0 ? 0.02 : -0.015);
      b.cylinder(place, {x, y, 1.59}, 0.05, 0.7, curtain, curtain);
    }
  }
  addClutter(b, at(place, 0, 0.09, kMiddle - kHalfHeight - 0.025), width - 0.2, 0.04, 2);
}

void addPicture(Builder &b, const Place &place, double width, double height, double middle_height) {
  b.newStyle();
  const double half_w = 0.5 * width, half_h = 0.5 * height;
  b.boxWithFront(place, {0, 0.012, middle_height}, {half_w, 0.008, half_h}, kHiddenWood,
                 {Material::kPicture, 0.002f});
  if (b.rng().chance(0.3f)) return;  // a poster without a frame
  for (const double side : {-1.0, 1.0}) {
    b.box(place, {side * half_w, 0.018, middle_height}, {0.018, 0.018, half_h + 0.018}, kWood);
    b.box(place, {0, 0.018, middle_height + side * half_h}, {half_w, 0.017, 0.018}, kWood);
  }
}

void addClock(Builder &b, const Place &place, double middle_height) {
  b.wallDisc(place, {0, 0.02, middle_height}, 0.17, kBlack, {Material::kClock, 0.0015f});
}

void addWallShelf(Builder &b, const Place &place, double width, double height) {
  b.newStyle();
  b.box(place, {0, 0.11, height}, {0.5 * width, 0.11, 0.014}, kWood);
  addBooks(b, place, -0.48 * width, 0.05 * width, 0.2, height + 0.014, 0.28);
  addClutter(b, at(place, 0.28 * width, 0.1, height + 0.014), 0.4 * width, 0.06, 3);
}

void addCoffeeTable(Builder &b, const Place &place) {
  b.newStyle();
  b.boxWithTop(place, {0, 0, 0.41}, {0.5, 0.28, 0.02}, kWood, {Material::kWood, 0.002f});
  b.box(place, {0, 0, 0.15}, {0.44, 0.22, 0.012}, kWood);
  legs(b, place, 0.44, 0.22, 0.39, 0.025);
  addClutter(b, at(place, 0, 0, 0.43), 0.8, 0.36, 6);
  addClutter(b, at(place, 0, 0, 0.162), 0.6, 0.3, 2);
}

void addMirror(Builder &b, const Place &place, double width, double height) {
  b.newStyle();
  constexpr double kFoot = 0.08;
  const double half_w = 0.5 * width, half_h = 0.5 * (height - kFoot);
  b.boxWithFront(place, {0, 0.01, kFoot + half_h}, {half_w, 0.01, half_h}, kHiddenWood, {Material::kMirror, 0.02f});
  for (const double side : {-1.0, 1.0}) {
    b.box(place, {side * half_w, 0.016, kFoot + half_h}, {0.025, 0.016, half_h + 0.025}, kWood);
    b.box(place, {0, 0.016, kFoot + half_h + side * half_h}, {half_w, 0.015, 0.025}, kWood);
  }
}

void addCarpet(Builder &b, const Place &place, double half_x, double half_y) {
  b.boxWithTop(place, {0, 0, 0.005}, {half_x, half_y, 0.005}, {Material::kFabric, 0.01f},
               {Material::kCarpet, 0.003f});
}

void addPlant(Builder &b, const Place &place) {
  const Finish pot{Material::kCeramic, 0.003f}, leaves{Material::kLeaves, 0.003f};
  b.cylinder(place, {0, 0, 0.18}, 0.17, 0.18, pot, {Material::kCardboard, 0.005f});
  b.cylinder(place, {0, 0, 0.6}, 0.02, 0.3, kWood, kWood);
  const double height = b.rng().real(0.75, 1.05);
  for (int i = 0; i < 7; ++i) {
    const double a = 0.9 * i + b.rng().real(0, 0.5), r = 0.14 + 0.06 * (i % 2);
    b.ellipsoid(at(place, 0, 0, 0, a), {0, r, height + 0.09 * (i % 4)},
                {b.rng().real(0.09, 0.14), b.rng().real(0.14, 0.2), b.rng().real(0.08, 0.15)}, -0.4, leaves);
  }
}

void addFloorLamp(Builder &b, const Place &place) {
  b.cylinder(place, {0, 0, 0.015}, 0.15, 0.015, kBlack, kBlack);
  b.cylinder(place, {0, 0, 0.75}, 0.014, 0.72, kBlack, kBlack);
  b.cylinder(place, {0, 0, 1.55}, 0.19, 0.15, {Material::kLampshade, 0.003f}, {Material::kLampshade, 0.005f});
}

void addCeilingLamp(Builder &b, const Place &place, double ceiling) {
  b.cylinder(place, {0, 0, ceiling - 0.12}, 0.01, 0.12, kBlack, kBlack);
  b.cylinder(place, {0, 0, ceiling - 0.3}, 0.24, 0.07, {Material::kLampshade, 0.003f},
             {Material::kLampshade, 0.005f});
}

void addClutter(Builder &b, const Place &place, double width, double depth, int count) {
  for (int i = 0; i < count; ++i) {
    const double x = width * ((i + 0.5) / count - 0.5);
    const double slack = std::max(0.0, 0.5 * depth - 0.08);
    const Place spot = at(place, x, b.rng().real(-slack, slack));
    b.movable(spot, 0.07, [&](const Place &own) { addThing(b, own); });
  }
}

}  // namespace sphc::simulated
