#include "host/audit/score/release_audit.h"

#include <algorithm>
#include <cmath>

#include "host/audit/attack/intersection.h"
#include "host/audit/attack/leaks.h"
#include "host/audit/attack/presence.h"
#include "host/audit/attack/querying_client.h"
#include "host/audit/attack/triangulation.h"
#include "host/audit/score/object.h"
#include "host/audit/score/release_scores.h"
#include "host/publish/release.h"
#include "runtime/base/random.h"
#include "runtime/geometry/rigid.h"

namespace sphc::host {
namespace {

constexpr size_t kRebuilds = 8;
constexpr uint8_t kFirstKey = 1;

// One release, as attackers see it and as the owner knows it.
struct Audited {
  Place place;
  Published map;
  std::vector<EntryTruth> truth;
};

class ReleaseAuditor {
 public:
  ReleaseAuditor(const ReleaseAuditInput &input, const FakeStrategy &strategy, double eta)
      : input_(input), strategy_(strategy), eta_(eta) {}

  std::vector<PrivacyRow> rows();

 private:
  Audited release(const PointModel &model, uint8_t key, const std::vector<Place> &own = {}) const;
  void add(const char *attack, const std::string &variant, const char *metric, double value) {
    rows_.push_back({attack, input_.map, strategy_.name(), eta_, variant, metric, value});
  }
  void intersectRebuilds();
  void intersect(const std::string &variant, const std::vector<Audited> &releases);
  void triangulate(const std::string &variant, const Audited &a, const Audited &b, const Rigid &b_from_a = {});
  void leak(const Audited &last);
  void testPresence(const Audited &last);
  void query(const Audited &last);

