#include "drivers/simulated/walk.h"

#include <algorithm>
#include <cmath>

namespace sphc::simulated {
namespace {

constexpr double kDegree = kPi / 180;

}  // namespace

Walk::Walk(const Scene &scene, uint64_t seed, double lap_s, bool glances)
    : route_(makeRoute(scene.plan, seed)), lap_s_(lap_s), glance_(glances ? 28 * kDegree : 0) {
  draw(seed);
  for (int attempt = 0; attempt < 8; ++attempt) {
    clearance_ = measure(scene);
    if (clearance_ >= route_->wantedClearance()) break;
    route_->shrink();
  }
}

// Waves of an odd number of cycles in two laps differ from lap to lap; those of an even number repeat.
void Walk::draw(uint64_t seed) {
  Rng rng(hash64(seed, 77));
  const auto wave = [&](double amplitude, double cycles) {
    return Wave{amplitude * rng.real(0.6, 1.0), cycles, rng.real(0, 2 * kPi)};
  };
  start_ = rng.real(0, 2 * kPi);
  direction_ = rng.chance(0.5f) ? 1 : -1;
  gaze_mean_ = rng.real(22, 34) * kDegree;
  const auto look = [&](double amplitude, double cycles) { return wave(amplitude, cycles * route_->looks()); };
  const Wave advance[kWaves] = {wave(0.10, 1), wave(0.12, 4), wave(0.06, 5)};
  const Wave radius[kWaves] = {look(0.10, 1), look(0.07, 4), look(0.05, 5)};
  const Wave height[kWaves] = {look(0.09, 1), look(0.04, 3), look(0.03, 4)};
  const Wave gaze[kWaves] = {look(8 * kDegree, 1), look(20 * kDegree, 2), look(9 * kDegree, 4)};
  const Wave pitch[kWaves] = {look(3 * kDegree, 1), look(5 * kDegree, 2), look(4 * kDegree, 6)};
  std::copy(advance, advance + kWaves, advance_);
  std::copy(radius, radius + kWaves, radius_);
  std::copy(height, height + kWaves, height_);
  std::copy(gaze, gaze + kWaves, gaze_);
  std::copy(pitch, pitch + kWaves, pitch_);
  step_cycles_ = 2 * std::round(lap_s_ * 1.7);  // 1.7 steps a second; even, as sway has half of them
  roll_phase_ = rng.real(0, 2 * kPi);
}

// `turn` runs from 0 to 2 pi over two laps.
double Walk::sum(const Wave *waves, int count, double turn) const {
  double total = 0;
  for (int i = 0; i < count; ++i) total += waves[i].amplitude * std::sin(waves[i].cycles * turn + waves[i].phase);
  return total;
}

double Walk::turnAt(double time_s) const { return std::fmod(time_s / (2 * lap_s_), 1.0) * 2 * kPi; }

double Walk::angleAt(double turn) const { return start_ + direction_ * (2 * turn + sum(advance_, kWaves, turn)); }

Vec3d Walk::ahead(double time_s, double lead, double reach) const {
  return route_->at(angleAt(turnAt(time_s)) + direction_ * lead / route_->looks(), reach);
}

Vec3d Walk::position(double turn) const {
  const double angle = angleAt(turn);
  const double reach = 1 + sum(radius_, kWaves, turn);
  const double bob = 0.012 * std::sin(step_cycles_ * turn);
  const Vec3d floor = route_->at(angle, reach);
  return {floor.x, floor.y, 1.56 + sum(height_, kWaves, turn) + bob};
}

Pose Walk::at(double time_s) const {
  const double turn = turnAt(time_s);
  const double angle = angleAt(turn);
  // Ahead along the lap, turned inwards so as to look across the room.
  const double yaw = route_->outwards(angle) + direction_ * (0.5 * kPi + gaze_mean_ + sum(gaze_, kWaves, turn)) +
                     0.4 * kDegree * std::sin(0.5 * step_cycles_ * turn);
  const double pitch = -9 * kDegree + sum(pitch_, kWaves, turn) +
                       0.35 * kDegree * std::sin(step_cycles_ * turn + 1) -
                       glance_ * (1 - std::cos(6 * route_->looks() * turn));
  const double roll = 1.2 * kDegree * std::sin(0.5 * step_cycles_ * turn + roll_phase_) + 0.02 * std::sin(3 * turn);
  const Vec3d forward{std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
  const Vec3d level_right{std::sin(yaw), -std::cos(yaw), 0};
  const Vec3d level_down = cross(forward, level_right);
  const Vec3d right = level_right * std::cos(roll) + level_down * std::sin(roll);
  const Vec3d down = cross(forward, right);
  return {transposed(Mat3d{{right, down, forward}}), position(turn)};
}

float Walk::measure(const Scene &scene) const {
  const int steps = 400 * route_->looks();
  float nearest = kFar;
  for (int i = 0; i < steps; ++i) {
    nearest = std::min(nearest, simulated::clearance(scene, toFloat(position(2 * kPi * i / steps))));
  }
  return nearest;
}

}  // namespace sphc::simulated
