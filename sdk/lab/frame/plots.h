// The frame bench's drawings: where the time goes, and how it grows with the map.
#pragma once
#include "lab/frame/table.h"
#include "lab/pose/plots.h"

namespace sphc::host {

// Median time of each stage, a bar a variant; `ours` alone leaves the peers out, beside whom we are hard to see.
BenchDrawing drawFrameStages(const FrameTable &table, bool ours);
// Median time of a frame against the points of the map, a line a variant; an empty script for less than two maps.
BenchDrawing drawFrameScaling(const std::vector<FrameTable> &tables);

std::vector<BenchDrawing> frameDrawings(const std::vector<FrameTable> &tables);

}  // namespace sphc::host
