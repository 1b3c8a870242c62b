// The one table of figures, as rows that the terminal and the web page both print.
#pragma once
#include <string>
#include <vector>

#include "host/report/statistics.h"

namespace sphc::host {

struct Row {
  std::string name, value, note;
};
std::vector<Row> tableRows(const Run &run, const Summary &summary);

// Columns aligned for a terminal; a line each.
std::string tableText(const std::vector<Row> &rows);

}  // namespace sphc::host
