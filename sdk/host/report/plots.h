// The report's drawings, as gnuplot scripts that carry their data.  An empty script: nothing to draw.
#pragma once
#include <string>

#include "host/report/gnuplot.h"
#include "host/report/statistics.h"

namespace sphc::host {

struct Drawing {
  std::string name, title, caption;
  std::string script;
  PlotSize size;
};

Drawing pathFromTop(const Run &run);
Drawing translationCdf(const Run &run);
Drawing rotationCdf(const Run &run);
Drawing timeline(const Run &run);
Drawing stageTimes(const Summary &summary);

}  // namespace sphc::host
