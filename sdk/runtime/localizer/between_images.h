// What is not known of how the camera moved between the colour image of a frame and its other images, and while the
// rows of a rolling shutter were exposed.
#pragma once
#include <algorithm>

#include "runtime/base/elementary.h"
#include "runtime/localizer/recent_steps.h"
#include "runtime/localizer/tuning.h"

namespace sphc {

// Of the image of which least is known; 1 sigma an axis.
struct BetweenImages {
  double apart_s = 0;  // where nothing tells the way
  double turn_sigma_rad = 0, shift_sigma_m = 0;

  // What such a frame says of points and sensors is not kept.
  bool areApart() const { return shift_sigma_m > tuning::kSpeedApart * tuning::kMostTogetherS; }

  // An image, or rows, taken to the time of colour: points turn about the camera, some metres away.
  void add(const Way &way) { widen(way.turn_sigma_rad, hypotOf(way.shift_sigma_m, kPointsM * way.turn_sigma_rad)); }
  // An image so far in time from colour, of which nothing tells the way.
  void addUnknown(double seconds) {
    apart_s = std::max(apart_s, std::min(seconds, tuning::kMostApartS));
    widen(tuning::kTurnApart * apart_s, tuning::kSpeedApart * apart_s);
  }
  // Other images of the same frame.
  void add(const BetweenImages &other) {
    apart_s = std::max(apart_s, other.apart_s);
    widen(other.turn_sigma_rad, other.shift_sigma_m);
  }

 private:
  static constexpr double kPointsM = 1;  // so much of a turn's error, in m a rad, moves the camera's place

  void widen(double turn_rad, double shift_m) {
    turn_sigma_rad = std::max(turn_sigma_rad, turn_rad);
    shift_sigma_m = std::max(shift_sigma_m, shift_m);
  }
};

}  // namespace sphc
