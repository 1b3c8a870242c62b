#include "lab/pose/table.h"

#include <algorithm>
#include <cmath>

#include "host/report/run.h"

namespace sphc::host {
namespace {

std::string number(double value, int digits) { return std::isnan(value) ? "-" : fixed(value, digits); }

std::string csvNumber(double value, int digits) { return std::isnan(value) ? "" : fixed(value, digits); }

std::string csvTail(const Tail &tail) {
  std::string text;
  for (const double value : {tail.median, tail.p90, tail.p99, tail.max}) text += "," + csvNumber(value, 4);
  return text;
}

std::string tailHead(const std::string &name) {
  return "," + name + "_median," + name + "_p90," + name + "_p99," + name + "_max";
}

nlohmann::ordered_json tailJson(const Tail &tail) {
  return {{"median", tail.median}, {"p90", tail.p90}, {"p99", tail.p99}, {"max", tail.max}};
}

std::string caseText(const BenchTable &table) {
  return table.file + "," + depthName(table.depth) + "," + std::to_string(table.eta_percent);
}

}  // namespace

nlohmann::ordered_json summaryJson(const VariantSummary &s) {
  nlohmann::ordered_json value = {{"variant", s.name},
                                  {"runs", s.runs},
                                  {"found_percent", s.found_percent},
                                  {"time_ms", tailJson(s.time_ms)},
                                  {"times_faster_than_poselib", s.times_faster_than_poselib},
                                  {"rotation_deg", tailJson(s.rotation_deg)},
                                  {"translation_cm", tailJson(s.translation_cm)},
                                  {"beyond_3cm_percent", s.beyond_3cm_percent},
                                  {"beyond_3deg_percent", s.beyond_3deg_percent},
                                  {"within_5cm_5deg_percent", s.within_5cm_5deg_percent},
                                  {"iterations_median", s.iterations},
                                  {"hypotheses_mean", s.hypotheses}};
  return value;  // NaN becomes null
}

std::string csvText(const std::string &text) {
  return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

std::string alignedText(const std::vector<std::vector<std::string>> &rows) {
  std::vector<size_t> widths;
  for (const auto &row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto &row : rows) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - row[i].size(), ' ');
      line += "  " + (i == 0 ? row[i] + space : space + row[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string benchTableText(const BenchTable &table) {
  std::vector<std::vector<std::string>> rows = {{"variant", "ms", "p99", "x poselib", "deg", "p99", "cm", "p90",
                                                 "p99", "max", ">3 cm", ">3 deg", "5 cm 5 deg", "iterations",
                                                 "hypotheses"}};
  for (const VariantSummary &s : table.summaries) {
    rows.push_back(
        {s.name, number(s.time_ms.median, 3), number(s.time_ms.p99, 3), number(s.times_faster_than_poselib, 2),
         number(s.rotation_deg.median, 3), number(s.rotation_deg.p99, 2), number(s.translation_cm.median, 3),
         number(s.translation_cm.p90, 2), number(s.translation_cm.p99, 2), number(s.translation_cm.max, 2),
         number(s.beyond_3cm_percent, 2) + " %", number(s.beyond_3deg_percent, 2) + " %",
         number(s.within_5cm_5deg_percent, 1) + " %", number(s.iterations, 0), number(s.hypotheses, 0)});
  }
  return table.file + ", " + depthName(table.depth) + " depth, eta " + std::to_string(table.eta_percent) + " %, " +
         std::to_string(table.queries) + " queries\n" + alignedText(rows);
}

std::string benchCsv(const std::vector<BenchTable> &tables) {
  std::string text =
      "file,depth,eta_percent,variant,runs,found_percent" + tailHead("time_ms") + ",times_faster_than_poselib" +
      tailHead("rotation_deg") + tailHead("translation_cm") +
      ",beyond_3cm_percent,beyond_3deg_percent,within_5cm_5deg_percent,iterations_median,hypotheses_mean\n";
  for (const BenchTable &table : tables) {
    for (const VariantSummary &s : table.summaries) {
      text += caseText(table) + "," + csvText(s.name) + "," + std::to_string(s.runs) + "," +
              fixed(s.found_percent, 2) + csvTail(s.time_ms) + "," + csvNumber(s.times_faster_than_poselib, 2) +
              csvTail(s.rotation_deg) + csvTail(s.translation_cm) + "," + fixed(s.beyond_3cm_percent, 3) + "," +
              fixed(s.beyond_3deg_percent, 3) + "," + fixed(s.within_5cm_5deg_percent, 2) + "," +
              fixed(s.iterations, 0) + "," + fixed(s.hypotheses, 0) + "\n";
    }
  }
  return text;
}

std::string benchResults(const std::vector<BenchTable> &tables) {
  std::string text =
      "file,depth,eta_percent,variant,times_faster_than_poselib,rotation_deg_median,rotation_deg_p99,"
      "translation_cm_median,translation_cm_p99,beyond_3cm_percent,beyond_3deg_percent,iterations_median,"
      "hypotheses_mean\n";
  for (const BenchTable &table : tables) {
    for (const VariantSummary &s : table.summaries) {
      text += caseText(table) + "," + csvText(s.name) + "," + csvNumber(s.times_faster_than_poselib, 2) + "," +
              fixed(s.rotation_deg.median, 3) + "," + fixed(s.rotation_deg.p99, 2) + "," +
              fixed(s.translation_cm.median, 3) + "," + fixed(s.translation_cm.p99, 2) + "," +
              fixed(s.beyond_3cm_percent, 2) + "," + fixed(s.beyond_3deg_percent, 2) + "," +
              fixed(s.iterations, 0) + "," + fixed(s.hypotheses, 0) + "\n";
    }
  }
  return text;
}

nlohmann::ordered_json benchJson(const std::vector<BenchTable> &tables) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const BenchTable &table : tables) {
    nlohmann::ordered_json variants = nlohmann::ordered_json::array();
    for (const VariantSummary &s : table.summaries) variants.push_back(summaryJson(s));
    list.push_back({{"file", table.file},
                    {"depth", depthName(table.depth)},
                    {"eta_percent", table.eta_percent},
                    {"queries", table.queries},
                    {"variants", variants}});
  }
  return list;
}

}  // namespace sphc::host
