#include "lab/compare/attack.h"

#include <algorithm>
#include <cmath>

#include "host/audit/attack/density.h"
#include "host/audit/score/point_errors.h"
#include "host/cli/common/progress.h"
#include "host/report/run.h"
#include "host/report/statistics.h"
#include "lab/compare/systems.h"
#include "lab/pose/table.h"

namespace sphc::host {
namespace {

constexpr double kNearM = 0.05, kRoughlyM = 0.25;
constexpr size_t kCurvePoints = 400;

AttackedCloud attack(const LineCloud &cloud, const std::vector<Vector3> &points_m) {
  ProgressBar bar("attacking ");
  constexpr uint64_t kTell = 1000;
  const std::vector<Vector3> recovered_m = attackByDensity(cloud.lines, {}, [&bar](uint64_t done, uint64_t total) {
    if (done % kTell == 0) bar.show(static_cast<uint32_t>(done / kTell), static_cast<uint32_t>(total / kTell));
  });
  AttackedCloud attacked;
  attacked.name = cloud.name;
  attacked.errors_m = pointErrors(points_m, cloud.line_of_point, recovered_m);
  attacked.nearest_errors_m = nearestPointErrors(points_m, cloud.line_of_point, recovered_m);
  attacked.has_centre = !cloud.centres_m.empty();
  for (const Vector3 &centre_m : cloud.centres_m)
    attacked.at_centre_percent += 100 * shareWithin(recovered_m, centre_m, kAtCentreM);
  return attacked;
}

double medianCm(const AttackedCloud &cloud) { return 100 * percentile(cloud.errors_m, 0.5); }
double nearestCm(const AttackedCloud &cloud) { return 100 * percentile(cloud.nearest_errors_m, 0.5); }

std::string centreText(const AttackedCloud &cloud) {
  return cloud.has_centre ? fixed(cloud.at_centre_percent, 2) + " %" : "-";
}

// Share within each error, thinned out.
std::string curve(const AttackedCloud &cloud, const std::string &name) {
  std::vector<double> sorted_m = cloud.errors_m;
  std::sort(sorted_m.begin(), sorted_m.end());
  std::string text = name + " << EOD\n";
  const size_t count = std::min(kCurvePoints, sorted_m.size());
  for (size_t k = 1; k <= count; ++k) {
    const size_t rank = k * sorted_m.size() / count;
    text += fixed(std::max(100 * sorted_m[rank - 1], 1e-3), 4) + " " +
            fixed(100.0 * static_cast<double>(rank) / static_cast<double>(sorted_m.size()), 2) + "\n";
  }
  return text + "EOD\n";
}

}  // namespace

std::vector<AttackedCloud> attackClouds(const CompareInput &input) {
  std::vector<AttackedCloud> attacked;
  for (const LineCloud &cloud : lineCloudsOf(input.points_m)) attacked.push_back(attack(cloud, input.points_m));
  for (const ComparedSphere &sphere : input.spheres) {
    attacked.push_back(attack(centralLineCloud(sphere.directions), input.points_m));
    attacked.back().eta_percent = sphere.queries.eta_percent;
    attacked.back().name = sphereName(sphere.queries.eta_percent);
    if (sphere.queries.eta_percent < 100) attacked.back().strategy = "gaussian";
  }
  return attacked;
}

std::string attackText(const std::string &input, const std::vector<AttackedCloud> &clouds) {
  std::vector<std::vector<std::string>> rows = {
      {"cloud", "lines", "median cm", "nearest", "p25 cm", "p75 cm", "within 5 cm", "within 25 cm", "at a centre"}};
  for (const AttackedCloud &c : clouds)
    rows.push_back({c.name, std::to_string(c.nearest_errors_m.size()), fixed(medianCm(c), 2),
                    fixed(nearestCm(c), 2), fixed(100 * percentile(c.errors_m, 0.25), 2),
                    fixed(100 * percentile(c.errors_m, 0.75), 2),
                    fixed(100 * shareUpTo(c.errors_m, kNearM), 1) + " %",
                    fixed(100 * shareUpTo(c.errors_m, kRoughlyM), 1) + " %", centreText(c)});
  return input + ": density attack, error of the point recovered for each point's line\n" + alignedText(rows);
}

nlohmann::ordered_json attackJson(const std::string &input, const std::vector<AttackedCloud> &clouds) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const AttackedCloud &c : clouds) {
    list.push_back({{"cloud", c.name},
                    {"strategy", c.strategy},
                    {"eta_percent", c.eta_percent},
                    {"lines", c.nearest_errors_m.size()},
                    {"median_cm", medianCm(c)},
                    {"nearest_median_cm", nearestCm(c)},
                    {"within_5cm_percent", 100 * shareUpTo(c.errors_m, kNearM)},
                    {"within_25cm_percent", 100 * shareUpTo(c.errors_m, kRoughlyM)}});
    if (c.has_centre) list.back()["at_centre_percent"] = c.at_centre_percent;
  }
  return {{"input", input}, {"clouds", list}};
}

std::vector<PrivacyRow> attackRows(const std::string &input, const std::vector<AttackedCloud> &clouds) {
  std::vector<PrivacyRow> rows;
  for (const AttackedCloud &c : clouds) {
    const std::string variant = c.name == sphereName(c.eta_percent) ? "sphere cloud" : c.name;
    const auto add = [&](const char *metric, double value) {
      rows.push_back({"density", input, c.strategy, 0.01 * c.eta_percent, variant, metric, value});
    };
    add("median_cm", medianCm(c));
    add("nearest_median_cm", nearestCm(c));
    add("within_5cm_percent", 100 * shareUpTo(c.errors_m, kNearM));
    add("within_25cm_percent", 100 * shareUpTo(c.errors_m, kRoughlyM));
    if (c.has_centre) add("at_centre_percent", c.at_centre_percent);
  }
  return rows;
}

PlotResult drawAttack(const std::string &folder, const std::string &input,
                      const std::vector<AttackedCloud> &clouds) {
  static const char *const kColors[] = {"#dc2626", "#d97706", "#7c3aed", "#0891b2",
                                        "#2563eb", "#16a34a", "#64748b"};
  std::string script = kPlotLook, plots;
  for (size_t i = 0; i < clouds.size(); ++i) {
    const std::string name = "$d" + std::to_string(i);
    script += curve(clouds[i], name);
    plots += (i ? ", " : "plot ") + name + " using 1:2 with lines linewidth 2 linecolor rgb '" +
             kColors[i % std::size(kColors)] + "' title '" + clouds[i].name + "'";
  }
  script += "set title '" + input +
            "' noenhanced textcolor rgb '#334155'\nset logscale x\nset xrange [0.1:1000]\nset yrange [0:100]\n"
            "set xlabel 'error of the recovered point, cm'\nset ylabel 'share of points, %'\nset key top left "
            "noenhanced\n";
  return plot(folder, "density_" + input, script + plots, {760, 420});
}

}  // namespace sphc::host
