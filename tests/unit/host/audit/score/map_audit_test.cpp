#include "host/audit/score/map_audit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/audit/attack/real_or_fake.h"
#include "host/audit/score/auc.h"
#include "host/publish/map_writer.h"
#include "tests/support/refusal.h"
#include "tests/unit/host/audit/made_up_releases.h"

namespace sphc::host {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

AuditInput inputOf(const test::MadeUpRelease &release) {
  AuditInput input;
  input.file = release.file;
  input.networks = SPHC_NETWORKS;
  input.place = release.place;
  input.quick = true;
  return input;
}

MapAudit audit(const AuditInput &input, const AuditRules &rules = {}) {
  return auditMap(input, rules, [](uint32_t, uint32_t) {});
}

const AuditFigure &figure(const MapAudit &audit, const std::string &name) {
  const auto found = std::find_if(audit.figures.begin(), audit.figures.end(),
                                  [&](const AuditFigure &candidate) { return candidate.kind.name == name; });
  if (found == audit.figures.end()) throw std::runtime_error("no figure " + name);
  return *found;
}

constexpr const char *kOfTheFile[] = {"file.stray_bytes", "file.order_sigma", "file.cues_sigma",
                                      "density.at_centre"};

// The release with fakes whose directions have an even u, which nothing but carelessness makes.
test::MadeUpRelease withEvenFakes(test::MadeUpRelease release) {
  for (PlacePoint &point : release.place.points)
    if (!point.real) point.direction.u &= static_cast<uint16_t>(~1u);
  release.file = encodeMap(publishedCloud(release.place, {1}), {});
  release.place.releases.clear();
  return release;
}

TEST(MapAudit, TheFileItselfHolds) {
  const test::MadeUpRelease release = test::released(test::madeUpRoom(600, 1), 1, 1.0 / 3);
  const MapAudit result = audit(inputOf(release));
  for (const char *name : kOfTheFile) EXPECT_EQ(figure(result, name).verdict(), Verdict::kHolds) << name;
  double strongest = 0;
  std::vector<bool> real;
  for (const EntryTruth &entry : release.truth) real.push_back(entry.real);
  const std::vector<RealOrFakeGuess> guesses = turnedGuesses(release.map, real, SPHC_NETWORKS);
  for (const RealOrFakeGuess &guess : guesses)
    strongest = std::max(strongest, areaUnderCurve(guess.scores, real).value);
  EXPECT_EQ(figure(result, "real_or_fake.auc").value, strongest);
}

// Where few fakes lie on many real patches, the dense ones are fakes.
TEST(MapAudit, ACueThatPointsTheOtherWayTellsToo) {
  AuditRules rules;
  rules.only = {"real_or_fake"};
  const MapAudit result =
      audit(inputOf(test::released(test::madeUpRoom(1500, 1), 1, 0.8, {}, patchworkFakes().get())), rules);
  const auto density = std::find_if(result.real_or_fake.begin(), result.real_or_fake.end(),
                                    [](const RealOrFakeScores &score) { return score.attacker == "density"; });
  ASSERT_NE(density, result.real_or_fake.end());
  EXPECT_GT(density->auc, 0.6);
}

TEST(MapAudit, TellsHowMuchIsDoneWithinAnAttackToo) {
  const test::MadeUpRelease release = test::released(test::madeUpRoom(300, 1), 1, 1.0 / 3);
  AuditRules rules;
  rules.only = {"inversion"};
  std::vector<uint32_t> told;
  auditMap(inputOf(release), rules, [&](uint32_t done, uint32_t total) {
    EXPECT_EQ(total, 100u);
    told.push_back(done);
  });
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 100u);
  EXPECT_GT(std::set<uint32_t>(told.begin(), told.end()).size(), 8u);
}

