#include "lab/frame/table.h"

#include <cmath>

#include "host/report/run.h"
#include "lab/pose/table.h"

namespace sphc::host {
namespace {

std::string number(double value, int digits, const char *missing) {
  return std::isnan(value) ? missing : fixed(value, digits);
}

double bytesAPoint(const FrameTable &table, const FrameMemory &memory) {
  return memory.map_bytes == 0 || table.points == 0
             ? std::nan("")
             : static_cast<double>(memory.map_bytes) / static_cast<double>(table.points);
}

std::string bytesText(size_t bytes, const char *missing) { return bytes == 0 ? missing : std::to_string(bytes); }

std::vector<std::string> textRow(const FrameTable &table, const FrameSummary &s) {
  std::vector<std::string> row = {s.pose.name, fixed(s.pose.time_ms.median, 2), fixed(s.pose.time_ms.p99, 2)};
  for (const Stage stage : kStages) row.push_back(number(s.stage_ms[stage], 2, "-"));
  for (const std::string &cell : {number(s.times_faster, 2, "-"), fixed(s.pose.within_5cm_5deg_percent, 1) + " %",
                                  fixed(s.pose.translation_cm.median, 2), fixed(s.pose.rotation_deg.median, 3),
                                  bytesText(s.memory.state_bytes, "-"), bytesText(s.memory.scratch_bytes, "-"),
                                  number(bytesAPoint(table, s.memory), 1, "-")})
    row.push_back(cell);
  return row;
}

std::string csvStart(const FrameTable &table, const FrameSummary &s) {
  return csvText(table.recording) + "," + std::to_string(table.points) + "," + std::to_string(table.frames) + "," +
         csvText(s.pose.name) + ",";
}

std::string csvEnd(const FrameTable &table, const FrameSummary &s) {
  return number(s.times_faster, 2, "") + "," + fixed(s.pose.found_percent, 1) + "," +
         fixed(s.pose.within_5cm_5deg_percent, 1) + "," + fixed(s.pose.translation_cm.median, 3) + "," +
         fixed(s.pose.rotation_deg.median, 3) + "," + bytesText(s.memory.state_bytes, "") + "," +
         bytesText(s.memory.scratch_bytes, "") + "," + number(bytesAPoint(table, s.memory), 1, "") + "\n";
}

const char kCsvStart[] = "recording,points,frames,variant,";
const char kCsvEnd[] =
    "times_faster_than_peer,found_percent,within_5cm_5deg_percent,translation_cm_median,rotation_deg_median,"
    "state_bytes,scratch_bytes,map_bytes_a_point\n";

std::string csvTimes(const FrameSummary &s) {
  std::string text = fixed(s.pose.time_ms.median, 4) + "," + fixed(s.pose.time_ms.p90, 4) + "," +
                     fixed(s.pose.time_ms.p99, 4) + "," + fixed(s.pose.time_ms.max, 4) + ",";
  for (const Stage stage : kStages) text += number(s.stage_ms[stage], 4, "") + ",";
  return text;
}

nlohmann::ordered_json variantJson(const FrameTable &table, const FrameSummary &s) {
  nlohmann::ordered_json stages;
  for (const Stage stage : kStages) stages[kStageNames[stage]] = s.stage_ms[stage];
  return {
      {"variant", s.pose.name},
      {"frames", s.pose.runs},
      {"time_ms", {{"median", s.pose.time_ms.median}, {"p90", s.pose.time_ms.p90}, {"p99", s.pose.time_ms.p99}}},
      {"stage_ms_median", stages},
      {"times_faster_than_peer", s.times_faster},
      {"found_percent", s.pose.found_percent},
      {"within_5cm_5deg_percent", s.pose.within_5cm_5deg_percent},
      {"translation_cm_median", s.pose.translation_cm.median},
      {"rotation_deg_median", s.pose.rotation_deg.median},
      {"state_bytes", s.memory.state_bytes},
      {"scratch_bytes", s.memory.scratch_bytes},
      {"map_bytes_a_point", bytesAPoint(table, s.memory)}};  // NaN becomes null
}

}  // namespace

std::string frameTableText(const FrameTable &table) {
  std::vector<std::vector<std::string>> rows = {{"variant", "ms", "p99", "features", "align", "match", "pose",
                                                 "x peer", "5 cm 5 deg", "cm", "deg", "state B", "scratch B",
                                                 "map B/point"}};
  for (const FrameSummary &s : table.summaries) rows.push_back(textRow(table, s));
  return table.recording + ", " + table.map + ", " + std::to_string(table.points) + " points, " +
         std::to_string(table.frames) + " frames\n" + alignedText(rows);
}

std::string frameCsv(const std::vector<FrameTable> &tables) {
  std::string text = std::string(kCsvStart) + "time_ms_median,time_ms_p90,time_ms_p99,time_ms_max,";
  for (const Stage stage : kStages) text += std::string(kStageNames[stage]) + "_ms_median,";
  text += kCsvEnd;
  for (const FrameTable &table : tables)
    for (const FrameSummary &s : table.summaries) text += csvStart(table, s) + csvTimes(s) + csvEnd(table, s);
  return text;
}

std::string frameResults(const std::vector<FrameTable> &tables) {
  std::string text = std::string(kCsvStart) + kCsvEnd;
  for (const FrameTable &table : tables)
    for (const FrameSummary &s : table.summaries) text += csvStart(table, s) + csvEnd(table, s);
  return text;
}

nlohmann::ordered_json frameJson(const std::vector<FrameTable> &tables) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const FrameTable &table : tables) {
    nlohmann::ordered_json variants = nlohmann::ordered_json::array();
    for (const FrameSummary &s : table.summaries) variants.push_back(variantJson(table, s));
    list.push_back({{"recording", table.recording},
                    {"map", table.map},
                    {"points", table.points},
                    {"frames", table.frames},
                    {"variants", variants}});
  }
  return list;
}

std::string frameScalingText(const std::vector<FrameTable> &tables) {
  if (tables.size() < 2) return "";
  std::vector<std::vector<std::string>> rows = {{"ms a frame at points"}};
  for (const FrameTable &table : tables) rows[0].push_back(std::to_string(table.points));
  for (size_t i = 0; i < tables[0].summaries.size(); ++i) {
    rows.push_back({tables[0].summaries[i].pose.name});
    for (const FrameTable &table : tables) rows.back().push_back(fixed(table.summaries[i].pose.time_ms.median, 2));
  }
  return alignedText(rows);
}

}  // namespace sphc::host
