#include "lab/match/plots.h"

#include <map>

#include "host/report/run.h"

namespace sphc::host {

PlotResult writeMatchDrawings(const std::string &folder, const std::vector<MatchTable> &tables) {
  std::map<std::string, std::string> lines;
  for (const MatchTable &table : tables)
    for (const MatchRow &row : table.rows)
      lines[row.name] += std::to_string(table.points) + " " + fixed(row.time_ms, 4) + "\n";
  std::string script = kPlotLook, plots;
  for (const auto &[name, points] : lines) {
    const std::string block = "$d" + std::to_string(plots.size());
    script += block + " << EOD\n" + points + "EOD\n";
    plots += (plots.empty() ? "plot " : ", ") + block + " using 1:2 with linespoints linewidth " +
             (name.rfind("ours", 0) == 0 ? "3" : "1") + " title '" + name + "'";
  }
  script +=
      "set logscale xy\nset xlabel 'points of the map'\nset ylabel 'ms for all queries'\n"
      "set key outside right noenhanced\n";
  return plot(folder, "match_time", script + plots, {900, 520});
}

}  // namespace sphc::host
