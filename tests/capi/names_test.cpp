// Every constant of both headers has a name, which is its own, or is one of those that have none.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include "spherecloud/spherecloud_capture.h"

namespace {

std::string textOf(const char *path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Family {
  const char *prefix;
  std::function<const char *(int64_t)> name;
};

template <typename T>
Family family(const char *prefix, const char *(*name)(T)) {
  return {prefix, [name](int64_t value) { return name(static_cast<T>(value)); }};
}

// One a line, so that more can be added.
// clang-format off
const Family kFamilies[] = {
    family("SPHC_FORMAT_", sphc_format_name),
    family("SPHC_CAMERA_", sphc_camera_model_name),
    family("SPHC_BAND_", sphc_band_name),
    family("SPHC_CONVENTION_", sphc_convention_name),
    family("SPHC_ALIGNED_", sphc_aligned_pixel_name),
    family("SPHC_LOG_", sphc_log_level_name),
    family("SPHC_MODE_", sphc_localizer_mode_name),
    family("SPHC_STATE_", sphc_localizer_state_name),
    family("SPHC_OUTCOME_", sphc_localizer_outcome_name),
    family("SPHC_FAULT_", sphc_localizer_fault_name),
    family("SPHC_CUT_", sphc_localizer_cut_name),
    family("SPHC_HINT_", sphc_localizer_hint_name),
    family("SPHC_EVENT_", sphc_localizer_event_name),
    family("SPHC_PARAMETER_", sphc_localizer_parameter_name),
    family("SPHC_STREAM_", sphc_stream_name),
    family("SPHC_CLOCK_", sphc_clock_id_name),
    family("SPHC_TIME_", sphc_time_point_name),
    family("SPHC_DROP_", sphc_pairer_drop_name),
};
// clang-format on

// Statuses, which have texts, and bits of masks that no function names.
const char *const kWithoutNames[] = {"SPHC_OK",      "SPHC_AGAIN", "SPHC_NOT_LOCALIZED", "SPHC_END",
                                     "SPHC_OUTSIDE", "SPHC_E_",    "SPHC_PRIOR_",        "SPHC_OBSERVATION_"};

// What the enums of the headers hold, by name.  A value that is written in another way than as a decimal number
// fails.
std::map<std::string, int64_t> constants() {
  std::string text = textOf(SPHC_HEADERS "/spherecloud.h") + textOf(SPHC_HEADERS "/spherecloud_capture.h");
  text = std::regex_replace(text, std::regex(R"(/\*[^*]*\*+([^/*][^*]*\*+)*/)"), "");
  std::map<std::string, int64_t> found;
  const std::regex list(R"(\benum\b[^{;]*\{([^}]*)\})"), one(R"(\s*(SPHC_[A-Z0-9_]+)\s*=\s*(-?[0-9]+)u?\s*)");
  for (std::sregex_iterator i(text.begin(), text.end(), list), end; i != end; ++i) {
    std::istringstream members((*i)[1]);
    for (std::string member; std::getline(members, member, ',');) {
      std::smatch parts;
      EXPECT_TRUE(std::regex_match(member, parts, one)) << "'" << member << "' is not read by this test";
      if (!parts.empty()) found[parts[1]] = std::stoll(parts[2]);
    }
  }
  return found;
}

bool beginsWith(const std::string &name, const char *prefix) { return name.rfind(prefix, 0) == 0; }

TEST(Names, EveryConstantIsOfAFamily) {
  const std::map<std::string, int64_t> all = constants();
  EXPECT_GE(all.size(), 100u);
  for (const auto &[name, value] : all) {
    const auto isOf = [&name = name](const char *prefix) { return beginsWith(name, prefix); };
    EXPECT_TRUE(std::any_of(std::begin(kWithoutNames), std::end(kWithoutNames), isOf) ||
                std::any_of(std::begin(kFamilies), std::end(kFamilies),
                            [&isOf](const Family &family) { return isOf(family.prefix); }))
        << name << " has no function that names it; add it to kFamilies";
  }
}

TEST(Names, EveryConstantTellsItsOwn) {
  const std::map<std::string, int64_t> all = constants();
  for (const Family &family : kFamilies) {
    size_t members = 0;
    for (const auto &[name, value] : all)
      if (beginsWith(name, family.prefix)) {
        EXPECT_EQ(family.name(value), name);
        ++members;
      }
    EXPECT_GE(members, 2u) << family.prefix;
    for (int64_t none : {-7, 77, 1 << 30}) EXPECT_EQ(family.name(none), family.prefix + std::string("?"));
  }
}

}  // namespace