  const ReleaseAuditInput &input_;
  const FakeStrategy &strategy_;
  double eta_;
  std::vector<PrivacyRow> rows_;
};

// Another gauge, as another mapping run has.
Rigid otherFromWorld() { return {rotationFromVector({0.4, -1.1, 0.7}), {3, -2, 0.5}}; }

PointModel moved(PointModel model) {
  for (ModelPoint &point : model.points) point.position_m = otherFromWorld() * point.position_m;
  return model;
}

// Without the tenth that lies furthest to one side: the same points, about another centre.
PointModel lopsided(PointModel model) {
  std::vector<ModelPoint> &points = model.points;
  const size_t kept = points.size() - points.size() / 10;
  std::nth_element(points.begin(), points.begin() + static_cast<ptrdiff_t>(kept), points.end(),
                   [](const ModelPoint &a, const ModelPoint &b) { return a.position_m.x() < b.position_m.x(); });
  points.resize(kept);
  return model;
}

Audited ReleaseAuditor::release(const PointModel &model, uint8_t key, const std::vector<Place> &own) const {
  ReleaseRequest request;
  request.own = own;
  request.key = {key};
  request.strategy = &strategy_;
  request.eta = eta_;
  NewRelease made = makeRelease(model, request);
  Audited audited = {std::move(made.place), publishedIn(made.file), {}};
  audited.truth = truthOf(audited.map, audited.place);
  return audited;
}

// One set of points, built again and again under fresh keys.
void ReleaseAuditor::intersectRebuilds() {
  std::vector<Audited> releases;
  for (uint8_t key = kFirstKey; releases.size() < kRebuilds; ++key) {
    releases.push_back(release(input_.first, key));
    const size_t k = releases.size();
    if (k == 2 || k == 3 || k == 5 || k == 8) intersect("undisciplined rebuilds k=" + std::to_string(k), releases);
  }
}

void ReleaseAuditor::intersect(const std::string &variant, const std::vector<Audited> &releases) {
  std::vector<Published> maps;
  std::vector<std::vector<EntryTruth>> truths;
  for (const Audited &release : releases) {
    maps.push_back(release.map);
    truths.push_back(release.truth);
  }
  const auto believed = intersectReleases(maps, {});
  const Exposure last = scoreEntries(believed.back(), truths.back());
  add("intersection", variant, "precision", last.precision());
  add("intersection", variant, "exposed_share",
      static_cast<double>(distinctReal(believed, maps, truths)) / static_cast<double>(maps.back().packed.size()));
  // The other half of the same attack: what only the last release has.
  std::vector<uint32_t> fresh;
  for (uint32_t i = 0; i < truths.back().size(); ++i)
    if (truths.back()[i].release > 1) fresh.push_back(i);
  if (!fresh.empty())
    add("intersection", variant, "precision_of_new", scoreEntries(fresh, truths.back()).precision());
}

// b_from_a: of their worlds.
void ReleaseAuditor::triangulate(const std::string &variant, const Audited &a, const Audited &b,
                                 const Rigid &b_from_a) {
  TriangulationOptions options;
  options.samples = input_.samples;
  const Triangulation attack = triangulateReleases(a.map, b.map, options);
  const double centres_m = (b_from_a * a.place.centre_m - b.place.centre_m).norm();
  add("triangulation", variant, "pose_found", attack.found);
  add("triangulation", variant, "points_share",
      attack.found ? static_cast<double>(attack.points.size()) / static_cast<double>(b.map.packed.size()) : 0);
  if (!attack.found) return;
  const TriangulationScore score = scoreTriangulation(attack, a.truth, b.truth, centres_m);
  add("triangulation", variant, "centres_apart_cm", 100 * centres_m);
  add("triangulation", variant, "both_real_share", score.both_real.precision());
  add("triangulation", variant, "median_error_cm", 100 * score.median_error_m);
}

void ReleaseAuditor::leak(const Audited &last) {
  double worst = 0;
  for (const Cue &cue : fileCues(last.map)) {
    const Auc auc = scoreCue(cue, last.truth);
    add("leaks", cue.name, "auc", auc.value);
    worst = std::max(worst, std::abs(auc.value - 0.5) / auc.standard_error);
  }
  add("leaks", "all cues", "worst_sigma", worst);
  add("leaks", "order within runs", "sigma", orderZ(last.map));
}

void ReleaseAuditor::testPresence(const Audited &last) {
  std::vector<double> plain, mirrored_too;
  std::vector<bool> present;
  Random random(11);
  for (const auto *frames : {&input_.queries, &input_.strangers})
    for (const PointModel &frame : *frames) {
      if (frame.points.size() < kObjectPoints) continue;
      const auto around = random.below(static_cast<uint32_t>(frame.points.size()));
      const std::vector<Descriptor> object = objectIn(frame.points, around);
      plain.push_back(presenceScore(last.map, object));
      mirrored_too.push_back(presenceScoreMirroredToo(last.map, object));
      present.push_back(frames == &input_.queries);
    }
  add("presence", "object of 40 points", "auc", areaUnderCurve(plain, present).value);
  add("presence", "object of 40 points, mirrored too", "auc", areaUnderCurve(mirrored_too, present).value);
}

void ReleaseAuditor::query(const Audited &last) {
  QueryingClient client(last.map);
  for (size_t k = 1; k <= input_.queries.size(); ++k) {
    std::vector<OwnPoint> frame;
    for (const ModelPoint &point : input_.queries[k - 1].points)
      frame.push_back({point.position_m - last.place.centre_m, point.descriptor});
    client.query(frame);
    if (k != 1 && k != 3 && k != 10 && k != 25) continue;
    const LearnedScore score = scoreLearned(client.learned(), last.truth);
    const std::string variant = "queries k=" + std::to_string(k);
    add("querying client", variant, "precision", score.learned.precision());
    add("querying client", variant, "share_of_real", score.share_of_real);
    add("querying client", variant, "median_error_cm", 100 * score.median_error_m);
  }
}

std::vector<PrivacyRow> ReleaseAuditor::rows() {
  intersectRebuilds();
  const Audited first = release(input_.first, kFirstKey);
  const Audited more = release(moved(input_.more), kFirstKey, {first.place});
  const Audited other = release(input_.other, kFirstKey, {more.place});
  intersect("released k=2", {first, more});
  intersect("released k=3", {first, more, other});

  triangulate("undisciplined: same points about another centre", first,
              release(lopsided(input_.first), kFirstKey + 1));
  triangulate("undisciplined: 10 % more frames in another world", first, release(moved(input_.more), kFirstKey + 1),
              otherFromWorld());
  triangulate("undisciplined: other frames", first, release(input_.other, kFirstKey + 1));
  triangulate("released: 10 % more frames in another world", first, more);
  triangulate("released: other frames", first, other);
  leak(other);
  testPresence(other);
  query(other);
  return rows_;
}

}  // namespace

std::vector<PrivacyRow> auditReleases(const ReleaseAuditInput &input, const FakeStrategy &strategy, double eta) {
  return ReleaseAuditor(input, strategy, eta).rows();
}

}  // namespace sphc::host
