// The systems of the paper's table 2 as variants that the bench can run.
#pragma once
#include "lab/baselines/line_clouds.h"
#include "lab/compare/input.h"
#include "lab/pose/variant.h"

namespace sphc::host {

// Uniform lines, PPL, PPL+ and rays through the same points.
std::vector<LineCloud> lineCloudsOf(const std::vector<Vector3> &points_m);

// Queries as all systems get them, and the systems.  Only rows with depth take part in those that need none, so
// that all have the same matches.
std::vector<PoseCase> compareCases(const CompareInput &input, DepthSource source);
std::vector<PoseVariant> compareSystems(const CompareInput &input, DepthSource source);

// "sphere cloud, eta 33 %".
std::string sphereName(uint32_t eta_percent);

}  // namespace sphc::host
