// The bench's drawings: error distributions, times, growth.
#pragma once
#include "host/report/gnuplot.h"
#include "lab/pose/growth.h"
#include "lab/pose/table.h"

namespace sphc::host {

struct BenchDrawing {
  std::string name, script;
  PlotSize size;
};

BenchDrawing drawErrors(const BenchTable &table);  // cumulative translation and rotation errors
BenchDrawing drawTimes(const BenchTable &table);   // median and 99 % of every variant
// Time against rows or eta, a line a variant and file; an empty script when there is nothing on that axis.
BenchDrawing drawGrowth(const std::vector<GrowthRow> &rows, GrowthAxis axis);

std::vector<BenchDrawing> poseDrawings(const std::vector<BenchTable> &tables, const std::vector<GrowthRow> &growth);

// Those that have a script, into a folder that exists; the worst result of them.
PlotResult writeDrawings(const std::string &folder, const std::vector<BenchDrawing> &drawings);

}  // namespace sphc::host
