// Frames of a recording as a localizer sees them before it matches: keypoints, descriptors and depths.
#pragma once
#include <string>
#include <vector>

#include "host/recording/recording_reader.h"
#include "lab/pose/file.h"
#include "runtime/types/keypoint.h"

namespace sphc::host {

struct DescribedFrame {
  std::string name;  // its number
  PinholeCamera camera;
  Rigid camera_from_world;  // truth
  // Of each keypoint: where a camera without distortion would see it, its depth (0: none), its descriptor.
  std::vector<Vector2> pixels_px;
  std::vector<double> depths_m;
  std::vector<Descriptor> descriptors;
};

// All chosen frames that have a pose, by the library's own extractor (1000 keypoints) and aligner.  Throws
// std::runtime_error with cause and cure when there is none.
std::vector<DescribedFrame> describeFrames(recording::RecordingReader *reader);

}  // namespace sphc::host
