#include "host/audit/score/release_audit.h"

#include <gtest/gtest.h>

#include "tests/support/made_up_model.h"

namespace sphc::host {
namespace {

// The bench as a whole, on a room of its own: what is careless falls, what is released holds.
TEST(ReleaseAudit, TellsDisciplineFromCarelessness) {
  ReleaseAuditInput input;
  input.map = "room";
  input.samples = 1500;
  const PointModel room = test::madeUpRoom(900, 1);
  input.first = room;
  input.more = test::seenAgain(test::joined(room, test::madeUpRoom(90, 2)), 3, {}, 0.002);
  input.other = test::seenAgain(test::joined(test::part(room, 0, 500), test::madeUpRoom(100, 4)), 5, {}, 0.002);
  for (uint64_t k = 0; k < 3; ++k) {
    input.queries.push_back(test::seenAgain(test::part(room, 100 * k, 200), 10 + k));
    input.strangers.push_back(test::madeUpRoom(200, 20 + k));
  }
  const auto rows = auditReleases(input, *gaussianFakes(), 0.5);
  const auto value = [&](const std::string &attack, const std::string &variant, const std::string &metric) {
    for (const PrivacyRow &row : rows)
      if (row.attack == attack && row.variant == variant && row.metric == metric) return row.value;
    ADD_FAILURE() << attack << " " << variant << " " << metric;
    return -1.0;
  };
  EXPECT_GT(value("intersection", "undisciplined rebuilds k=2", "precision"), 0.99);
  EXPECT_NEAR(value("intersection", "released k=3", "precision"), 0.5, 0.01);
  EXPECT_NEAR(value("intersection", "released k=3", "precision_of_new"), 0.5, 0.01);
  EXPECT_EQ(value("triangulation", "undisciplined: same points about another centre", "pose_found"), 1);
  EXPECT_EQ(value("triangulation", "released: 10 % more frames in another world", "pose_found"), 0);
  EXPECT_EQ(value("triangulation", "released: other frames", "pose_found"), 0);
  EXPECT_EQ(value("presence", "object of 40 points", "auc"), 1);
  EXPECT_GT(value("querying client", "queries k=1", "precision"), 0.95);
}

}  // namespace
}  // namespace sphc::host
