#include "explained.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "command_runner.h"

namespace sphc::host {

void expectExplained(const nlohmann::json &json) {
  static const std::string page = fileText(SPHC_COMMAND_PAGE);
  static const std::set<std::string> of_names = {"settings"};
  for (const auto &[key, value] : json.items()) {
    if (json.is_object()) {
      EXPECT_THAT(page, testing::HasSubstr("`" + key + "`"));
    }
    if (value.is_structured() && !of_names.count(key)) expectExplained(value);
  }
}

}  // namespace sphc::host
