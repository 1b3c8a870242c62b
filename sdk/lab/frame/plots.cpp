#include "lab/frame/plots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/report/run.h"

namespace sphc::host {
namespace {

const char *const kStageColors[] = {"#2563eb", "#0891b2", "#d97706", "#7c3aed"};
const char *const kLineColors[] = {"#2563eb", "#16a34a", "#d97706", "#7c3aed", "#dc2626", "#64748b"};

bool isOurs(const FrameSummary &s) { return s.pose.name.rfind("ours", 0) == 0; }

double shownMs(const FrameSummary &s, Stage stage) { return std::isnan(s.stage_ms[stage]) ? 0 : s.stage_ms[stage]; }

std::string look(const FrameTable &table) {
  return std::string(kPlotLook) + "set key noenhanced\nset title '" + table.recording + ", " +
         std::to_string(table.points) + " points' noenhanced textcolor rgb '#334155'\n";
}

// A row a variant: place, then where each stage ends; the last is the label.
std::string stageRows(const std::vector<const FrameSummary *> &shown, std::string *names) {
  std::string rows = "$bars << EOD\n";
  for (size_t i = 0; i < shown.size(); ++i) {
    const std::string place = std::to_string(shown.size() - 1 - i);
    double end = 0;
    rows += place + " 0";
    for (const Stage stage : kStages) rows += " " + fixed(end += shownMs(*shown[i], stage), 4);
    rows += " " + fixed(shown[i]->pose.time_ms.median, 4) + "\n";
    *names += (i ? ", '" : "'") + shown[i]->pose.name + "' " + place;
  }
  return rows + "EOD\n";
}

std::string scalingRows(const std::vector<FrameTable> &tables, size_t variant) {
  std::string rows;
  for (const FrameTable &table : tables)
    rows += std::to_string(table.points) + " " + fixed(table.summaries[variant].pose.time_ms.median, 4) + "\n";
  return rows;
}

// Room around what was measured, whatever becomes of the dashed line.
std::string scalingRange(const std::vector<FrameTable> &tables) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const FrameTable &table : tables) {
    for (const FrameSummary &s : table.summaries) {
      least = std::min(least, s.pose.time_ms.median);
      most = std::max(most, s.pose.time_ms.median);
    }
  }
  return "set yrange [" + fixed(0.5 * least, 4) + ":" + fixed(2 * most, 4) + "]\n";
}

}  // namespace

BenchDrawing drawFrameStages(const FrameTable &table, bool ours) {
  std::vector<const FrameSummary *> shown;
  for (const FrameSummary &s : table.summaries)
    if (!ours || isOurs(s)) shown.push_back(&s);
  std::string names, plots;
  const std::string rows = stageRows(shown, &names);
  for (size_t i = 0; i < std::size(kStages); ++i) {
    const std::string from = std::to_string(i + 2), to = std::to_string(i + 3);
    plots += (i ? ", " : "plot ") + std::string("$bars using ") + from + ":1:" + from + ":" + to +
             ":($1-0.3):($1+0.3) with boxxyerror linecolor rgb '" + kStageColors[i] + "' title '" +
             kStageNames[kStages[i]] + "'";
  }
  plots += ", $bars using 6:1:(sprintf('%.1f', $7)) with labels left offset 0.5,0 textcolor rgb '#1e293b' notitle";
  const std::string script =
      look(table) + rows + "set border 1\nset grid noytics\nset ytics noenhanced scale 0 (" + names +
      ")\nset yrange [-0.6:" + fixed(static_cast<double>(shown.size()) - 0.4, 1) +
      "]\nset xrange [0:*]\nset offsets 0, graph 0.1, 0, 0\nset xlabel 'milliseconds a frame, medians'\n"
      "set key outside top center horizontal\nset style fill solid noborder\n" +
      plots;
  const std::string name = "frame_" + table.recording + "_" + std::to_string(table.points) + "_stages";
  return {name + (ours ? "_ours" : ""), script, {760, static_cast<int>(170 + 38 * shown.size())}};
}

BenchDrawing drawFrameScaling(const std::vector<FrameTable> &tables) {
  if (tables.size() < 2) return {"frame_scaling", "", {}};
  std::string script = std::string(kPlotLook) + "set key noenhanced\n", plots;
  for (size_t i = 0; i < tables[0].summaries.size(); ++i) {
    const std::string block = "$d" + std::to_string(i), color = kLineColors[i % std::size(kLineColors)];
    script += block + " << EOD\n" + scalingRows(tables, i) + "EOD\n";
    plots += (i ? ", " : "plot ") + block + " using 1:2 with linespoints linewidth 2 pointtype 7 linecolor rgb '" +
             color + "' title '" + tables[0].summaries[i].pose.name + "', " + block +
             " using 1:2:(sprintf('%.1f', $2)) with labels offset 0," + (i == 1 ? "-0.9" : "0.9") +
             " textcolor rgb '" + color + "' notitle";
  }
  // How steep growth in proportion to the map would be, from our first point.
  plots += ", " + fixed(tables[0].summaries[0].pose.time_ms.median, 4) + " * x / " +
           std::to_string(tables[0].points) +
           " with lines dashtype 2 linecolor rgb '#94a3b8' title 'proportional to the map'";
  script +=
      "set logscale xy\nset xlabel 'points of the map'\nset ylabel 'milliseconds a frame, median'\n"
      "set format x '%.0s %c'\nset xrange [" +
      fixed(0.7 * tables.front().points, 0) + ":" + fixed(1.4 * tables.back().points, 0) +
      "]\nset key outside top center\n" + scalingRange(tables);
  return {"frame_scaling", script + plots, {760, static_cast<int>(440 + 20 * tables[0].summaries.size())}};
}

std::vector<BenchDrawing> frameDrawings(const std::vector<FrameTable> &tables) {
  std::vector<BenchDrawing> drawings;
  for (const FrameTable &table : tables) {
    drawings.push_back(drawFrameStages(table, true));
    if (drawings.back().script != drawFrameStages(table, false).script)
      drawings.push_back(drawFrameStages(table, false));
  }
  drawings.push_back(drawFrameScaling(tables));
  return drawings;
}

}  // namespace sphc::host
