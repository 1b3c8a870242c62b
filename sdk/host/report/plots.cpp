#include "host/report/plots.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "host/report/top_view.h"

namespace sphc::host {
namespace {

const char kBlueHex[] = "#2563eb", kGreenHex[] = "#16a34a", kRedHex[] = "#dc2626", kAmberHex[] = "#d97706",
           kVioletHex[] = "#7c3aed";

using Points = std::vector<std::array<double, 3>>;

// A gnuplot data block.  An empty one is an error in gnuplot; a point that is not a number draws nothing.
std::string block(const std::string &name, const Points &points) {
  std::string text = "$" + name + " << EOD\n";
  for (const auto &p : points) text += fixed(p[0], 6) + " " + fixed(p[1], 6) + " " + fixed(p[2], 6) + "\n";
  if (points.empty()) text += "NaN NaN NaN\n";
  return text + "EOD\n";
}

std::string color(const char *rgb) { return std::string("linecolor rgb '") + rgb + "'"; }

// ---- path ----

struct Path {
  Points truth, estimate, unjudged, lost;  // unjudged: answers where the truth is not known
  Points centres;
  TopView view;
};

// Of several maps, each with a frame of its own: the one that most answers are in.  SPHC_MAP_NONE: all share one.
uint32_t mapToDraw(const Run &run) { return basesOfAnswers(run) < 2 ? SPHC_MAP_NONE : mapOfMostAnswers(run); }

bool isDrawn(const FrameRecord &frame, uint32_t map) {
  return map == SPHC_MAP_NONE || (frame.localized && frame.map == map);
}

Path splitPath(const Run &run, uint32_t map) {
  std::vector<sphc_rigid> poses;
  for (const FrameRecord &frame : run.frames) {
    if (!isDrawn(frame, map)) continue;
    if (frame.has_truth)
      poses.push_back(frame.truth_base_from_camera);
    else if (frame.localized)
      poses.push_back(frame.base_from_camera);
  }
  Path path;
  const TopView view = path.view = topView(poses);
  for (size_t i = 0; i < run.centres_m.size(); ++i) {
    if (run.centres_m.size() > 1 && map != SPHC_MAP_NONE && i != map) continue;
    const auto centre = view.project(run.centres_m[i].data());
    path.centres.push_back({centre[0], centre[1], 0});
  }
  for (const FrameRecord &frame : run.frames) {
    if (!isDrawn(frame, map)) continue;
    const auto truth = view.project(frame.truth_base_from_camera.t_m),
               seen = view.project(frame.base_from_camera.t_m);
    if (frame.has_truth) path.truth.push_back({truth[0], truth[1], 0});
    if (frame.has_truth && !frame.localized) path.lost.push_back({truth[0], truth[1], 0});
    if (!frame.localized) continue;
    if (frame.has_truth)
      path.estimate.push_back({seen[0], seen[1], 100 * frame.translation_error_m});
    else
      path.unjudged.push_back({seen[0], seen[1], 0});
  }
  return path;
}

// What the picture has to hold, with a margin around it.
struct Extent {
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};

