#include "drivers/simulated/walk.h"

#include <algorithm>
#include <cmath>

namespace sphc::simulated {
namespace {

constexpr double kDegree = kPi / 180;
constexpr float kWantedClearance = 0.6f;

}  // namespace

Walk::Walk(const Scene &scene, uint64_t seed, double lap_s, bool glances)
    : lap_s_(lap_s), glance_(glances ? 28 * kDegree : 0) {
  half_x_ = std::min(1.35, scene.plan.half.x - 1.65);
  half_y_ = std::min(0.95, scene.plan.half.y - 1.5);
  draw(seed);
  for (int attempt = 0; attempt < 8; ++attempt) {
    clearance_ = measure(scene);
    if (clearance_ >= kWantedClearance) break;
    half_x_ *= 0.9;
    half_y_ *= 0.9;
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
  const Wave advance[kWaves] = {wave(0.10, 1), wave(0.12, 4), wave(0.06, 5)};
  const Wave radius[kWaves] = {wave(0.10, 1), wave(0.07, 4), wave(0.05, 5)};
  const Wave height[kWaves] = {wave(0.09, 1), wave(0.04, 3), wave(0.03, 4)};
  const Wave gaze[kWaves] = {wave(8 * kDegree, 1), wave(20 * kDegree, 2), wave(9 * kDegree, 4)};
  const Wave pitch[kWaves] = {wave(3 * kDegree, 1), wave(5 * kDegree, 2), wave(4 * kDegree, 6)};
  std::copy(advance, advance + kWaves, advance_);
  std::copy(radius, radius + kWaves, radius_);
  std::copy(height, height + kWaves, height_);
  std::copy(gaze, gaze + kWaves, gaze_);
  std::copy(pitch, pitch + kWaves, pitch_);
  step_cycles_ = std::max(1.0, std::round(2 * lap_s_ * 1.7));  // 1.7 steps a second
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
  const double angle = angleAt(turnAt(time_s)) + direction_ * lead;
  return {half_x_ * reach * std::cos(angle), half_y_ * reach * std::sin(angle), 0};
}

Vec3d Walk::position(double turn) const {
  const double angle = angleAt(turn);
  const double reach = 1 + sum(radius_, kWaves, turn);
  const double bob = 0.012 * std::sin(step_cycles_ * turn);
  return {half_x_ * reach * std::cos(angle), half_y_ * reach * std::sin(angle),
          1.56 + sum(height_, kWaves, turn) + bob};
}

Pose Walk::at(double time_s) const {
  const double turn = turnAt(time_s);
  const double angle = angleAt(turn);
  // Ahead along the lap, turned inwards so as to look across the room.
  const double yaw = angle + direction_ * (0.5 * kPi + gaze_mean_ + sum(gaze_, kWaves, turn)) +
                     0.4 * kDegree * std::sin(0.5 * step_cycles_ * turn);
  const double pitch = -9 * kDegree + sum(pitch_, kWaves, turn) +
                       0.35 * kDegree * std::sin(step_cycles_ * turn + 1) - glance_ * (1 - std::cos(6 * turn));
  const double roll = 1.2 * kDegree * std::sin(0.5 * step_cycles_ * turn + roll_phase_) + 0.02 * std::sin(3 * turn);
  const Vec3d forward{std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
  const Vec3d level_right{std::sin(yaw), -std::cos(yaw), 0};
  const Vec3d level_down = cross(forward, level_right);
  const Vec3d right = level_right * std::cos(roll) + level_down * std::sin(roll);
  const Vec3d down = cross(forward, right);
  return {transposed(Mat3d{{right, down, forward}}), position(turn)};
}

float Walk::measure(const Scene &scene) const {
  constexpr int kSteps = 400;
  float nearest = kFar;
  for (int i = 0; i < kSteps; ++i) {
    nearest = std::min(nearest, simulated::clearance(scene, toFloat(position(2 * kPi * i / kSteps))));
  }
  return nearest;
}

}  // namespace sphc::simulated
