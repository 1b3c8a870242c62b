// walk.h - the path of the colour camera: two closed laps around the middle of the room, or through all rooms,
// smooth at every time.
#pragma once

#include <cstdint>
#include <memory>

#include "drivers/simulated/route.h"
#include "drivers/simulated/scene.h"
#include "drivers/simulated/vec.h"

namespace sphc::simulated {

class Walk {
 public:
  // Draws the walk by its seed and pulls it towards the middle until it keeps clear of the furniture.
  // `glances`: it looks down three times a lap.
  Walk(const Scene &scene, uint64_t seed, double lap_s, bool glances);
  // world_from_camera at `time_s` after the start; any time.
  Pose at(double time_s) const;
  // The place on the floor `lead` radians of a room's lap further along, at a share of its radius.
  Vec3d ahead(double time_s, double lead, double reach) const;
  // Smallest distance to a surface on the way.
  float clearance() const { return clearance_; }

 private:
  struct Wave {
    double amplitude, cycles, phase;  // cycles a double lap: whole numbers close the path
  };
  double sum(const Wave *waves, int count, double turn) const;
  double turnAt(double time_s) const;
  double angleAt(double turn) const;
  Vec3d position(double turn) const;
  float measure(const Scene &scene) const;
  void draw(uint64_t seed);

  static constexpr int kWaves = 3;
  Wave advance_[kWaves], radius_[kWaves], height_[kWaves], gaze_[kWaves], pitch_[kWaves];
  std::unique_ptr<Route> route_;
  double lap_s_, glance_, start_, direction_, gaze_mean_, step_cycles_, roll_phase_;
  float clearance_ = 0;
};

}  // namespace sphc::simulated
