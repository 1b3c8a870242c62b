#include "drivers/simulated/actors.h"

#include <cmath>

#include "drivers/simulated/body.h"
#include "drivers/simulated/walk.h"
#include "drivers/simulated/with.h"

namespace sphc::simulated {
namespace {

constexpr double kStepsPerSecond = 1.7;  // as the one with the headset walks
constexpr float kTexel = 0.0025f;

// Each walks the lap ahead of the headset, now faster, now slower, and never meets it.
struct Walker {
  double lead, sway, period_s, reach;  // radians ahead, more or less by `sway`; share of the lap's radius
};
constexpr Walker kWalkers[] = {{1.9, 0.4, 11.3, 0.95}, {2.9, 0.4, 17.9, 0.8}, {4.3, 0.5, 14.7, 1.1}};

double stepAt(double time_s) { return kPi * kStepsPerSecond * time_s; }

Pose walkerAt(const Walk &walk, const Walker &walker, double time_s) {
  const auto position = [&](double at_s) {
    const double lead = walker.lead + walker.sway * std::sin(2 * kPi * at_s / walker.period_s);
    return walk.ahead(at_s, lead, walker.reach);
  };
  const Vec3d now = position(time_s), way = position(time_s + 0.1) - now;
  // y, a body's front, to where it goes.
  return {yawRotation(std::atan2(way.y, way.x) - 0.5 * kPi), now};
}

// The one with the headset: the feet stand below it, a little to the front, turned as it is.
Pose wearerAt(const Pose &camera) {
  constexpr double kAhead = 0.14;
  const Vec3d right{camera.rotation.row[0].x, camera.rotation.row[1].x, 0};
  const Mat3d turn = yawRotation(std::atan2(right.y, right.x));
  return {turn, Vec3d{camera.center.x, camera.center.y, 0} + turn * Vec3d{0, kAhead, 0}};
}

double dropAt(double time_s, double period_s) { return 0.08 * (1 - std::cos(2 * kPi * time_s / period_s)); }

Body armsAt(double time_s) { return raisedArms(dropAt(time_s, 7.3), dropAt(time_s, 5.9)); }

void add(Builder &builder, const Pose &world_from_body, const Body &body) {
  builder.newStyle();
  for (const Part &part : body) {
    const Finish all{part.material, kTexel};
    const Finish faces[kMaxFaces] = {all, all, all, all, all, all};
    builder.solid(part.kind, world_from_body.rotation * part.center + world_from_body.center,
                  world_from_body.rotation * part.turn, part.half, faces);
  }
}

void put(const Pose &world_from_body, const Body &body, Shape *&shape) {
  for (const Part &part : body) {
    shape->center = toFloat(world_from_body.rotation * part.center + world_from_body.center);
    shape->local_from_world = toFloat(transposed(world_from_body.rotation * part.turn));
    ++shape;
  }
}

}  // namespace

Actors::Actors(Builder &builder, uint32_t with)
    : with_(with & kActors), first_(static_cast<uint32_t>(builder.shapes.size())) {
  if ((with_ & SPHC_SIMULATED_HANDS) != 0) {
    const Mat3d looking{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};  // along y
    add(builder, {looking, {0, 0.7, 1.5}}, armsAt(0));
  }
  if ((with_ & SPHC_SIMULATED_FEET) != 0) add(builder, {yawRotation(0), {0, 0.8, 0}}, walkingLegs(0));
  if ((with_ & SPHC_SIMULATED_PEOPLE) == 0) return;
  double x = -1;
  for (size_t i = 0; i < std::size(kWalkers); ++i, x += 1)
    add(builder, {yawRotation(x), {x, 0.7, 0}}, walkingBody(0));
}

void Actors::move(const Walk &walk, double time_s, std::vector<Shape> &shapes) const {
  if (with_ == 0) return;
  Shape *shape = shapes.data() + first_;
  const Pose camera = walk.at(time_s);
  if ((with_ & SPHC_SIMULATED_HANDS) != 0) put(camera, armsAt(time_s), shape);
  if ((with_ & SPHC_SIMULATED_FEET) != 0) put(wearerAt(camera), walkingLegs(stepAt(time_s)), shape);
  if ((with_ & SPHC_SIMULATED_PEOPLE) == 0) return;
  for (const Walker &walker : kWalkers) {
    put(walkerAt(walk, walker, time_s), walkingBody(stepAt(time_s) + walker.lead), shape);
  }
}

}  // namespace sphc::simulated
