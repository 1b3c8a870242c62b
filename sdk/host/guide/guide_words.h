// What the guide says, for people and for programs.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "host/guide/walk_summary.h"
#include "host/report/table.h"

namespace sphc::host {

// One line on a terminal.  What was said stays long enough to be read, unless something more urgent comes; what
// comes for a single frame is not said.
class GuideLine {
 public:
  const std::string &hear(const GuideStep &step);

 private:
  std::string text_ = "good";
  int64_t until_ns_ = 0;
  GuideAdvice said_ = 0, before_ = 0;
};

nlohmann::ordered_json stepJson(const GuideStep &step);
nlohmann::ordered_json summaryJson(const WalkSummary &summary);
std::vector<Row> summaryRows(const WalkSummary &summary);
// What to do before leaving; "" where nothing is.
std::string nextSteps(const WalkSummary &summary);

}  // namespace sphc::host
