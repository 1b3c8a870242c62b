// What the C interface's opaque handles point to.
#pragma once
#include "runtime/capi/check.h"
#include "runtime/localizer/localizer.h"
#include "runtime/map/map_view.h"
#include "runtime/stages/align/dense.h"
#include "runtime/stages/align/depth_reader.h"
#include "runtime/stages/capture/clock_mapper.h"
#include "runtime/stages/capture/pairer.h"

struct sphc_map {
  sphc::MapView view;
};

namespace sphc {

struct ImageSize {
  uint32_t width = 0, height = 0;
};

// Of the images of a rig's cameras, the colour camera's first.
struct ImageSizes {
  uint32_t count = 0;
  ImageSize of[kMostCameras];
};
ImageSizes imageSizesOf(const LocalizerConfig &config);
bool operator==(const ImageSizes &a, const ImageSizes &b);

}  // namespace sphc

struct alignas(sphc::kArenaAlignment) sphc_localizer {
  sphc::Localizer localizer;
  sphc::MemoryRange state, scratch;
  uint32_t max_keypoints;
  sphc_format depth_formats[SPHC_DEPTH_CAMERAS_MAX];
  sphc_band color_band;
  bool has_clock;
  sphc_log_fn log;
  void *log_user;
  sphc_log_level log_level;
  uint32_t logged_faults, logged;
  uint32_t stuck;        // frames in a row whose time did not grow
  int64_t last_time_ns;  // of a frame
  sphc_message message;

  // Where the call that begins explains a failure.
  sphc_message *beginCall() {
    message.text[0] = '\0';
    return &message;
  }
};

struct alignas(sphc::kArenaAlignment) sphc_features {
  sphc::FrameFeatures features;
  sphc::MemoryRange memory;
  sphc_camera color;
  sphc::ImageSizes sizes;
  uint32_t max_keypoints;
  bool of_frame;
  int64_t color_time_ns;
  sphc_message message;
};

struct alignas(sphc::kArenaAlignment) sphc_aligner {
  sphc::DepthReader reader;
  sphc::DenseAligner aligner;
  sphc_camera color, depth;
  sphc_format depth_format;
  sphc_message message;
};

struct sphc_pairer {
  sphc::Pairer pairer;
};

struct sphc_clock_mapper {
  sphc::ClockMapper mapper;
};
