#include "lab/pose/growth.h"

#include <cmath>
#include <iterator>

#include "host/report/run.h"
#include "lab/pose/grown_case.h"
#include "lab/pose/table.h"

namespace sphc::host {
namespace {

constexpr size_t kCounts[] = {100, 200, 400, 800, 1500, 2500, 4000};
constexpr double kEtas[] = {0.15, 0.10};
constexpr uint64_t kGrowthSeed = 20240901;

template <typename Make>
GrowthRow measure(const GrowthInput &input, GrowthAxis axis, const std::string &how, double x,
                  const std::vector<PoseVariant> &variants, const BenchOptions &options, Make make) {
  Random random(kGrowthSeed);
  std::vector<PoseCase> cases;
  for (const PoseCase &c : input.cases) cases.push_back(make(c, &random));
  return {input.file, axis,        how,
          x,          input.depth, summarizePoseBench(runPoseBench(cases, variants, options, nullptr))};
}

const char *axisName(GrowthAxis axis) { return axis == GrowthAxis::kCount ? "correspondences" : "eta_percent"; }

std::string rowStart(const GrowthRow &row, const VariantSummary &s) {
  return row.file + "," + depthName(row.depth) + "," + axisName(row.axis) + "," + fixed(row.x, 0) + "," + row.how +
         "," + csvText(s.name) + ",";
}

std::string rowEnd(const VariantSummary &s) {
  const std::string ratio = std::isnan(s.times_faster_than_poselib) ? "" : fixed(s.times_faster_than_poselib, 2);
  return ratio + "," + fixed(s.within_5cm_5deg_percent, 2) + "," + fixed(s.rotation_deg.median, 4) + "," +
         fixed(s.translation_cm.median, 4) + "," + fixed(s.iterations, 0) + "\n";
}

}  // namespace

std::vector<GrowthRow> growCounts(const GrowthInput &input, const std::vector<PoseVariant> &variants,
                                  const BenchOptions &options, const QueryDone &done) {
  std::vector<GrowthRow> rows;
  for (const size_t count : kCounts) {
    rows.push_back(
        measure(input, GrowthAxis::kCount, "chosen or copied", static_cast<double>(count), variants, options,
                [&](const PoseCase &c, Random *random) { return resizedCase(c, count, input.noise, random); }));
    if (done) done(static_cast<uint32_t>(rows.size()), static_cast<uint32_t>(std::size(kCounts)));
  }
  return rows;
}

std::vector<GrowthRow> growEtas(const GrowthInput &input, const std::vector<PoseVariant> &variants,
                                const BenchOptions &options, const QueryDone &done) {
  if (input.cases.empty()) return {};
  const uint32_t eta_percent = input.cases[0].eta_percent;
  std::vector<GrowthRow> rows = {measure(input, GrowthAxis::kEta, "as they are", eta_percent, variants, options,
                                         [](const PoseCase &c, Random *) { return c; })};
  if (eta_percent > 33) return rows;
  for (const double eta : kEtas) {
    if (100 * eta >= eta_percent) continue;
    for (const auto &[how, make] : {std::make_pair("turned", turnedCase), std::make_pair("added", dilutedCase)}) {
      rows.push_back(
          measure(input, GrowthAxis::kEta, how, 100 * eta, variants, options,
                  [eta, make = make](const PoseCase &c, Random *random) { return make(c, eta, random); }));
      if (done) done(static_cast<uint32_t>(rows.size()), 1 + 2 * static_cast<uint32_t>(std::size(kEtas)));
    }
  }
  return rows;
}

std::string growthText(const std::vector<GrowthRow> &rows) {
  std::vector<std::vector<std::string>> lines = {
      {"file, depth", "axis", "", "how", "variant", "ms", "p90", "p99", "x poselib", "5 cm 5 deg", "iterations"}};
  for (const GrowthRow &row : rows) {
    for (const VariantSummary &s : row.summaries) {
      const std::string ratio =
          std::isnan(s.times_faster_than_poselib) ? "-" : fixed(s.times_faster_than_poselib, 2);
      lines.push_back({row.file + ", " + depthName(row.depth), axisName(row.axis), fixed(row.x, 0), row.how, s.name,
                       fixed(s.time_ms.median, 3), fixed(s.time_ms.p90, 3), fixed(s.time_ms.p99, 3), ratio,
                       fixed(s.within_5cm_5deg_percent, 1) + " %", fixed(s.iterations, 0)});
    }
  }
  return alignedText(lines);
}

std::string growthCsv(const std::vector<GrowthRow> &rows) {
  std::string text =
      "file,depth,axis,x,how,variant,time_ms_median,time_ms_p90,time_ms_p99,times_faster_than_poselib,"
      "within_5cm_5deg_percent,rotation_deg_median,translation_cm_median,iterations_median\n";
  for (const GrowthRow &row : rows) {
    for (const VariantSummary &s : row.summaries)
      text += rowStart(row, s) + fixed(s.time_ms.median, 4) + "," + fixed(s.time_ms.p90, 4) + "," +
              fixed(s.time_ms.p99, 4) + "," + rowEnd(s);
  }
  return text;
}

std::string growthResults(const std::vector<GrowthRow> &rows) {
  std::string text =
      "file,depth,axis,x,how,variant,times_faster_than_poselib,within_5cm_5deg_percent,rotation_deg_median,"
      "translation_cm_median,iterations_median\n";
  for (const GrowthRow &row : rows)
    for (const VariantSummary &s : row.summaries) text += rowStart(row, s) + rowEnd(s);
  return text;
}

nlohmann::ordered_json growthJson(const std::vector<GrowthRow> &rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const GrowthRow &row : rows) {
    nlohmann::ordered_json variants = nlohmann::ordered_json::array();
    for (const VariantSummary &s : row.summaries) variants.push_back(summaryJson(s));
    list.push_back({{"file", row.file},
                    {"depth", depthName(row.depth)},
                    {"axis", axisName(row.axis)},
                    {"x", row.x},
                    {"how", row.how},
                    {"variants", variants}});
  }
  return list;
}

}  // namespace sphc::host
