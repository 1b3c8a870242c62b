// The metadata of a Record3D recording: cameras, poses and times in JSON.
#pragma once

#include <spherecloud/spherecloud.h>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace sphc::recording {

struct Record3dMetadata {
  std::array<double, 4> params;  // fx, fy, cx, cy in pixels of the colour image; of the frames the median
  double width = 0, height = 0;  // of the colour image that `params` are of
  double depth_width = 0, depth_height = 0;  // 0 where it is not told
  std::vector<int64_t> time_ns;  // of every frame, increasing; from 0 by the rate where the app told no times
  std::vector<std::optional<sphc_rigid>> world_from_camera;  // likewise; camera axes are ours
};

// Throws Failure (ARGUMENT); its text begins with the key.
Record3dMetadata record3dMetadataFrom(std::string_view text);

}  // namespace sphc::recording
