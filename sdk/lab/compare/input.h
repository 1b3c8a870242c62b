// What systems are compared on: one place, its points, and queries with their matches.
#pragma once
#include <string>
#include <unordered_map>
#include <vector>

#include "host/cli/common/recording_options.h"
#include "lab/pose/file.h"

namespace sphc::host {

struct ComparedSphere {
  PoseFile queries;                 // the same rows as of the true points, with this cloud's directions
  std::vector<Vector3> directions;  // of each point of the map
};

struct CompareInput {
  std::string name;
  std::vector<Vector3> points_m;                       // of the map, about the sphere centre
  std::unordered_map<uint32_t, uint32_t> place_of_id;  // of a row's point_id in points_m
  PoseFile true_points;                                // rows with their true directions and points: eta 100
  std::vector<ComparedSphere> spheres;
};

// From correspondence files of one place.  Throws std::runtime_error with cause and cure.
CompareInput readCompareInput(const std::vector<std::string> &paths, uint32_t every);

struct CompareRecordingOptions {
  RecordingOptions mapping, queries;
  std::vector<double> etas = {1, 1.0 / 3};
};

// From a recording: a map of some frames, the others matched to it by the exact ratio test.  The fakes are the
// paper's.  Their key is known to everybody: nothing of this may be shipped.
CompareInput recordCompareInput(const CompareRecordingOptions &options);

}  // namespace sphc::host
