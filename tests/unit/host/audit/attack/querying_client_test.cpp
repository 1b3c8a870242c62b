#include "host/audit/attack/querying_client.h"

#include <gtest/gtest.h>

#include "host/audit/score/release_scores.h"
#include "tests/unit/host/audit/made_up_releases.h"

namespace sphc::host {
namespace {

TEST(QueryingClient, LearnsWhatItSeesAndNothingElse) {
  const PointModel room = test::madeUpRoom(2000, 1);
  const test::MadeUpRelease release = test::released(room, 1, 1.0 / 3);
  QueryingClient client(release.map);
  double before = 0;
  for (size_t k = 0; k < 4; ++k) {
    std::vector<OwnPoint> frame;
    for (const ModelPoint &point : test::seenAgain(test::part(room, 300 * k, 300), k).points)
      frame.push_back({point.position_m - release.place.centre_m, point.descriptor});
    client.query(frame);
    const LearnedScore score = scoreLearned(client.learned(), release.truth);
    EXPECT_GT(score.learned.precision(), 0.97);
    EXPECT_NEAR(score.share_of_real, 0.15 * static_cast<double>(k + 1), 0.03);
    EXPECT_GT(score.share_of_real, before);
    EXPECT_LT(score.median_error_m, 0.01);
    before = score.share_of_real;
  }
}

}  // namespace
}  // namespace sphc::host
