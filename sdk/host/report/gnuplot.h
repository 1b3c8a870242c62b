// Plots by gnuplot, run as a program of its own.
#pragma once
#include <string>

namespace sphc::host {

extern const char kPlotHead[];  // the first line of every script that is written here
extern const char kPlotLook[];  // one style for all: borders, tics, grid, key

enum class PlotResult { kDone, kNoGnuplot, kFailed };

struct PlotSize {
  int width_px = 760, height_px = 420;
};

// Removes FOLDER/NAME.gp, NAME.svg and NAME.png, as far as they are there.
void removePlot(const std::string &folder, const std::string &name);

// Writes FOLDER/NAME.gp (which anybody can run again) and from it NAME.svg and NAME.png.  `script` is everything
// but terminal and output, and its last line the plot command.  What gnuplot says, if it does, goes to
// FOLDER/gnuplot.log.  Throws std::runtime_error when the folder cannot be written.
PlotResult plot(const std::string &folder, const std::string &name, const std::string &script, PlotSize size);

}  // namespace sphc::host