// Hardly two directions are equal, but where they are, both are of fakes.
TEST(MapAudit, ARareCueThatIsNeverWrongBreaksTheLimit) {
  test::MadeUpRelease release = test::released(test::madeUpRoom(6000, 1), 1, 1.0 / 3);
  const PackedDirection *free = nullptr;  // of a fake whose direction no other fake has taken yet
  size_t taken = 0;
  for (PlacePoint &point : release.place.points) {
    if (point.real || taken == 200) continue;
    if (!free) {
      free = &point.direction;
    } else {
      point.direction = *free;
      free = nullptr;
      ++taken;
    }
  }
  release.file = encodeMap(publishedCloud(release.place, {1}), {});
  release.place.releases.clear();
  AuditRules rules;
  rules.only = {"file_cues"};
  EXPECT_GT(figure(audit(inputOf(release), rules), "file.cues_sigma").value, 10);
}

// Its error is zero, which no number of sigmas says.
TEST(MapAudit, ACueThatIsNeverWrongIsANumberOfSigmas) {
  test::MadeUpRelease release = withEvenFakes(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3));
  for (PlacePoint &point : release.place.points)
    if (point.real) point.direction.u |= 1;
  release.file = encodeMap(publishedCloud(release.place, {1}), {});
  AuditRules rules;
  rules.only = {"file_cues"};
  const AuditFigure cues = figure(audit(inputOf(release), rules), "file.cues_sigma");
  EXPECT_EQ(cues.verdict(), Verdict::kBroken);
  EXPECT_TRUE(std::isfinite(cues.value.value()));
}

TEST(MapAudit, ACarelessFileDoesNotHold) {
  const test::MadeUpRelease good = test::released(test::madeUpRoom(600, 1), 1, 1.0 / 3);
  const MapAudit even = audit(inputOf(withEvenFakes(good)));
  EXPECT_EQ(figure(even, "file.cues_sigma").verdict(), Verdict::kBroken);
  EXPECT_EQ(even.outcome(), AuditOutcome::kBroken);
  // Bytes of no field: the reader refuses them before the audit counts them.
  for (const bool at_the_end : {true, false}) {
    AuditInput stray = inputOf(good);
    if (at_the_end)
      stray.file.push_back(1);
    else
      stray.file[92] = 7;  // reserved, in the first row of the section table
    EXPECT_THAT(test::refusal([&] { audit(stray); }), HasSubstr("no valid map"));
  }
}

// A dozen views cannot tell a broken limit from one that holds.
TEST(MapAudit, SharesOfFewViewsSayHowLittleTheyTell) {
  AuditRules rules;
  rules.only = {"inversion"};
  AuditInput input = inputOf(test::released(test::madeUpRoom(1500, 1), 1, 1.0 / 3));
  input.quick = true;
  const MapAudit result = audit(input, rules);
  const auto [ratio, own] = std::pair(figure(result, "inversion.of_papers"), figure(result, "inversion.retrieval"));
  const double papers = *figure(result, "inversion.retrieval_paper").value;
  const double views = std::stod(ratio.remark);  // "22 views, ..."
  EXPECT_NEAR(own.standard_error, std::sqrt(*own.value * (1 - *own.value) / views), 1e-9);
  const double papers_error = std::sqrt(papers * (1 - papers) / views);
  EXPECT_NEAR(ratio.standard_error, std::hypot(own.standard_error, *ratio.value * papers_error) / papers, 1e-9);
  EXPECT_GT(ratio.standard_error, 0.1);
}

TEST(MapAudit, WithoutTheTruthItFailsClosed) {
  AuditInput input = inputOf(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3));
  input.place.reset();
  const MapAudit result = audit(input);
  EXPECT_EQ(figure(result, "file.order_sigma").verdict(), Verdict::kHolds);
  EXPECT_EQ(result.outcome(), AuditOutcome::kNotMeasured);
  for (const char *name : {"file.cues_sigma", "real_or_fake.auc", "inversion.of_papers", "triangulation.pose_found",
                           "intersection.gain"}) {
    EXPECT_EQ(figure(result, name).verdict(), Verdict::kNotMeasured) << name;
    EXPECT_THAT(result.missingGates(), Contains(name));
  }
  EXPECT_THAT(result.missingGates(), Not(Contains("querying_client.share_of_real")));  // has no limit
}