  void hold(double x, double y) {
    low[0] = std::min(low[0], x);
    low[1] = std::min(low[1], y);
    high[0] = std::max(high[0], x);
    high[1] = std::max(high[1], y);
  }
  double length() const { return std::max(high[0] - low[0], high[1] - low[1]); }
  // How much longer it would get if it held the point too.
  double lengthWith(const std::array<double, 3> &point) const {
    Extent larger = *this;
    larger.hold(point[0], point[1]);
    return larger.length();
  }
};

// Leaves out the sphere centres that are so far off that the path would shrink to a dot.
Extent extentOf(Path *path) {
  Extent e;
  for (const Points *points : {&path->truth, &path->estimate, &path->unjudged}) {
    for (const auto &p : *points) e.hold(p[0], p[1]);
  }
  const double most = 1.6 * e.length();
  const auto is_far = [&e, most](const auto &centre) { return e.lengthWith(centre) >= most; };
  path->centres.erase(std::remove_if(path->centres.begin(), path->centres.end(), is_far), path->centres.end());
  for (const auto &centre : path->centres) e.hold(centre[0], centre[1]);
  const double margin = 0.05 + 0.06 * e.length();
  for (size_t i = 0; i < 2; ++i) {
    e.low[i] -= margin;
    e.high[i] += margin;
  }
  return e;
}

// Tall paths get tall pictures, within reason.
PlotSize pathSize(const Extent &e) {
  const double shape = (e.high[1] - e.low[1]) / (e.high[0] - e.low[0]);
  return {560, static_cast<int>(std::clamp(100 + 430 * shape, 240.0, 560.0))};
}

std::string range(const char *axis, double low, double high) {
  return std::string("set ") + axis + " [" + fixed(low, 6) + ":" + fixed(high, 6) + "]\n";
}

const char kErrorColors[] =
    "set palette defined (0 '#16a34a', 0.5 '#facc15', 1 '#dc2626')\n"
    "set cbrange [0:5]\n"
    "set label 'cm off' at screen 0.915, 0.86 textcolor rgb '#334155'\n"
    "set colorbox user origin 0.93,0.2 size 0.018,0.6 noborder\n"
    "set rmargin 9\n";

// 1, 2 or 5 times a power of ten, with at most ten of it in the length.
double ticStep(double length) {
  const double least = length / 10, decade = std::pow(10, std::floor(std::log10(least)));
  for (const double step : {1, 2, 5})
    if (step * decade >= least) return step * decade;
  return 10 * decade;
}

// One step for both axes, on which a metre is as long; a short one has a tic too.
std::string pathTics(const Extent &extent) {
  const double step = ticStep(extent.length());
  std::string script;
  for (size_t i = 0; i < 2; ++i)
    script += std::string("set ") + (i ? "y" : "x") + "tics " +
              fixed(extent.high[i] - extent.low[i] < step ? step / 2 : step, 6) + "\n";
  return script;
}

std::string pathLabels(const TopView &view) {
  if (!view.is_up_an_axis) return "set xlabel 'metres'\nset ylabel 'metres'\n";
  const auto name = [](const std::array<double, 3> &axis) {
    return "xyz"[std::max_element(axis.begin(), axis.end()) - axis.begin()];
  };
  return std::string("set xlabel '") + name(view.right) + ", metres'\nset ylabel '" + name(view.up) + ", metres'\n";
}

std::string pathScript(const Path &path, const Extent &extent) {
  const bool truth = !path.truth.empty();
  std::string script = kPlotLook + block("truth", path.truth) + block("estimate", path.estimate) +
                       block("unjudged", path.unjudged) + block("lost", path.lost) + block("centre", path.centres);
  script += "set size ratio -1\n" + pathLabels(path.view) + pathTics(extent);
  script += range("xrange", extent.low[0], extent.high[0]) + range("yrange", extent.low[1], extent.high[1]);
  script += "set key at screen 0.5, screen 0.99 center top horizontal reverse Left samplen 2\nset tmargin 3.5\n";
  const bool coloured = !path.estimate.empty();
  if (coloured) script += kErrorColors;
  const std::string dots = " with points pointtype 7 pointsize 0.7 ";
  script += "plot ";
  if (truth) script += "$truth using 1:2 with lines linewidth 5 linecolor rgb '#cbd5e1' title 'truth'";
  if (coloured) script += ", $estimate using 1:2:3" + dots + "linecolor palette title 'estimate'";
  if (!path.unjudged.empty())
    script += (truth ? ", " : "") + std::string("$unjudged using 1:2") + dots + color(kBlueHex) +
              (truth ? " title 'truth not known'" : " title 'estimate'");
  const std::string mark = " with points linewidth 1.8 ";
  if (!path.lost.empty())
    script += ", $lost using 1:2" + mark + "pointtype 2 " + color(kRedHex) + " title 'not localized'";
  if (!path.centres.empty())
    script += ", $centre using 1:2" + mark + "pointtype 3 pointsize 1.6 " + color(kVioletHex) + " title 'sphere " +
              (path.centres.size() > 1 ? "centres'" : "centre'");
  return script;
}

// ---- cumulative errors ----

// Share (percent) of all frames with truth whose error is at most x; frames not localized never come in.
Points cumulative(const Run &run, double (*error)(const FrameRecord &)) {
  std::vector<double> errors;
  size_t total = 0;
  for (const FrameRecord &frame : run.frames) {
    if (!frame.has_truth) continue;
    ++total;
    if (frame.localized) errors.push_back(error(frame));
  }
  std::sort(errors.begin(), errors.end());
  Points points;
  for (size_t i = 0; i < errors.size(); ++i) {
    const double before = 100.0 * static_cast<double>(i) / static_cast<double>(total);
    const double after = 100.0 * static_cast<double>(i + 1) / static_cast<double>(total);
    points.push_back({errors[i], before, 0});
    points.push_back({errors[i], after, 0});
  }
  return points;
}

std::string markScript(double mark, const std::string &text) {
  const std::string at = fixed(mark, 3);
  return "set arrow from first " + at + ", graph 0 to first " + at + ", graph 1 nohead dashtype 2 linewidth 1.5 " +
         color(kGreenHex) + "\nset label '" + text + "' at first " + at +
         ", graph 0.06 right offset -0.8,0 textcolor rgb '" + kGreenHex + "'\n";
}

// gnuplot numbers whole powers of ten alone, of which a short range may hold none.
std::string logarithmicTics(double left, double right) {
  const bool is_long = right > 1e4 * left;
  std::string places;
  for (double decade = std::pow(10, std::floor(std::log10(left))); decade <= right; decade *= 10) {
    for (const double step : {1, 2, 5}) {
      if (step * decade < left || step * decade > right || (is_long && step > 1)) continue;
      char place[32];
      std::snprintf(place, sizeof place, "%g", step * decade);
      places += (places.empty() ? "" : ", ") + std::string(place);
    }
  }
  return "set xtics (" + places + ")\n";
}

// Above the drawing, where no curve is.  `share`: per cent of the frames that were localized.
std::string allWithinScript(double share, const std::string &mark_text) {
  const bool all = share > 100 - 1e-9;
  return std::string("set tmargin 2\nset label '") + (all ? "" : "those localized: ") + "all far within " +
         mark_text + "' at graph 1, graph 1.05 right textcolor rgb '" + (all ? kGreenHex : "#334155") + "'\n";
}

std::string cdfScript(const Points &points, const std::string &unit, double mark, const std::string &mark_text) {
  if (points.empty()) return "";
  const double worst = points.back()[0];
  const bool marked = worst > mark / 3;  // else the mark would squeeze the curve to the left edge
  const double right = marked ? std::max(1.3 * mark, 1.1 * worst) : 1.15 * worst;
  const bool logarithmic = right > 4 * mark;  // and so would a long tail
  const double left = logarithmic ? std::clamp(0.8 * points.front()[0], 1e-3, mark / 3) : 0;
  std::string script = kPlotLook + block("cdf", points);
  script += "set yrange [0:100]\nset ylabel 'share of frames, %'\nset xlabel 'error, " + unit + "'\n";
  if (logarithmic) script += "set logscale x\n" + logarithmicTics(left, right);
  script += range("xrange", left, right);
  script += marked ? markScript(mark, mark_text) : allWithinScript(points.back()[1], mark_text);
  script += "unset key\nset style fill transparent solid 0.10 noborder\n";
  script += "plot $cdf using 1:2 with filledcurves y1=0 " + color(kBlueHex) +
            " notitle, $cdf using 1:2 with lines linewidth 2.5 " + color(kBlueHex) + " notitle";
  return script;
}

}  // namespace

