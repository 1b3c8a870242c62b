#include "lab/compare/table.h"

#include <cmath>
#include <limits>

#include "host/report/run.h"
#include "lab/pose/table.h"

namespace sphc::host {
namespace {

double timesSlower(const CompareTable &table, const VariantSummary &system) {
  for (const VariantSummary &other : table.systems)
    if (other.name == table.reference) return system.time_ms.median / other.time_ms.median;
  return std::numeric_limits<double>::quiet_NaN();
}

std::string ratio(double value) { return std::isnan(value) ? "" : fixed(value, value < 10 ? 1 : 0); }

}  // namespace

std::string compareText(const CompareTable &table) {
  std::vector<std::vector<std::string>> rows = {{"system", "deg", "cm", "< 3 deg", "< 3 cm", "ms", "x time"}};
  for (const VariantSummary &s : table.systems)
    rows.push_back({s.name, fixed(s.rotation_deg.median, 3), fixed(s.translation_cm.median, 3),
                    fixed(100 - s.beyond_3deg_percent, 1) + " %", fixed(100 - s.beyond_3cm_percent, 1) + " %",
                    fixed(s.time_ms.median, 2), ratio(timesSlower(table, s))});
  return table.input + ", " + depthName(table.depth) + " depth, " + std::to_string(table.queries) +
         " queries; medians; time as a multiple of: " + table.reference + "\n" + alignedText(rows);
}

nlohmann::ordered_json compareJson(const CompareTable &table) {
  nlohmann::ordered_json systems = nlohmann::ordered_json::array();
  for (const VariantSummary &s : table.systems)
    systems.push_back({{"system", s.name},
                       {"rotation_deg_median", s.rotation_deg.median},
                       {"translation_cm_median", s.translation_cm.median},
                       {"within_3deg_percent", 100 - s.beyond_3deg_percent},
                       {"within_3cm_percent", 100 - s.beyond_3cm_percent},
                       {"time_ms_median", s.time_ms.median},
                       {"times_slower_than_reference", timesSlower(table, s)}});
  return {{"input", table.input},
          {"depth", depthName(table.depth)},
          {"queries", table.queries},
          {"reference", table.reference},
          {"systems", systems}};
}

const char kCompareHead[] =
    "input,depth,system,rotation_deg_median,translation_cm_median,within_3deg_percent,within_3cm_percent,"
    "times_slower_than_sphere";

std::string compareKey(const CompareTable &table) { return table.input + "," + depthName(table.depth) + ","; }

std::vector<std::string> compareRows(const CompareTable &table) {
  std::vector<std::string> rows;
  for (const VariantSummary &s : table.systems)
    rows.push_back(compareKey(table) + csvText(s.name) + "," + fixed(s.rotation_deg.median, 3) + "," +
                   fixed(s.translation_cm.median, 3) + "," + fixed(100 - s.beyond_3deg_percent, 1) + "," +
                   fixed(100 - s.beyond_3cm_percent, 1) + "," + ratio(timesSlower(table, s)));
  return rows;
}

}  // namespace sphc::host
