#include "host/audit/score/precision.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sphc::host {
namespace {

TEST(PrecisionAtTop, ByHand) {
  const std::vector<double> scores = {0.1, 0.9, 0.8, 0.2, 0.7, 0.3};
  const std::vector<bool> positive = {true, true, false, false, true, false};
  EXPECT_DOUBLE_EQ(precisionAtTop(scores, positive, 0.1), 1);
  EXPECT_DOUBLE_EQ(precisionAtTop(scores, positive, 1.0 / 3), 0.5);
  EXPECT_DOUBLE_EQ(precisionAtTop(scores, positive, 0.5), 2.0 / 3);
  EXPECT_DOUBLE_EQ(precisionAtTop(scores, positive, 1), 0.5);
  EXPECT_THROW(precisionAtTop({}, {}, 0.5), std::invalid_argument);
  EXPECT_THROW(precisionAtTop({1}, {}, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace sphc::host