Drawing pathFromTop(const Run &run) {
  const uint32_t map = mapToDraw(run);
  Path path = splitPath(run, map);
  if (path.truth.empty() && path.unjudged.empty()) return {"path", "", "", "", {}};
  const Extent extent = extentOf(&path);
  std::string of, frame = run.base == "map" ? "the map's own frame" : "the world that the map was made in";
  if (map != SPHC_MAP_NONE || (run.maps.size() > 1 && mapsWithAnswers(run) == 1)) {
    of = " in " + run.maps[mapOfMostAnswers(run)].path;
    if (run.base == "map") frame = "that map's own frame";
  }
  const bool is_answered = !path.estimate.empty() || !path.unjudged.empty();
  std::string caption = !is_answered
                            ? "The grey line is where the camera was; not one frame was localized."
                            : "Every dot is one answer" + of + ", " +
                                  (path.truth.empty() ? "in " + frame + "."
                                                      : "coloured by how far it is from the true place (grey line" +
                                                            std::string(run.aligned_frames ? ", aligned)." : ")."));
  if (!path.truth.empty() && !path.unjudged.empty()) caption += " Of the blue ones the true place is not known.";
  if (map != SPHC_MAP_NONE) caption += " Answers in other maps have frames of their own and are not drawn.";
  if (path.centres.size() > 1)
    caption += " The stars are the sphere centres, from which the maps' directions point.";
  else if (!path.centres.empty())
    caption += " The star is the sphere centre, from which the map's directions point.";
  if (!path.view.is_up_an_axis)
    caption +=
        " Above is as the cameras were held on average, and the longest way runs to the right: these are "
        "not the axes of the poses.";
  return {"path", "The path from above", caption, pathScript(path, extent), pathSize(extent)};
}

