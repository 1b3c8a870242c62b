// Do poses and depth have one scale, or would they if poses were inverted, or their axes mirrored?  The same
// keypoints of two frames say how far the camera went, in units of their depth: no pose takes part in finding them.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "host/import/point_tracks.h"

namespace sphc::host {

class PoseScaleCheck {
 public:
  // So many frames are to come.
  void begin(const Camera &camera, uint32_t frames);
  // Frame after frame.
  void add(const Rigid &world_from_camera, const std::vector<Observation> &observations);
  PoseScale result() const;

 private:
  static constexpr int kSteps = 40, kBins = 2 * kSteps + 1;  // of the multiple's logarithm, to either side of 1
  static constexpr size_t kMistakes = 8;

  void compare(const Rigid &world_from_camera, const std::vector<Observation> &observations);
  // Whether a point of the camera lies where the keypoint is.
  bool agrees(const Vector3 &point_m, const Observation &match) const;

  Camera camera_;
  uint32_t every_ = 1, count_ = 0;
  bool has_first_ = false;
  Rigid world_from_first_;
  std::vector<Observation> first_;
  uint32_t matches_ = 0;
  std::array<uint32_t, kBins> votes_ = {};            // for multiples
  std::array<uint32_t, kMistakes> corrections_ = {};  // for what corrects a mistake
};

}  // namespace sphc::host
