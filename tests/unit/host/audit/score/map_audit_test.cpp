#include "host/audit/score/map_audit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/host/audit/made_up_releases.h"

namespace sphc::host {
namespace {

MapAuditInput inputOf(const test::MadeUpRelease &release) {
  MapAuditInput input;
  input.file = release.file;
  input.networks = SPHC_NETWORKS;
  input.place = release.place;
  input.quick = true;
  return input;
}

MapAudit audit(const MapAuditInput &input, const std::map<std::string, double> &limits = defaultAuditLimits()) {
  return auditMap(input, limits, [](const std::string &) {});
}

const AuditFigure &figure(const MapAudit &audit, const std::string &name) {
  const auto found = std::find_if(audit.figures.begin(), audit.figures.end(),
                                  [&](const AuditFigure &candidate) { return candidate.name == name; });
  if (found == audit.figures.end()) throw std::runtime_error("no figure " + name);
  return *found;
}

TEST(MapAudit, TheFileItselfHolds) {
  const MapAudit result = audit(inputOf(test::released(test::madeUpRoom(600, 1), 1, 1.0 / 3)));
  for (const char *name : {"file.stray_bytes", "file.order_sigma", "file.cues_sigma", "density.at_centre"})
    EXPECT_EQ(figure(result, name).verdict(), Verdict::kHolds) << name;
  EXPECT_TRUE(figure(result, "real_or_fake.auc").value);
}

TEST(MapAudit, WithoutTheTruthItSaysWhatItCannotMeasure) {
  MapAuditInput input = inputOf(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3));
  input.place.reset();
  const MapAudit result = audit(input);
  EXPECT_EQ(figure(result, "file.order_sigma").verdict(), Verdict::kHolds);
  for (const char *name : {"file.cues_sigma", "real_or_fake.auc", "inversion.of_papers"})
    EXPECT_EQ(figure(result, name).verdict(), Verdict::kNotMeasured) << name;
  EXPECT_TRUE(result.holds());
}

TEST(MapAudit, ACarelessSecondReleaseIsFound) {
  const PointModel room = test::madeUpRoom(600, 1);
  MapAuditInput input = inputOf(test::released(room, 1, 1.0 / 3));
  input.releases.push_back(test::released(room, 2, 1.0 / 3).file);
  const MapAudit result = audit(input);
  EXPECT_EQ(figure(result, "intersection.gain").verdict(), Verdict::kBroken);
  EXPECT_NEAR(*figure(result, "intersection.gain").value, 2.0 / 3, 0.1);
  EXPECT_FALSE(result.holds());
}

TEST(MapAudit, LimitsAreTheUsers) {
  const MapAuditInput input = inputOf(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3));
  auto limits = defaultAuditLimits();
  limits["real_or_fake.precision_at_eta"] = 0;
  EXPECT_EQ(figure(audit(input, limits), "real_or_fake.precision_at_eta").verdict(), Verdict::kBroken);
  limits["no.such"] = 1;
  EXPECT_THROW(audit(input, limits), std::runtime_error);
}

TEST(MapAudit, AnotherPlacesTruthIsRefused) {
  MapAuditInput input = inputOf(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3));
  input.place = test::released(test::madeUpRoom(500, 2), 1, 1.0 / 3).place;
  EXPECT_THROW(audit(input), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