Drawing translationCdf(const Run &run) {
  const Points points = cumulative(run, [](const FrameRecord &frame) { return 100 * frame.translation_error_m; });
  return {"translation_error",
          "How far off",
          "Read it as: this share of all frames is off by at most so many centimetres. Steep and early is good; "
          "where the "
          "curve ends below 100 %, the rest was not localized.",
          cdfScript(points, "cm", 100 * kGoodTranslationM, "5 cm"),
          {560, 360}};
}

Drawing rotationCdf(const Run &run) {
  const Points points = cumulative(run, [](const FrameRecord &frame) { return frame.rotation_error_deg; });
  return {"rotation_error",
          "How far turned",
          "The same for the direction of view, in degrees.",
          cdfScript(points, "deg", kGoodRotationDeg, "5 deg"),
          {560, 360}};
}

Drawing timeline(const Run &run) {
  if (run.frames.empty()) return {"timeline", "", "", "", {}};
  Points matches, inliers, lost;
  for (const FrameRecord &frame : run.frames) {
    const double x = frame.sequence;
    matches.push_back({x, static_cast<double>(frame.matches), 0});
    if (frame.localized)
      inliers.push_back({x, static_cast<double>(frame.inliers), 0});
    else
      lost.push_back({x, static_cast<double>(frame.inliers), 0});
  }
  const auto [first, last] = std::minmax_element(matches.begin(), matches.end());
  const double left = (*first)[0], right = (*last)[0];
  const bool is_long = run.frames.size() > 300;
  std::string script = kPlotLook + block("matches", matches) + block("inliers", inliers) + block("lost", lost);
  // All digits: a camera's own count may be in the millions, where gnuplot would write powers of ten.
  script +=
      "set format x '%.12g'\nset yrange [0:*]\nset xlabel 'frame'\nset ylabel 'count'\n"
      "set key outside top center horizontal reverse Left samplen 2\n";
  script += range("xrange", left - 0.5, right + 0.5);
  if (right - left < 20) script += "set xtics 1\n";
  script += "set style fill transparent solid 0.15 noborder\n";
  script += std::string("plot $matches using 1:2 with ") +
            (run.frames.size() < 30 ? "linespoints pointtype 7 pointsize 0.6" : "lines") + " linewidth 1.5 " +
            color(kAmberHex) + " title 'matches with the map', " + "$inliers using 1:2 with impulses linewidth 2 " +
            color(kGreenHex) + " title 'agree with the pose'";
  // Crosses of many frames would hide the rest; they get a strip along the axis.
  if (!lost.empty())
    script += std::string(", $lost using 1:") +
              (is_long ? "(0) with points pointtype 5 pointsize 0.4 "
                       : "2 with points pointtype 2 pointsize 1 linewidth 1.5 ") +
              color(kRedHex) + " title 'not localized'";
  return {"timeline",
          "Frame by frame",
          "Matches with fake points are among the amber ones; the green ones agree with one pose. Few green ones "
          "mean a weak answer.",
          script,
          {1140, 340}};
}

Drawing stageTimes(const Summary &summary) {
  Points bars;
  std::string names;
  for (size_t i = 0; i < kStageCount; ++i) {
    const double row = static_cast<double>(kStageCount - 1 - i);
    if (std::isnan(summary.stage_median_ms[i])) return {"stage_times", "", "", "", {}};
    bars.push_back({summary.stage_median_ms[i], row, summary.stage_p90_ms[i]});
    names += (i ? ", '" : "'") + std::string(kStageNames[i]) + "' " + fixed(row, 0);
  }
  std::string script = kPlotLook + block("bars", bars);
  script += "set border 1\nset grid noytics\nunset key\nset ytics scale 0 (" + names +
            ")\nset yrange [-0.6:" + fixed(static_cast<double>(kStageCount) - 0.4, 1) + "]\n";
  script +=
      "set xrange [0:*]\nset offsets 0, graph 0.2, 0, 0\nset xlabel 'milliseconds a frame: bar = median (whisker "
      "= 90 % within)'\nset style fill solid noborder\n";
  script +=
      "plot $bars using (0):2:(0):1:($2-0.3):($2+0.3) with boxxyerror linecolor rgb '#60a5fa', "
      "$bars using 1:2:1:3 with xerrorbars pointtype 0 linewidth 1.5 linecolor rgb '#1e40af', "
      "$bars using 3:2:(sprintf('%.1f (%.1f)', $1, $3)) with labels left offset 1,0 textcolor rgb '#1e293b'";
  return {"stage_times", "Where the time goes", "On this machine, one thread.", script, {560, 300}};
}

}  // namespace sphc::host
