#include "runtime/localizer/search.h"

#include <algorithm>

#include "runtime/localizer/tuning.h"

namespace sphc {

double coneOf(const Prediction &expected) {
  const double sigma_rad = expected.rotation_sigma_rad + expected.translation_sigma_m / tuning::kTypicalDepthM;
  return std::max(tuning::kLeastConeRad, tuning::kConeSigmas * sigma_rad);
}

double solidAngleOf(double cone_rad) {
  double sine, cosine;
  sinCos(cone_rad, &sine, &cosine);
  return 2 * kPi * (1 - cosine);
}

namespace {

Prediction predictionOf(const Known &known) {
  return {known.map, known.prior.camera_from_map, known.prior.rotation_sigma_rad, known.prior.translation_sigma_m};
}

}  // namespace

bool isNarrow(const Known &known) {
  return known.prior.has_pose && coneOf(predictionOf(known)) < tuning::kMostConeRad;
}

bool expectedPose(const Known &known, const Tracker *tracker, double most_cone_rad, Prediction *expected) {
  if (isNarrow(known)) {
    *expected = predictionOf(known);
    return true;
  }
  return tracker && tracker->predict(expected) && coneOf(*expected) < most_cone_rad;
}

void Search::layout(const LocalizerConfig &config, Arena &state, Arena &scratch, Search *search) {
  Search discarded;  // receives empty spans while measuring
  Search &s = search ? *search : discarded;
  const uint32_t max_keypoints = config.max_keypoints;
  MapSet::layout(config.max_maps, state, &s.maps_);
  s.votes_ = scratch.take<uint32_t>("localizer.votes", config.max_maps);
  s.predicted_ = scratch.take<Direction>("localizer.predicted", max_keypoints);
  s.is_taken_ = scratch.take<uint8_t>("localizer.taken", max_keypoints);
  s.rays_ = scratch.take<Match>("localizer.rays", max_keypoints);
  s.other_rays_ = scratch.take<Match>("localizer.other_rays", max_keypoints);
  Matcher::layout(max_keypoints, scratch, search ? &s.matcher_ : nullptr, config.parallel);
}

void Search::init(const LocalizerConfig &config) {
  setParameters(config.search);
  clock_ = config.clock;
  matcher_.setParallel(config.parallel);
}

void Search::setParameters(const SearchParameters &parameters) {
  max_ratio_ = static_cast<float>(parameters.max_ratio);
  probes_ = parameters.probes;
}

MapOrder Search::rankMaps(const FrontEnd &front, const Deadline &deadline, Work *work) {
  MapOrder order;
  const uint32_t voters = std::min(tuning::kVoters, front.liftedCount());
  uint32_t left = maps_.count(), most = 0;
  for (uint32_t map = 0; map < maps_.slotCount(); ++map) {
    votes_[map] = 0;
    if (!maps_.isTaken(map) || maps_.count() == 1) continue;
    votes_[map] = countVotes(front, map, voters, deadline.afterShare(1.0 / (left-- + 1)), work);
    most = std::max(most, votes_[map]);
  }
  while (!order.full() && order.size() < maps_.count()) {
    uint32_t best = kNoMap;
    for (uint32_t map = 0; map < maps_.slotCount(); ++map) {
      const bool listed = std::find(order.begin(), order.end(), map) != order.end();
      if (maps_.isTaken(map) && !listed && (best == kNoMap || votes_[map] > votes_[best])) best = map;
    }
    if (order.size() > 0 && 2 * votes_[best] < most) break;
    order.push(best);
  }
  return order;
}

// How many of the keypoints find their like in the map?
uint32_t Search::countVotes(const FrontEnd &front, uint32_t map, uint32_t voters, const Deadline &deadline,
                            Work *work) {
  ask(front, map, voters, tuning::kVoteProbes, work);
  return match(voters, max_ratio_, deadline, rays_, work);
}

Search::Question Search::ask(const FrontEnd &front, uint32_t map, uint32_t keypoints, uint32_t probes, Work *work) {
  const int64_t begin = clock_.now();
  matcher_.ask(maps_.view(map), front.descriptors().first(keypoints), probes);
  work->match_ns += elapsedNs(begin, clock_.now());
  return {&front, &maps_.view(map)};
}

uint32_t Search::probesWithin(uint32_t keypoints, const Deadline &deadline, Work *work) const {
  const uint32_t probes = probes_ ? matcher_.probesWithin(keypoints, probes_, deadline) : 0;
  if (probes < probes_) work->cuts |= kCutMatches;
  return probes;
}

uint32_t Search::match(uint32_t keypoints, float max_ratio, const Deadline &deadline, Span<Match> room,
                       Work *work) {
  const int64_t begin = clock_.now();
  const uint32_t count = probes_ ? matcher_.matchAll(keypoints, max_ratio, room, deadline)
                                 : matcher_.matchExact(max_ratio, room, deadline);
  account(begin, work);
  return count;
}

// What the matcher did since.
void Search::account(int64_t begin_ns, Work *work) const {
  work->match_ns += elapsedNs(begin_ns, clock_.now());
  if (matcher_.wasCut()) work->cuts |= kCutMatches;
}

void Search::matchEverywhere(const Question &question, uint32_t keypoints, float max_ratio,
                             const Deadline &deadline, MatchSet *matched, Work *work) {
  const uint32_t count = match(keypoints, max_ratio, deadline, matched->room(), work);
  matched->assign(count, *question.front, *question.map);
}

void Search::matchOthers(const Question &question, uint32_t keypoints, Span<const Match> taken,
                         const Deadline &deadline, MatchSet *matched, Work *work) {
  std::fill_n(is_taken_.begin(), question.front->keypointCount(), uint8_t{0});
  for (const Match &match : taken) is_taken_[match.query] = 1;
  const Span<Match> room = matched->room();
  uint32_t kept = 0;
  const uint32_t count = match(keypoints, max_ratio_, deadline, room, work);
  for (uint32_t i = 0; i < count; ++i)
    if (!is_taken_[room[i].query]) room[kept++] = room[i];
  matched->assign(kept, *question.front, *question.map);
}

void Search::matchNear(const Question &question, const Rigid &camera_from_map, double cone_rad,
                       Span<const Match> rays, const Deadline &deadline, MatchSet *matched, Work *work) {
  const int64_t begin = clock_.now();
  const FrontEnd &front = *question.front;
  const uint32_t lifted = front.liftedCount();
  const Rigid map_from_camera = camera_from_map.inverse();
  for (uint32_t i = 0; i < lifted; ++i) {
    const Vector3 d = (map_from_camera * front.lifted()[i].point_m).normalized();
    predicted_[i] = {static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())};
  }
  double sine, cosine;
  sinCos(cone_rad, &sine, &cosine);
  uint32_t count = matcher_.matchNear(predicted_.first(lifted), static_cast<float>(cosine), max_ratio_,
                                      matched->room(), deadline);
  for (const Match &ray : rays) matched->room()[count++] = ray;
  account(begin, work);
  matched->assign(count, front, *question.map);
}

Span<const Match> Search::raysOf(const FrontEnd &front, const MatchSet &matched, Span<const Match> kept) {
  const Span<Match> room = kept.data() == rays_.data() ? other_rays_ : rays_;
  uint32_t count = 0;
  for (const Match &match : matched.matches())
    if (match.query >= front.liftedCount()) room[count++] = match;
  return room.first(count);
}

}  // namespace sphc
