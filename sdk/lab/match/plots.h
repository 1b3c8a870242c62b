// The bench's drawing of matchers: time against the size of the map.
#pragma once
#include "host/report/gnuplot.h"
#include "lab/match/bench.h"

namespace sphc::host {

// match_time.svg and .png, into a folder that exists.
PlotResult writeMatchDrawings(const std::string &folder, const std::vector<MatchTable> &tables);

}  // namespace sphc::host
