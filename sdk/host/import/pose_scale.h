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
  // Frame after frame; the sequence is the frame's number in its recording.
  void add(uint32_t sequence, const Rigid &world_from_camera, const std::vector<Observation> &observations);
  PoseScale result() const { return all_.result(); }
  // Of stretches of each recording, an eighth of it or longer, where fewer frames share too few keypoints.
  std::vector<PoseScalePart> parts() const;

 private:
  static constexpr int kSteps = 40, kBins = 2 * kSteps + 1;  // of the multiple's logarithm, to either side of 1
  static constexpr size_t kMistakes = 8;

  struct Votes {
    uint32_t matches = 0, fixed_in_image = 0;
    std::array<uint32_t, kBins> multiples = {};
    std::array<uint32_t, kMistakes> corrections = {};  // for what corrects a mistake

    void add(const Votes &more);
    PoseScale result() const;
  };
  struct Part {
    uint32_t recording, first_sequence, last_sequence, frames;
    Votes votes;
  };

  void enterPart(uint32_t sequence);
  Votes compare(const Rigid &world_from_camera, const std::vector<Observation> &observations) const;
  // Whether a point of the camera lies where the keypoint is.
  bool agrees(const Vector3 &point_m, const Observation &match) const;

  Camera camera_;
  uint32_t every_ = 1, count_ = 0;
  uint32_t recordings_ = 0, frames_of_part_ = 1;
  bool has_first_ = false;
  Rigid world_from_first_;
  std::vector<Observation> first_;
  Votes all_;
  std::vector<Part> parts_;
};

}  // namespace sphc::host
