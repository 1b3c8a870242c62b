#include "host/report/reliability_plot.h"

#include <algorithm>
#include <cmath>

#include "host/base/counted.h"

namespace sphc::host {
namespace {

const char *const kColors[] = {"#2563eb", "#d97706", "#16a34a", "#7c3aed", "#dc2626", "#0891b2"};
constexpr double kHistogramHeight = 0.16;  // of the diagram's

std::string blockName(size_t i) { return "$s" + std::to_string(i); }
std::string color(size_t i) { return std::string(" linecolor rgb '") + kColors[i % std::size(kColors)] + "'"; }

// Wilson's 95 % interval of a share.
std::string interval(const ReliabilityBin &bin) {
  const double z = 1.96, n = static_cast<double>(bin.count), p = bin.correct, scale = 1 / (1 + z * z / n);
  const double middle = scale * (p + z * z / (2 * n));
  const double half = scale * z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return fixed(std::max(0.0, middle - half), 4) + " " + fixed(std::min(1.0, middle + half), 4);
}

std::string points(const std::vector<Graded> &graded, const std::string &name) {
  std::string text = name + " << EOD\n";
  for (const ReliabilityBin &bin : equalWidthBins(graded))
    text += fixed(bin.confidence, 4) + " " + fixed(bin.correct, 4) + " " + interval(bin) + "\n";
  if (graded.empty()) text += "NaN NaN NaN NaN\n";
  return text + "EOD\n";
}

// Bars of all answers, as shares of the fullest bin.
std::string histogram(const std::vector<ReliabilitySeries> &series) {
  std::vector<size_t> counts(kReliabilityBins);
  for (const ReliabilitySeries &s : series)
    for (const Graded &g : s.graded)
      ++counts[std::min(static_cast<size_t>(std::clamp(g.confidence, 0.0, 1.0) * kReliabilityBins),
                        kReliabilityBins - 1)];
  const double most = static_cast<double>(std::max<size_t>(1, *std::max_element(counts.begin(), counts.end())));
  std::string text = "$counts << EOD\n";
  for (size_t i = 0; i < counts.size(); ++i)
    text += fixed((static_cast<double>(i) + 0.5) / kReliabilityBins, 2) + " " +
            fixed(kHistogramHeight * static_cast<double>(counts[i]) / most, 4) + " " + std::to_string(counts[i]) +
            "\n";
  return text + "EOD\n";
}

}  // namespace

std::string reliabilityScript(const std::vector<ReliabilitySeries> &series) {
  std::string script = kPlotLook + histogram(series), plots;
  for (size_t i = 0; i < series.size(); ++i) {
    script += points(series[i].graded, blockName(i));
    plots += ", " + blockName(i) + " using 1:2:3:4 with yerrorbars pointtype 7 pointsize 0.6 linewidth 1" +
             color(i) + " notitle, " + blockName(i) + " using 1:2 with lines linewidth 2" + color(i) + " title '" +
             series[i].name + "'";
  }
  script +=
      "set size square\nset xrange [0:1]\nset yrange [0:1]\nset xtics 0.2\nset ytics 0.2\n"
      "set xlabel 'confidence'\nset ylabel 'share within 5 cm and 5 deg'\n"
      "set key outside bottom center reverse Left samplen 2 noenhanced\n"
      "set style fill solid noborder\nset boxwidth 0.09\n";
  return script +
         "plot $counts using 1:2 with boxes linecolor rgb '#e2e8f0' title 'number of answers', "
         "$counts using 1:2:3 with labels offset 0,0.6 font ',9' textcolor rgb '#94a3b8' notitle, "
         "x with lines linewidth 1.5 dashtype 2 linecolor rgb '#64748b' title 'as it should be'" +
         plots;
}

Drawing reliability(const Run &run) {
  const std::vector<Graded> graded = gradedFrames(run);
  if (graded.empty()) return {"reliability", "", "", "", {}};
  const double error = calibrationError(equalWidthBins(graded));
  return {"reliability",
          "Is it as sure as it may be?",
          "Poses with confidence 0.8, say, should be within 5 cm and 5 deg in 80 % of cases: on the dashed line. "
          "Expected calibration error " +
              fixed(error, 3) + " over " + counted(graded.size(), "pose") + ", 10 bins of equal width.",
          reliabilityScript({{"this run", graded}}),
          {560, 620}};
}

}  // namespace sphc::host