TEST(MapAudit, WhatIsAllowedMayStayUnmeasured) {
  AuditInput input = inputOf(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3));
  input.place.reset();
  const auto missing = [&](std::vector<std::string> allowed) {
    AuditRules rules;
    rules.allow_unmeasured = std::move(allowed);
    return audit(input, rules).missingGates();
  };
  EXPECT_THAT(missing({"truth", "releases"}), IsEmpty());
  EXPECT_THAT(missing({"truth"}), testing::ElementsAre("triangulation.pose_found"));
  EXPECT_THAT(missing({"real_or_fake"}), Not(Contains("real_or_fake.auc")));  // an attack
  EXPECT_THAT(missing({"real_or_fake"}), Contains("inversion.of_papers"));
  EXPECT_THAT(missing({"inversion.of_papers"}), Not(Contains("inversion.of_papers")));  // a figure
  AuditRules rules;
  rules.allow_unmeasured = {"truth", "releases"};
  EXPECT_EQ(audit(input, rules).outcome(), AuditOutcome::kHolds);
  EXPECT_THAT(audit(input, rules).allowedGates(), Contains("real_or_fake.auc"));
  rules.allow_unmeasured = {"luck"};
  EXPECT_THAT(test::refusal([&] { audit(input, rules); }), HasSubstr("nothing is named luck"));
}

TEST(MapAudit, WithoutNetworksWhatNeedsThemIsMissing) {
  AuditInput input = inputOf(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3));
  input.networks.clear();
  EXPECT_THAT(audit(input).missingGates(),
              testing::ElementsAre("real_or_fake.auc", "inversion.of_papers", "inversion.of_papers_fine"));
}

TEST(MapAudit, AllowingDoesNotExcuseWhatIsBroken) {
  AuditInput input = inputOf(withEvenFakes(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3)));
  AuditRules rules;
  rules.allow_unmeasured = {"truth", "releases", "file.cues_sigma"};
  EXPECT_EQ(audit(input, rules).outcome(), AuditOutcome::kBroken);
}

// The ledger knows what else was published of the place.
TEST(MapAudit, AReleaseThatTheLedgerListsAndNobodyGivesIsMissed) {
  const PointModel room = test::madeUpRoom(800, 1);
  const test::MadeUpRelease first = test::released(test::part(room, 0, 600), 1, 1.0 / 3);
  const test::MadeUpRelease second = test::released(room, 1, 1.0 / 3, {first.place});
  EXPECT_EQ(figure(audit(inputOf(first)), "intersection.gain").verdict(), Verdict::kDoesNotApply);
  AuditInput input = inputOf(second);
  AuditRules rules;
  rules.allow_unmeasured = {"inversion"};  // so few points show no picture
  EXPECT_THAT(audit(input, rules).missingGates(),
              testing::ElementsAre("triangulation.pose_found", "intersection.gain"));
  input.releases = {first.file};
  const MapAudit whole = audit(input, rules);
  EXPECT_THAT(whole.missingGates(), IsEmpty());
  EXPECT_EQ(figure(whole, "triangulation.pose_found").verdict(), Verdict::kHolds);
  EXPECT_EQ(figure(whole, "intersection.gain").verdict(), Verdict::kHolds);
  // Another map in its place does not make it known.
  input.releases = {test::released(test::madeUpRoom(600, 7), 1, 1.0 / 3).file};
  EXPECT_THAT(audit(input, rules).missingGates(),
              testing::ElementsAre("triangulation.pose_found", "intersection.gain"));
}

