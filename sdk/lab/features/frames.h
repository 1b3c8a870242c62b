// A recording as the extractors see it: grey images and where the camera was.
#pragma once
#include <functional>
#include <vector>

#include "host/recording/recording_reader.h"
#include "lab/common/readable_frames.h"
#include "runtime/geometry/camera.h"
#include "runtime/geometry/rigid.h"
#include "runtime/types/image_view.h"

namespace sphc::host {

struct GrayFrame {
  std::vector<uint8_t> pixels;
  Rigid world_from_camera;
  bool has_pose = false;
};

struct GrayRecording {
  Camera camera;
  std::vector<GrayFrame> frames;

  GrayView view(size_t frame) const {
    return {frames[frame].pixels.data(), camera.width(), camera.height(), camera.width()};
  }
};

// The chosen frames; `unreadable` hears of those that are left out.
GrayRecording readGray(recording::RecordingReader *reader, const Unreadable &unreadable);

}  // namespace sphc::host
