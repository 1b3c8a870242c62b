// actors.h - what moves: people in the room, and the hands and feet of the one who wears the headset.
#pragma once

#include <cstdint>
#include <vector>

#include "drivers/simulated/builder.h"

namespace sphc::simulated {

class Walk;

class Actors {
 public:
  Actors() = default;
  // Adds their solids, all at rest in the middle of the room, where they are painted and lit.  `with`: as in
  // sphc_simulated_config.
  Actors(Builder &builder, uint32_t with);
  // Puts them where they are `time_s` after the begin of the walk.
  void move(const Walk &walk, double time_s, std::vector<Shape> &shapes) const;

 private:
  uint32_t with_ = 0, first_ = 0;
};

}  // namespace sphc::simulated