// As a map has that the same ledger made of the place anew.
TEST(MapAudit, AReleaseOfAnotherPlaceWithTheSamePointsIsMissed) {
  const PointModel room = test::madeUpRoom(600, 1);
  const test::MadeUpRelease first = test::released(room, 1, 1.0 / 3), second = test::released(room, 2, 1.0 / 3);
  AuditInput input = inputOf(second);
  input.other_releases = first.place.releases;
  AuditRules rules;
  rules.only = {"triangulation", "intersection_gain"};
  EXPECT_EQ(figure(audit(input, rules), "triangulation.pose_found").verdict(), Verdict::kNotMeasured);
  EXPECT_EQ(figure(audit(input, rules), "intersection.gain").verdict(), Verdict::kNotMeasured);
  input.releases = {first.file};
  EXPECT_EQ(figure(audit(input, rules), "intersection.gain").verdict(), Verdict::kBroken);
  EXPECT_THAT(audit(input, rules).missingGates(), Not(Contains("intersection.gain")));
}

TEST(MapAudit, ACarelessSecondReleaseIsFound) {
  const PointModel room = test::madeUpRoom(600, 1);
  AuditInput input = inputOf(test::released(room, 1, 1.0 / 3));
  input.releases.push_back(test::released(room, 2, 1.0 / 3).file);
  const MapAudit result = audit(input);
  EXPECT_EQ(figure(result, "intersection.gain").verdict(), Verdict::kBroken);
  EXPECT_NEAR(*figure(result, "intersection.gain").value, 2.0 / 3, 0.1);
  EXPECT_EQ(result.outcome(), AuditOutcome::kBroken);
}

TEST(MapAudit, LimitsAreTheUsers) {
  const AuditInput input = inputOf(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3));
  AuditRules rules;
  rules.limits["real_or_fake.precision_at_eta"] = 0;
  EXPECT_EQ(figure(audit(input, rules), "real_or_fake.precision_at_eta").verdict(), Verdict::kBroken);
  rules.limits = {{"querying_client.share_of_real", 1}};  // with a limit it is a gate
  EXPECT_THAT(audit(input, rules).missingGates(), Contains("querying_client.share_of_real"));
  rules.limits = {{"no.such", 1}};
  EXPECT_THROW(audit(input, rules), std::runtime_error);
}

TEST(MapAudit, WhatIsLeftOutIsNotMeasured) {
  AuditRules rules;
  rules.only = {"file"};
  const MapAudit result = audit(inputOf(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3)), rules);
  EXPECT_EQ(figure(result, "file.stray_bytes").verdict(), Verdict::kHolds);
  EXPECT_EQ(figure(result, "density.at_centre").verdict(), Verdict::kNotMeasured);
  EXPECT_EQ(result.outcome(), AuditOutcome::kNotMeasured);
  rules.only = {"file.stray_bytes"};  // a figure is no attack
  EXPECT_THAT(test::refusal([&] { checkRules(rules); }), HasSubstr("no attack is named file.stray_bytes"));
}

// What a stranger's photos, the mirror and the layers tell, of a map of patchwork.
TEST(MapAudit, PhotosAndTheMirrorTell) {
  const PointModel room = test::madeUpRoom(1500, 1);
  AuditInput input = inputOf(test::released(room, 1, 1.0 / 3, {}, patchworkFakes().get()));
  for (size_t k = 0; k < 3; ++k)
    input.queries.push_back(test::seenAgain(test::part(room, 300 * k, 300), k + 2).points);
  AuditRules rules;
  rules.only = {"presence", "photos", "turned_client", "photo_spread", "real_or_fake"};
  const MapAudit result = audit(input, rules);
  const auto value = [&](const char *name) { return figure(result, name).value.value(); };
  EXPECT_EQ(value("presence.auc_mirrored_too"), 1);
  EXPECT_GT(value("presence.auc"), 0.9);
  EXPECT_GT(value("photos.share_of_real"), 0.03);
  EXPECT_EQ(figure(result, "photos.share_of_real").remark, "3 photos of the mapping walk");
  EXPECT_EQ(value("photos.precision"), 1);
  EXPECT_GT(value("photos.share_of_fakes"), 0.03);
  EXPECT_EQ(value("photos.precision_mirrored"), 1);
  EXPECT_GT(value("photos.reach"), value("photos.share_of_real"));
  EXPECT_NEAR(value("photos.spread_auc"), 0.5, 0.1);  // descriptors are noise
  EXPECT_GE(value("turned_client.share_of_fakes"), value("photos.share_of_fakes"));
  EXPECT_GT(value("turned_client.undone"), 0.9 * value("turned_client.share_of_fakes"));
  EXPECT_GT(value("real_or_fake.auc_of_layers"), 0);
  EXPECT_GT(value("real_or_fake.first_tenth"), 0.2);
  ASSERT_FALSE(result.real_or_fake.empty());
  EXPECT_EQ(result.real_or_fake.back().attacker, "strongest");
  // The very keypoints of the map are no photo of a stranger's.
  input.photos = {room.points};
  rules.only = {"photos"};
  EXPECT_EQ(figure(audit(input, rules), "photos.share_of_real").value, 0);
}

