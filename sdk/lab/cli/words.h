// What several benches say.
#pragma once
#include <string>

#include "host/cli/common/console.h"
#include "host/report/gnuplot.h"

namespace sphc::host {

// Of the core that pinToOneCore gave; `clock`: what is measured, when it is not the time that passes.
std::string pinnedText(int core, const std::string &clock = "");

// That the folder was written, and what became of the drawings in it.
void sayWritten(const std::string &folder, PlotResult drawn, const Console &console);

}  // namespace sphc::host
