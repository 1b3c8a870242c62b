#include "runtime/capi/parameters.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sphc {
namespace {

constexpr sphc_localizer_parameter kAll[] = {SPHC_PARAMETER_MAX_RATIO, SPHC_PARAMETER_PROBES,
                                             SPHC_PARAMETER_MAX_ITERATIONS, SPHC_PARAMETER_MIN_INLIERS};

TEST(Parameters, EachSetsItselfAlone) {
  for (sphc_localizer_parameter set : kAll) {
    SearchParameters parameters;
    const sphc_localizer_parameter_range range = rangeOf(set);
    for (double value : {range.lowest, range.highest}) {
      EXPECT_EQ(setValue(set, value, &parameters, nullptr), SPHC_OK);
      EXPECT_EQ(valueOf(parameters, set), value);
    }
    for (sphc_localizer_parameter other : kAll)
      EXPECT_TRUE(other == set || valueOf(parameters, other) == valueOf(SearchParameters(), other));
  }
}

TEST(Parameters, InitialValuesAreAllowed) {
  for (sphc_localizer_parameter parameter : kAll) {
    EXPECT_EQ(checkParameter(parameter, nullptr), SPHC_OK);
    const sphc_localizer_parameter_range range = rangeOf(parameter);
    SearchParameters parameters;
    EXPECT_EQ(setValue(parameter, range.initial, &parameters, nullptr), SPHC_OK);
    EXPECT_EQ(valueOf(parameters, parameter), range.initial);
  }
}

TEST(Parameters, AValueOutOfRangeChangesNothing) {
  for (sphc_localizer_parameter parameter : kAll) {
    const sphc_localizer_parameter_range range = rangeOf(parameter);
    for (double bad : {range.lowest - 0.01, range.highest + 0.01, std::nan(""), HUGE_VAL, -HUGE_VAL}) {
      SearchParameters parameters;
      EXPECT_EQ(setValue(parameter, bad, &parameters, nullptr), SPHC_E_ARGUMENT) << bad;
      EXPECT_EQ(valueOf(parameters, parameter), range.initial);
    }
  }
}

TEST(Parameters, UnknownOnes) {
  for (sphc_localizer_parameter parameter : {-1, 0, 5}) {
    sphc_message message = {};
    EXPECT_EQ(checkParameter(parameter, &message), SPHC_E_UNSUPPORTED);
    EXPECT_NE(message.text[0], '\0');
  }
}

}  // namespace
}  // namespace sphc