// A limit of what cannot be measured is no limit that holds.
TEST(MapAudit, ThePapersFakesLieInNoLayers) {
  AuditRules rules;
  rules.only = {"real_or_fake"};
  rules.limits["real_or_fake.auc_of_layers"] = 0.5;
  const MapAudit result = audit(inputOf(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3)), rules);
  EXPECT_THAT(figure(result, "real_or_fake.auc_of_layers").remark, HasSubstr("no stacks"));
  EXPECT_THAT(result.missingGates(), Contains("real_or_fake.auc_of_layers"));
}

TEST(MapAudit, PhotosThatShowTooLittleMeasureNothing) {
  const PointModel room = test::madeUpRoom(300, 1);
  AuditInput input = inputOf(test::released(room, 1, 1.0 / 3));
  input.queries = {room.points};  // the very keypoints that are mapped
  AuditRules rules;
  rules.only = {"presence", "photo_spread"};
  rules.limits = {{"presence.auc", 0.9}, {"presence.auc_mirrored_too", 0.9}, {"photos.spread_auc", 0.9}};
  const MapAudit result = audit(input, rules);
  for (const auto &[name, limit] : rules.limits)
    EXPECT_EQ(figure(result, name).verdict(), Verdict::kNotMeasured) << name;
  EXPECT_THAT(figure(result, "presence.auc").remark, HasSubstr("no photo shows 40 points"));
}

// A 103rd of 103 is a little less than one.
TEST(MapAudit, OneRealPointIsEnoughForThePapersFakes) {
  AuditRules rules;
  rules.only = {"real_or_fake"};
  const AuditInput input = inputOf(test::released(test::madeUpRoom(103, 1), 1, 0.015));
  EXPECT_TRUE(figure(audit(input, rules), "real_or_fake.auc_paper").value);
}

// Nothing is hidden, and there are too few points for a picture: that is no reason to hold.
TEST(MapAudit, AMapOfRealPointsAloneFailsClosed) {
  const AuditInput input = inputOf(test::released(test::madeUpRoom(70, 1), 1, 1));
  const MapAudit result = audit(input);
  EXPECT_THAT(result.missingGates(),
              testing::ElementsAre("real_or_fake.auc", "inversion.of_papers", "inversion.of_papers_fine"));
  EXPECT_THAT(figure(result, "real_or_fake.auc").remark, HasSubstr("every entry is real"));
  for (const char *name : {"inversion.of_papers", "inversion.retrieval", "inversion.retrieval_fine_shuffled"})
    EXPECT_THAT(figure(result, name).remark, HasSubstr("no view shows enough points")) << name;
  EXPECT_EQ(result.outcome(), AuditOutcome::kNotMeasured);
  AuditRules rules;
  rules.allow_unmeasured = {"real_or_fake", "inversion"};
  EXPECT_EQ(audit(input, rules).outcome(), AuditOutcome::kHolds);
}

TEST(MapAudit, AnotherPlacesTruthIsRefused) {
  AuditInput input = inputOf(test::released(test::madeUpRoom(500, 1), 1, 1.0 / 3));
  input.place = test::released(test::madeUpRoom(500, 2), 1, 1.0 / 3).place;
  EXPECT_THROW(audit(input), std::runtime_error);
}

}  // namespace
}  // namespace sphc::host
