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
  double turn_sigma_of_rows_rad = 0, shift_sigma_of_rows_m = 0;

  // What such a frame says of points and sensors is not kept.  Rows bend an image and do not shift it.
  bool areApart() const { return shift_sigma_m > tuning::kSpeedApart * tuning::kMostTogetherS; }
  // Of a pose that such images lead to.
  double turnSigma() const { return hypotOf(turn_sigma_rad, turn_sigma_of_rows_rad); }
  double shiftSigma() const { return hypotOf(shift_sigma_m, shift_sigma_of_rows_m); }

  // An image that is taken to the time of colour.
  void add(const Way &way) { widen(way.turn_sigma_rad, aboutTheCamera(way)); }
  // From the middle row of an image to its first, or to its last.
  void addRows(const Way &way) {
    turn_sigma_of_rows_rad = std::max(turn_sigma_of_rows_rad, way.turn_sigma_rad);
    shift_sigma_of_rows_m = std::max(shift_sigma_of_rows_m, aboutTheCamera(way));
  }
  // An image so far in time from colour, of which nothing tells the way.
  void addUnknown(double seconds, double turn_rad_s = tuning::kTurnApart) {
    const double own_s = std::min(seconds, tuning::kMostApartS);
    apart_s = std::max(apart_s, own_s);
    widen(turn_rad_s * own_s, tuning::kSpeedApart * own_s);
  }
  // Other images of the same frame.
  void add(const BetweenImages &other) {
    apart_s = std::max(apart_s, other.apart_s);
    widen(other.turn_sigma_rad, other.shift_sigma_m);
  }

 private:
  static constexpr double kPointsM = 1;  // so much of a turn's error, in m a rad, moves the camera's place

  // Points turn about the camera, some metres away.
  static double aboutTheCamera(const Way &way) { return hypotOf(way.shift_sigma_m, kPointsM * way.turn_sigma_rad); }
  void widen(double turn_rad, double shift_m) {
    turn_sigma_rad = std::max(turn_sigma_rad, turn_rad);
    shift_sigma_m = std::max(shift_sigma_m, shift_m);
  }
};

}  // namespace sphc
