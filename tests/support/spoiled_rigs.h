// Rigs with one field that the check refuses, and the words that it says: whatever takes a rig must say the same.
#pragma once
#include <limits>
#include <vector>

#include "spherecloud/spherecloud.h"

namespace sphc::test {

struct SpoiledRig {
  const char *message;
  void (*spoil)(sphc_rig *rig);  // a good one
};

inline const std::vector<SpoiledRig> &spoiledRigs() {
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  static constexpr double kInf = std::numeric_limits<double>::infinity();
  static const std::vector<SpoiledRig> kAll = {
      {"color_camera.model is 0, which is not known; use an SPHC_CAMERA_ value",
       [](sphc_rig *r) { r->color_camera.model = 0; }},
      {"depth_camera.model is 9, which is not known; use an SPHC_CAMERA_ value",
       [](sphc_rig *r) { r->depth_camera.model = 9; }},
      {"color_camera.param_count is 3; model 1 takes 4",
       [](sphc_rig *r) {
         r->color_camera.model = SPHC_CAMERA_PINHOLE;
         r->color_camera.param_count = 3;
       }},
      {"color_camera.width is 15; it must be 16 to 8192 pixels", [](sphc_rig *r) { r->color_camera.width = 15; }},
      {"depth_camera.height is 8193; it must be 16 to 8192 pixels",
       [](sphc_rig *r) { r->depth_camera.height = 8193; }},
      {"color_camera.params[0] is 0; a focal length must be positive and at most 1000000: check the calibration",
       [](sphc_rig *r) { r->color_camera.params[0] = 0; }},
      {"depth_camera.params[1] is nan; a focal length must be positive and at most 1000000: check the calibration",
       [](sphc_rig *r) { r->depth_camera.params[1] = kNan; }},
      {"depth_camera.params[3] is -inf; a parameter must be finite and not beyond 1000000: check the calibration",
       [](sphc_rig *r) { r->depth_camera.params[3] = -kInf; }},
      {"color_camera.params[10] is 0.25, and model 2 takes 9 parameters; set the others to 0, or give the model "
       "that has them",
       [](sphc_rig *r) {
         r->color_camera.model = SPHC_CAMERA_BROWN5;
         r->color_camera.param_count = 9;
         r->color_camera.params[10] = 0.25;
       }},
      {"color_from_depth.t_m[1] is -10.5; it must lie in -10 to 10: give metres",
       [](sphc_rig *r) { r->color_from_depth.t_m[1] = -10.5; }},
      {"color_from_depth.t_m[2] is nan; it must lie in -10 to 10: give metres",
       [](sphc_rig *r) { r->color_from_depth.t_m[2] = kNan; }},
      {"color_from_depth.q_wxyz has length 0; it must be 1 (order w x y z): divide by its length",
       [](sphc_rig *r) { r->color_from_depth = {}; }},
      {"color_from_depth.q_wxyz has length 1.01; it must be 1 (order w x y z): divide by its length",
       [](sphc_rig *r) {
         r->color_from_depth = {{1.01, 0, 0, 0}, {0, 0, 0}};
       }},
      {"color_from_depth.q_wxyz has length nan; it must be 1 (order w x y z): divide by its length",
       [](sphc_rig *r) { r->color_from_depth.q_wxyz[3] = kNan; }},
      {"depth_unit_m is 0; it must lie in 1e-6 to 0.1 (0.001 for millimetres)",
       [](sphc_rig *r) { r->depth_unit_m = 0; }},
      {"depth_unit_m is 0.11; it must lie in 1e-6 to 0.1 (0.001 for millimetres)",
       [](sphc_rig *r) { r->depth_unit_m = 0.11; }},
      {"depth_unit_m is nan; it must lie in 1e-6 to 0.1 (0.001 for millimetres)",
       [](sphc_rig *r) { r->depth_unit_m = kNan; }},
  };
  return kAll;
}

}  // namespace sphc::test
