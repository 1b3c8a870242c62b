// What an inspection of cameras found.
#pragma once
#include <string>
#include <vector>

namespace sphc::host {

struct Finding {
  enum class Grade { kFine, kDoubtful, kWrong };
  Grade grade;
  std::string what;  // "clocks"
  std::string text;  // what was seen, and where it is not fine, the cure
};
using Findings = std::vector<Finding>;

}  // namespace sphc::host
