#include "lab/pose/plots.h"

#include <algorithm>
#include <map>

#include "host/report/run.h"

namespace sphc::host {
namespace {

const char kLook[] =
    "set border 3 linecolor rgb '#94a3b8'\n"
    "set tics nomirror textcolor rgb '#475569'\n"
    "set xlabel textcolor rgb '#334155'\n"
    "set ylabel textcolor rgb '#334155'\n"
    "set grid linecolor rgb '#e2e8f0' linewidth 1\n"
    "set key textcolor rgb '#334155' noenhanced\n"
    "set ytics noenhanced\n";
const char *const kColors[] = {"#2563eb", "#d97706", "#16a34a", "#7c3aed",
                               "#dc2626", "#0891b2", "#64748b", "#be185d"};

std::string colorOf(size_t i) { return std::string(" linecolor rgb '") + kColors[i % std::size(kColors)] + "'"; }

std::string blockName(size_t i) { return "$d" + std::to_string(i); }

std::string titleOf(const BenchTable &table) {
  return "set title '" + table.file + ", " + depthName(table.depth) +
         " depth' noenhanced textcolor rgb '#334155'\n";
}

std::string stem(const BenchTable &table) { return "pose_" + table.file + "_" + depthName(table.depth); }

// Share of runs with at most this error.
std::string cumulative(const VariantRuns &runs, const std::string &name) {
  std::vector<double> errors_cm;
  for (const PoseSample &sample : runs.samples) errors_cm.push_back(100 * sample.translation_error_m);
  std::sort(errors_cm.begin(), errors_cm.end());
  std::string text = name + " << EOD\n";
  for (size_t i = 0; i < errors_cm.size(); ++i)
    text += fixed(errors_cm[i], 5) + " " +
            fixed(100.0 * static_cast<double>(i + 1) / static_cast<double>(errors_cm.size()), 3) + "\n";
  return text + "EOD\n";
}

struct PlotLine {
  std::string title, points;
};

// A line a variant, file and way of making the cases.
std::vector<PlotLine> growthLines(const std::vector<GrowthRow> &rows, GrowthAxis axis) {
  std::map<std::string, std::string> lines;
  for (const GrowthRow &row : rows) {
    if (row.axis != axis) continue;
    for (const VariantSummary &s : row.summaries) {
      const std::string point = fixed(row.x, 1) + " " + fixed(s.time_ms.median, 5) + "\n";
      const std::string file = axis == GrowthAxis::kCount ? row.file : row.file.substr(0, row.file.find("_eta"));
      const std::string base = s.name + ", " + file + ", " + depthName(row.depth);
      if (row.how != "added") lines[base] += point;
      if (row.how == "added") lines[base + ", rows added"] += point;
    }
  }
  std::vector<PlotLine> list;
  for (const auto &[title, points] : lines) list.push_back({title, points});
  return list;
}

}  // namespace

BenchDrawing drawErrors(const BenchTable &table) {
  std::string script = kLook + titleOf(table), plots;
  for (size_t i = 0; i < table.runs.size(); ++i) {
    script += cumulative(table.runs[i], blockName(i));
    plots += (i ? ", " : "plot ") + blockName(i) + " using 1:2 with lines linewidth 2" + colorOf(i) + " title '" +
             table.runs[i].name + "'";
  }
  script +=
      "set logscale x\nset xrange [0.01:100]\nset yrange [0:100]\nset xlabel 'translation error, cm'\n"
      "set ylabel 'share of runs, %'\nset key bottom right\n";
  return {stem(table) + "_error", script + plots, {760, 420}};
}

BenchDrawing drawTimes(const BenchTable &table) {
  std::string bars = "$bars << EOD\n", names;
  const size_t count = table.summaries.size();
  for (size_t i = 0; i < count; ++i) {
    const VariantSummary &s = table.summaries[i];
    const std::string row = std::to_string(count - 1 - i);
    bars += fixed(s.time_ms.median, 5) + " " + row + " " + fixed(s.time_ms.p99, 5) + "\n";
    names += (i ? ", '" : "'") + s.name + "' " + row;
  }
  const std::string script =
      kLook + titleOf(table) + bars +
      "EOD\nset border 1\nset grid noytics\nunset key\nset logscale x\nset ytics scale 0 (" + names +
      ")\nset yrange [-0.6:" + fixed(static_cast<double>(count) - 0.4, 1) +
      "]\nset xrange [0.02:*]\nset offsets 0, graph 0.1, 0, 0\n"
      "set xlabel 'milliseconds a query: bar = median, whisker = 99 % within'\nset style fill solid noborder\n"
      "plot $bars using (0.02):2:(0.02):1:($2-0.3):($2+0.3) with boxxyerror linecolor rgb '#60a5fa', "
      "$bars using 1:2:1:3 with xerrorbars pointtype 0 linewidth 1.5 linecolor rgb '#1e40af', "
      "$bars using 3:2:(sprintf('%.2f', $1)) with labels left offset 1,0 textcolor rgb '#1e293b'";
  return {stem(table) + "_time", script, {760, static_cast<int>(140 + 34 * count)}};
}

BenchDrawing drawGrowth(const std::vector<GrowthRow> &rows, GrowthAxis axis) {
  const bool count = axis == GrowthAxis::kCount;
  const std::string name = count ? "pose_growth_count" : "pose_growth_eta";
  const std::vector<PlotLine> lines = growthLines(rows, axis);
  if (lines.empty()) return {name, "", {}};
  std::string script = kLook, plots;
  for (size_t i = 0; i < lines.size(); ++i) {
    script += blockName(i) + " << EOD\n" + lines[i].points + "EOD\n";
    plots += (i ? ", " : "plot ") + blockName(i) +
             " using 1:2 smooth unique with linespoints linewidth 2 pointtype 7" + colorOf(i) + " title '" +
             lines[i].title + "'";
  }
  script +=
      std::string("set logscale xy\nset ylabel 'milliseconds a query, median'\nset key outside bottom center\n") +
      (count ? "set xlabel 'correspondences'\n"
             : "set xlabel 'eta, %'\nset xrange [105:9.5]\nset xtics (100, 50, 33, 25, 15, 10)\n");
  return {name, script + plots, {760, static_cast<int>(420 + 20 * lines.size())}};
}

PlotResult writeDrawings(const std::string &folder, const std::vector<BenchDrawing> &drawings) {
  PlotResult worst = PlotResult::kDone;
  for (const BenchDrawing &drawing : drawings) {
    if (drawing.script.empty()) continue;
    const PlotResult drawn = plot(folder, drawing.name, drawing.script, drawing.size);
    if (drawn != PlotResult::kDone) worst = drawn;
  }
  return worst;
}

std::vector<BenchDrawing> poseDrawings(const std::vector<BenchTable> &tables,
                                       const std::vector<GrowthRow> &growth) {
  std::vector<BenchDrawing> drawings;
  for (const BenchTable &table : tables) {
    drawings.push_back(drawErrors(table));
    drawings.push_back(drawTimes(table));
  }
  for (const GrowthAxis axis : {GrowthAxis::kCount, GrowthAxis::kEta}) drawings.push_back(drawGrowth(growth, axis));
  return drawings;
}

}  // namespace sphc::host
