// Correspondences of queries with known poses, from a file: what the pose stage is measured on.
//
// Little-endian, packed: "SPHC", u32 version 1, u32 queries, u32 eta in percent, u32 depth rule, u32 0, f64[3]
// centre; per query u32 length and name, u32 index, f64 fx fy cx cy, u32 0 (no distortion), u32 width, height,
// f64[9] R and f64[3] t (truth, camera_from_map; the map's origin is the sphere centre), u32 rows, rows of 64
// bytes.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/base/span.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {

struct PinholeCamera {
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  uint32_t width_px = 0, height_px = 0;
};

struct PoseRow {
  Vector2 pixel_px;   // the centre of the first pixel is (0.5, 0.5)
  Vector3 direction;  // unit, map frame
  double z_tof_m;     // as the sensor measured; 0: nothing
  double z_oracle_m;  // of the true point; 0: not known
  bool is_true;       // else the direction is a fake
  uint32_t point_id;
};

struct PoseQuery {
  std::string name;
  uint32_t index = 0;
  PinholeCamera camera;
  Rigid camera_from_map;  // truth
  std::vector<PoseRow> rows;
  std::vector<Vector3> points_map_m;  // true points of the rows, when the companion was read
};

struct PoseFile {
  uint32_t eta_percent = 0, depth_rule = 0;
  Vector3 centre_world_m;
  std::vector<PoseQuery> queries;
};

// Both validate every value and throw std::runtime_error with cause and cure; `name` is for messages.
PoseFile parsePoseFile(Span<const uint8_t> bytes, const std::string &name);
PoseFile readPoseFile(const std::string &path);
// Of the queries, each N-th from the first on.
void keepEvery(uint32_t n, PoseFile *file);

// True points beside a file ("X_eta33_dev.bin"): in "X_eta100_dev_xyz.bin", three f64 a row of "X_eta100_dev.bin".
std::string eta100Path(const std::string &path);  // of the same stem; "" when the name has no "_eta<number>"
std::string pointsPath(const std::string &eta100_path);
// Fills points_map_m of all queries.
void parsePosePoints(Span<const uint8_t> bytes, const std::string &name, PoseFile *eta100);
// The eta-100 file with true points that lies beside `path`; no queries when there is none.
PoseFile readTruePoints(const std::string &path);

}  // namespace sphc::host
