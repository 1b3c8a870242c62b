#include "lab/match/table.h"

#include <cmath>

#include "host/report/run.h"
#include "lab/pose/table.h"

namespace sphc::host {
namespace {

std::string ratioText(double ratio, const char *without) { return std::isnan(ratio) ? without : fixed(ratio, 1); }

std::string figures(const MatchTable &table, const MatchRow &row) {
  const MatchQuality &q = row.quality;
  return ratioText(row.times_faster_than_ivf, "") + "," + fixed(q.recall1, 4) + "," + fixed(q.ratio_recall, 4) +
         "," + std::to_string(q.accepted) + "," + std::to_string(q.correct) + "," +
         (row.cone_degrees > 0 ? fixed(row.candidates, 1) : "") + "," + fixed(table.bytes_per_point, 2) + "\n";
}

const char kFigureNames[] =
    "times_faster_than_ivf,recall_at_1,ratio_set_recall,accepted,correct,candidates,bytes_per_point\n";

std::string rowStart(const MatchTable &table, const MatchRow &row) {
  return std::to_string(table.points) + "," + std::to_string(table.queries) + "," + csvText(row.name) + ",";
}

}  // namespace

std::string matchTableText(const MatchTable &table) {
  std::vector<std::vector<std::string>> lines = {
      {"matcher", "ms", "x faiss ivf", "recall@1", "ratio set", "accepted", "correct", "candidates"}};
  for (const MatchRow &row : table.rows)
    lines.push_back({row.name, fixed(row.time_ms, 3), ratioText(row.times_faster_than_ivf, "-"),
                     fixed(row.quality.recall1, 3), fixed(row.quality.ratio_recall, 3),
                     std::to_string(row.quality.accepted), std::to_string(row.quality.correct),
                     row.cone_degrees > 0 ? fixed(row.candidates, 0) : "-"});
  return std::to_string(table.queries) + " queries, " + std::to_string(table.points) + " points in " +
         std::to_string(table.cells) + " cells, " + fixed(table.bytes_per_point, 1) +
         " bytes a point, file made in " + fixed(table.build_seconds, 1) + " s\n" + alignedText(lines);
}

std::string matchCsv(const std::vector<MatchTable> &tables) {
  std::string text = std::string("points,queries,matcher,time_ms,") + kFigureNames;
  for (const MatchTable &table : tables)
    for (const MatchRow &row : table.rows)
      text += rowStart(table, row) + fixed(row.time_ms, 4) + "," + figures(table, row);
  return text;
}

std::string matchResults(const std::vector<MatchTable> &tables) {
  std::string text = std::string("points,queries,matcher,") + kFigureNames;
  for (const MatchTable &table : tables)
    for (const MatchRow &row : table.rows) text += rowStart(table, row) + figures(table, row);
  return text;
}

nlohmann::ordered_json matchJson(const std::vector<MatchTable> &tables) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const MatchTable &table : tables) {
    nlohmann::ordered_json value = {{"points", table.points},
                                    {"queries", table.queries},
                                    {"cells", table.cells},
                                    {"bytes_per_point", table.bytes_per_point},
                                    {"build_seconds", table.build_seconds}};
    for (const MatchRow &row : table.rows)
      value["matchers"].push_back({{"matcher", row.name},
                                   {"time_ms", row.time_ms},
                                   {"times_faster_than_ivf", row.times_faster_than_ivf},
                                   {"recall_at_1", row.quality.recall1},
                                   {"ratio_set_recall", row.quality.ratio_recall},
                                   {"accepted", row.quality.accepted},
                                   {"correct", row.quality.correct},
                                   {"candidates", row.candidates}});
    all.push_back(value);
  }
  return all;
}

}  // namespace sphc::host
