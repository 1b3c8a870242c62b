#include "drivers/simulated/route.h"

#include <algorithm>
#include <cmath>

namespace sphc::simulated {
namespace {

// Half axes of the line around the middle of a room.
Vec3d lapHalf(const RoomPlan &room) {
  return {std::min(1.35, room.half.x - 1.65), std::min(0.95, room.half.y - 1.5), 0};
}

class Ellipse : public Route {
 public:
  explicit Ellipse(const RoomPlan &room) : half_(lapHalf(room)) {}
  Vec3d at(double angle, double reach) const override {
    return {half_.x * reach * std::cos(angle), half_.y * reach * std::sin(angle), 0};
  }
  double outwards(double angle) const override { return angle; }
  void shrink() override {
    half_.x *= 0.9;
    half_.y *= 0.9;
  }
  float wantedClearance() const override { return 0.6f; }
  int looks() const override { return 1; }

 private:
  Vec3d half_;
};

// A closed uniform cubic B-spline about points at equal distances.
class Tour : public Route {
 public:
  Tour(const FloorPlan &plan, uint64_t seed) : plan_(plan), seed_(seed) { draw(); }
  Vec3d at(double angle, double reach) const override {
    constexpr double kReachM = 0.6;
    const double yaw = outwards(angle);
    return curve(angle) + Vec3d{std::cos(yaw), std::sin(yaw), 0} * (kReachM * (reach - 1));
  }
  double outwards(double angle) const override {
    const double chord = 2 * kPi * kLookM / (kPitchM * static_cast<double>(points_.size()));
    const Vec3d way = curve(angle + chord) - curve(angle - chord);
    return std::atan2(way.y, way.x) - 0.5 * kPi;
  }
  void shrink() override {
    share_ *= 0.9;
    draw();
  }
  float wantedClearance() const override { return 0.35f; }  // doorways are narrow
  int looks() const override { return static_cast<int>(plan_.rooms.size()) - 1; }

 private:
  static constexpr double kPitchM = 0.5, kLookM = 0.6, kBeforeDoorwayM = 0.7;

  Vec3d curve(double angle) const;
  void draw();
  void addRoom(const RoomPlan &room, bool other_side, std::vector<Vec3d> *corners) const;

  FloorPlan plan_;
  uint64_t seed_;
  double share_ = 1;
  std::vector<Vec3d> points_;
};

Vec3d Tour::curve(double angle) const {
  const auto count = static_cast<double>(points_.size());
  double laps = std::fmod(angle / (2 * kPi), 1.0);
  if (laps < 0) laps += 1;
  const double at = laps * count;
  const auto first = static_cast<size_t>(at);
  const double t = at - static_cast<double>(first), s = 1 - t;
  const double weights[4] = {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                             (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6};
  Vec3d sum{};
  for (size_t i = 0; i < 4; ++i) sum = sum + points_[(first + i) % points_.size()] * weights[i];
  return sum;
}

// From its doorway around its middle to its other one.
void Tour::addRoom(const RoomPlan &room, bool other_side, std::vector<Vec3d> *corners) const {
  constexpr int kSteps = 24;
  const Vec3d half = lapHalf(room) * share_;
  const auto angleTo = [&](const Vec3d &point) {
    return std::atan2((point.y - room.center.y) / half.y, (point.x - room.center.x) / half.x);
  };
  const double begin = angleTo(room.in.middle);
  double arc = std::remainder(angleTo(room.out.middle) - begin, 2 * kPi);
  if (other_side) arc -= std::copysign(2 * kPi, arc);
  corners->push_back(room.in.middle);
  corners->push_back(room.in.middle + room.in.inwards * kBeforeDoorwayM);
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = begin + arc * i / kSteps;
    corners->push_back(room.center + Vec3d{half.x * std::cos(angle), half.y * std::sin(angle), 0});
  }
  corners->push_back(room.out.middle + room.out.inwards * kBeforeDoorwayM);
  corners->push_back(room.out.middle);
}

// Points at equal distances along the line through all corners.
void Tour::draw() {
  Rng rng(seed_);
  std::vector<Vec3d> corners;
  for (const RoomPlan &room : plan_.rooms) addRoom(room, rng.chance(0.5f), &corners);
  corners.push_back(corners.front());
  double length_m = 0;
  for (size_t i = 1; i < corners.size(); ++i) length_m += norm(corners[i] - corners[i - 1]);
  const auto count = static_cast<size_t>(std::lround(length_m / kPitchM));
  points_.clear();
  double passed_m = 0;
  for (size_t i = 1; i < corners.size(); ++i) {
    const double step_m = norm(corners[i] - corners[i - 1]);
    for (; points_.size() < count;) {
      const double along_m = length_m * static_cast<double>(points_.size()) / static_cast<double>(count) - passed_m;
      if (along_m > step_m) break;
      points_.push_back(corners[i - 1] + (corners[i] - corners[i - 1]) * (step_m > 0 ? along_m / step_m : 0));
    }
    passed_m += step_m;
  }
}

}  // namespace

std::unique_ptr<Route> makeRoute(const FloorPlan &plan, uint64_t seed) {
  if (plan.rooms.size() == 1) return std::make_unique<Ellipse>(plan.rooms[0]);
  return std::make_unique<Tour>(plan, seed);
}

}  // namespace sphc::simulated
