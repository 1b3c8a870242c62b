#include "host/report/table.h"

#include <algorithm>
#include <cmath>

#include "host/base/counted.h"
#include "host/base/terminal_text.h"
#include "host/report/reliability.h"
#include "host/report/truth_words.h"

namespace sphc::host {
namespace {

std::string share(uint32_t count, uint32_t total) { return fixed(percent(count, total), 1) + " %"; }

std::string ofTotal(uint32_t count, uint32_t total) {
  return std::to_string(count) + " of " + std::to_string(total);
}

void addFaults(const Summary &s, std::vector<Row> *rows) {
  for (size_t i = 0; i < s.faults.size(); ++i)
    if (s.faults[i])
      rows->push_back(
          {std::string("FAULT: ") + kFaultWords[i].name, share(s.faults[i], s.frames), kFaultWords[i].cure});
}

void addHints(const Summary &s, std::vector<Row> *rows) {
  for (size_t i = 0; i < s.hints.size(); ++i)
    if (s.hints[i])
      rows->push_back(
          {std::string("no pose, ") + kHintWords[i].name, share(s.hints[i], s.frames), kHintWords[i].cure});
}

void addMaps(const Run &run, const Summary &s, std::vector<Row> *rows) {
  if (run.maps.size() < 2) return;
  const std::vector<size_t> answers = answersByMap(run);
  for (size_t i = 0; i < answers.size(); ++i)
    rows->push_back(
        {"in " + run.maps[i].path, std::to_string(answers[i]), "of " + std::to_string(s.localized) + " localized"});
}

void addErrors(const Run &run, const Summary &s, std::vector<Row> *rows) {
  if (s.with_truth == 0) {
    rows->push_back({"error against the truth", "not known",
                     run.base == "map" ? "give --owner-note, and a recording with poses"
                     : run.has_poses   ? "no pose of the recording can be compared"
                                       : kNoPoses});
    return;
  }
  rows->push_back({"within 5 cm and 5 deg", share(s.good, s.with_truth), ofTotal(s.good, s.with_truth)});
  if (s.wrong)
    rows->push_back(
        {"WRONG POSES GIVEN OUT", std::to_string(s.wrong), "further than 25 cm or 10 deg from the truth"});
  if (std::isnan(s.rotation_deg.median)) return;
  const auto add = [rows](const char *name, const Spread &spread, double scale, const char *unit) {
    rows->push_back({std::string(name) + " error, median", fixed(scale * spread.median, 2) + " " + unit,
                     "90 % within " + fixed(scale * spread.p90, 2) + " " + unit + ", worst accepted " +
                         fixed(scale * spread.worst, 2) + " " + unit});
  };
  add("rotation", s.rotation_deg, 1, "deg");
  add("translation", s.translation_m, 100, "cm");
}

void addCalibration(const Run &run, std::vector<Row> *rows) {
  const std::vector<Graded> graded = gradedFrames(run);
  if (graded.empty()) return;
  rows->push_back({"calibration error of confidence", fixed(calibrationError(equalWidthBins(graded)), 3),
                   "expected over 10 bins of equal width, " + counted(graded.size(), "pose")});
}

std::string stageNote(const Summary &s) {
  std::string note;
  for (size_t i = 0; i < kTotal; ++i) {
    note += std::string(note.empty() ? "" : ", ") + kStageNames[i] + " " + fixed(s.stage_median_ms[i], 1);
  }
  return note;
}

}  // namespace

std::vector<Row> tableRows(const Run &run, const Summary &s) {
  std::vector<Row> rows;
  rows.push_back({"frames", std::to_string(s.frames),
                  run.unreadable.empty() ? "" : std::to_string(run.unreadable.size()) + " more could not be read"});
  rows.push_back({"localized", share(s.localized, s.frames), ofTotal(s.localized, s.frames)});
  addMaps(run, s, &rows);
  if (s.tracking > 0)
    rows.push_back(
        {"tracking", share(s.tracking, s.frames),
         ofTotal(s.tracking, s.frames) + "; " + std::to_string(s.guided) + " by a search where it was expected"});
  if (s.cut > 0)
    rows.push_back(
        {"cut by the deadline", share(s.cut, s.frames), "--frames-json says of each frame what was left out"});
  addFaults(s, &rows);
  addHints(s, &rows);
  if (run.aligned_frames)
    rows.push_back({"TRUTH ALIGNED", counted(run.aligned_frames, "pose"), alignmentWords(run)});
  addErrors(run, s, &rows);
  addCalibration(run, &rows);
  rows.push_back({"time per frame, median", fixed(s.stage_median_ms[kTotal], 1) + " ms", stageNote(s)});
  const double device = static_cast<double>(run.state_bytes + run.scratch_bytes + mapBytes(run));
  rows.push_back({"device memory", humanBytes(device),
                  "state " + humanBytes(static_cast<double>(run.state_bytes)) + ", scratch " +
                      humanBytes(static_cast<double>(run.scratch_bytes)) + ", map " +
                      humanBytes(static_cast<double>(mapBytes(run)))});
  return rows;
}

std::string tableText(const std::vector<Row> &rows) {
  size_t name_width = 0, value_width = 0;
  for (const Row &row : rows) {
    name_width = std::max(name_width, columnsOf(row.name));
    value_width = std::max(value_width, columnsOf(row.value));
  }
  std::string text;
  for (const Row &row : rows) {
    std::string line = "  " + row.name + std::string(name_width - columnsOf(row.name) + 2, ' ') +
                       std::string(value_width - columnsOf(row.value), ' ') + row.value;
    if (!row.note.empty()) line += "   " + row.note;
    text += line + "\n";
  }
  return text;
}

}  // namespace sphc::host
