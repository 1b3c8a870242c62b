// What several benches say.
#pragma once
#include <string>

#include "host/cli/common/console.h"
#include "host/report/gnuplot.h"
#include "lab/common/readable_frames.h"

namespace sphc::host {

// Of the core that pinToOneCore gave; `clock`: what is measured, when it is not the time that passes.
std::string pinnedText(int core, const std::string &clock = "");

// Of frames that cannot be read: the first, and how many more there are, once the last copy is gone.
Unreadable saidBy(const Console &console);

// That the folder was written, and what became of the drawings in it.
void sayWritten(const std::string &folder, PlotResult drawn, const Console &console);

}  // namespace sphc::host
