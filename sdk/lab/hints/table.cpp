#include "lab/hints/table.h"

#include <cstdio>

#include "host/report/hint_words.h"

namespace sphc::host {

static_assert(std::tuple_size_v<decltype(kHintWords)> == kHints, "a column a hint");

std::string hintText(const std::vector<HintRow> &rows) {
  std::string text = "condition                        mode      frames  without pose  told";
  for (const BitWords &words : kHintWords) text += std::string("  ") + words.name;
  text += "\n";
  for (const HintRow &row : rows) {
    char line[128];
    std::snprintf(line, sizeof line, "%-32s %-8s %7u %13u %5u", row.condition.c_str(), row.mode.c_str(), row.frames,
                  row.without_pose, row.told);
    text += line;
    for (size_t i = 0; i < kHints; ++i) {
      const auto width = static_cast<int>(2 + std::string(kHintWords[i].name).size());
      std::snprintf(line, sizeof line, "%*u", width, row.hints[i]);
      text += line;
    }
    text += "\n";
  }
  return text;
}

nlohmann::ordered_json hintJson(const std::vector<HintRow> &rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const HintRow &row : rows) {
    json.push_back({{"condition", row.condition},
                    {"mode", row.mode},
                    {"frames", row.frames},
                    {"without_pose", row.without_pose},
                    {"told", row.told}});
    for (size_t i = 0; i < kHints; ++i) json.back()[kHintWords[i].name] = row.hints[i];
  }
  return json;
}

}  // namespace sphc::host
