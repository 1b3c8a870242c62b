#include "host/publish/release.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "host/publish/map_writer.h"
#include "host/publish/recognition.h"
#include "runtime/map/crc32.h"
#include "runtime/map/packed_direction.h"

namespace sphc::host {
namespace {

constexpr double kDefaultEta = 1.0 / 3;
constexpr double kSamePlaceShare = 1.0 / 3;  // of a recording's points that are known makes it one of that place
constexpr size_t kLeastBatch = 64;           // fewer new points have too few others to hide among
constexpr double kNearestM = 0.01;           // a point so near to the centre has no direction worth having

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

void checkModel(const PointModel &model, const ReleaseRequest &request) {
  if (request.eta && !(*request.eta > 0 && *request.eta <= 1))
    throw std::runtime_error("eta is " + std::to_string(*request.eta) + "; it must lie in (0, 1]");
  for (const ModelPoint &point : model.points) {
    if (!isInRange(point.position_m))
      throw std::runtime_error("the model has a point that is nowhere near; are the recording's poses in metres?");
    if (!isInRange(point))
      throw std::runtime_error("the model has a point of which nobody knows where it is, its sigma is " +
                               std::to_string(point.sigma_m) + " m; map the place from more than one spot");
  }
}

std::vector<Recognition> recognizeAll(const std::vector<Place> &places, const PointModel &model) {
  std::vector<Recognition> recognitions;
  for (const Place &place : places) recognitions.push_back(recognize(place, model));
  return recognitions;
}

// The place, among those that know enough of the model's points, that knows most of them; else null.  What a later
// place knows too was published anew, so that it counts for that one alone.
const Recognition *samePlace(const std::vector<Recognition> &recognitions, const PointModel &model) {
  const double least = kSamePlaceShare * static_cast<double>(model.points.size());
  std::vector<bool> is_counted(model.points.size());
  const Recognition *best = nullptr;
  size_t most = 0;
  for (auto r = recognitions.rbegin(); r != recognitions.rend(); ++r) {
    if (r->known == 0 || static_cast<double>(r->known) < least) continue;
    size_t count = 0;
    for (size_t i = 0; i < is_counted.size(); ++i) {
      if (r->identities[i] != Identity::kKnown || is_counted[i]) continue;
      is_counted[i] = true;
      ++count;
    }
    if (best && count <= most) continue;
    best = &*r;
    most = count;
  }
  return best;
}

void refuseForeign(const Recognition *recognition, const PointModel &model) {
  if (!recognition) return;
  const double share = static_cast<double>(recognition->known) / static_cast<double>(model.points.size());
  throw std::runtime_error(
      percent(share) +
      " of the recording's points were released by another ledger (--against). A second, independent map of one "
      "place exposes the points that both have. Update that ledger's map with --ledger, or publish with "
      "--new-place only what it does not have, or say --i-understand");
}

// Directions stay what they are at any scale, so the two maps would be of one place all the same.
void refuseOtherScale(const std::vector<Place> &places, const PointModel &model) {
  for (const Place &place : places) {
    const double least = kSamePlaceShare * static_cast<double>(model.points.size());
    const double scale = scaleToPlace(place, model, least);
    if (scale == 0) continue;
    char why[96];
    std::snprintf(why, sizeof why, "the recording shows place %u of a ledger, but is %.3g times as large as it was",
                  place.number, 1 / scale);
    throw std::runtime_error(
        why + std::string(". A second, independent map of one place exposes the points that both have. Give the "
                          "scale or the unit of depth that the release had (--scale; depth_unit_m of the "
                          "calibration), or say --i-understand"));
  }
}

void refuseChange(const Place &place, sphc_band band, const ReleaseRequest &request) {
  char was[64];
  std::snprintf(was, sizeof was, "place %u was released with eta %.4g", place.number, place.eta);
  const char *cure =
      ". Its published points stay as they are: two maps that hide the same points in two ways expose them. Leave "
      "the option out, or publish with --new-place only what is not released yet, or say --i-understand";
  if (band != place.band)
    throw std::runtime_error(
        "place " + std::to_string(place.number) +
        " was released for another band, and the recording shows the same; give the --band of that "
        "release, or, if that was wrong and no copy of its map left the house, say --i-understand");
  if (request.eta && std::abs(*request.eta - place.eta) > 1e-9) throw std::runtime_error(was + std::string(cure));
  if (request.strategy && request.strategy->name() != place.strategy)
    throw std::runtime_error(was + (" and fakes '" + place.strategy + "', not '" + request.strategy->name() + "'") +
                             cure);
  if (request.strategy && place.fake_option > 0 && request.strategy->option() != place.fake_option) {
    char option[96];
    std::snprintf(option, sizeof option, " and fakes '%s' of %.6g, not of %.6g", place.strategy.c_str(),
                  place.fake_option, request.strategy->option());
    throw std::runtime_error(was + std::string(option) + cure);
  }
}

// As the place was released.
std::unique_ptr<FakeStrategy> usualFakes(const Place &place) {
  FakeOptions options;
  if (place.fake_option > 0) options.sigma2 = options.patch_deg = place.fake_option;
  return makeFakes(place.strategy, options);
}

// A new map of a place that other maps have already.
void refuseLittleNew(size_t fresh, const PointModel &model, const ReleaseSummary &summary) {
  if (fresh >= kLeastBatch || summary.elsewhere == 0) return;
  throw std::runtime_error(
      "--new-place: of " + std::to_string(model.points.size()) + " points " + std::to_string(summary.elsewhere) +
      " are published already, and " + std::to_string(fresh) +
      " are left, too few for a map of their own; leave --new-place out, and the build updates the map that has "
      "them, or record what no map shows, or, if no copy of that map left the house, say --i-understand");
}

// Points that nobody has published, sorting out the others.
std::vector<ModelPoint> freshPoints(const PointModel &model, const Recognition *own,
                                    const std::vector<const Recognition *> &others, ReleaseSummary *summary) {
  std::vector<ModelPoint> fresh;
  for (size_t i = 0; i < model.points.size(); ++i) {
    const Identity here = own ? own->identities[i] : Identity::kNew;
    const bool elsewhere = std::any_of(others.begin(), others.end(),
                                       [i](const Recognition *r) { return r->identities[i] != Identity::kNew; });
    summary->known += here == Identity::kKnown;
    summary->ambiguous += here == Identity::kAmbiguous;
    summary->elsewhere += here == Identity::kNew && elsewhere;
    if (here == Identity::kNew && !elsewhere) fresh.push_back(model.points[i]);
  }
  return fresh;
}

Place newPlace(const std::vector<ModelPoint> &points, sphc_band band, const ReleaseRequest &request) {
  Place place;
  place.band = band;
  place.number = static_cast<uint32_t>(request.own.size() + 1);
  place.eta = request.eta.value_or(kDefaultEta);
  place.strategy = request.strategy ? request.strategy->name() : kDefaultFakes;
  place.fake_option = request.strategy ? request.strategy->option() : usualFakes(place)->option();
  if (!points.empty()) place.centre_m = centreOf(points);
  return place;
}

size_t realOf(size_t points, double eta) { return static_cast<size_t>(eta * static_cast<double>(points)); }

// Gives the points their assignments, once and for all.  How many there are.
size_t publish(std::vector<ModelPoint> points, const ReleaseRequest &request, Place *place) {
  const auto at_centre = [&](const ModelPoint &p) { return (p.position_m - place->centre_m).norm() < kNearestM; };
  points.erase(std::remove_if(points.begin(), points.end(), at_centre), points.end());
  const size_t real = realOf(points.size(), place->eta);
  const uint32_t release = static_cast<uint32_t>(place->releases.size() + 1);
  if (points.size() < kLeastBatch)
    throw std::runtime_error("there are " + std::to_string(points.size()) +
                             " points to publish, too few for a map; record more frames, slower, in better light");
  if (real == 0)
    throw std::runtime_error("of " + std::to_string(points.size()) + " points an eta of " +
                             std::to_string(place->eta) + " leaves not one real; give a larger --eta");
  if (place->points.size() + points.size() > kMapMaxPoints)
    throw std::runtime_error("the place has too many points for one map; make a map of a part of it");
  // The words are part of the key: with others the same key would give another, independent map of the place.
  SecretRandom random(derivedKey(
      request.key, "fates of place " + std::to_string(place->number) + " release " + std::to_string(release)));
  shuffle(&points, &random);
  std::vector<SpherePoint> directions;
  for (const ModelPoint &point : points) directions.push_back(seenFrom(place->centre_m, point));
  const std::unique_ptr<FakeStrategy> usual = request.strategy ? nullptr : usualFakes(*place);
  const FakeStrategy &strategy = request.strategy ? *request.strategy : *usual;
  const std::vector<Assignment> assignments = strategy.assignments(directions, real, &random);
  for (size_t i = 0; i < points.size(); ++i)
    place->points.push_back({points[i], packDirection(assignments[i].shown.direction),
                             assignments[i].shown.descriptor, assignments[i].real, release});
  return points.size();
}

// The name of a release, by what it holds: the first `count` points of its place.
MapId idOf(const Place &place, size_t count, const SecretKey &key) {
  std::vector<uint8_t> content;
  for (size_t i = 0; i < count; ++i) {
    const PlacePoint &point = place.points[i];
    content.insert(content.end(), point.descriptor.bytes, point.descriptor.bytes + kDescriptorBytes);
    for (int coordinate : {point.direction.u, point.direction.v})
      content.insert(content.end(), {static_cast<uint8_t>(coordinate), static_cast<uint8_t>(coordinate >> 8)});
  }
  MapId id;
  const std::vector<uint8_t> name = keyedHash(key, "map id", content, id.size());
  std::copy(name.begin(), name.end(), id.begin());
  return id;
}

// A ledger with a bit that changed would publish what it never published.
void checkIsAsReleased(const Place &place, const SecretKey &key) {
  if (place.releases.empty()) return;
  const Release &last = place.releases.back();
  if (idOf(place, last.points, key) != last.map_id)
    throw std::runtime_error("the ledger is damaged: what it holds of place " + std::to_string(place.number) +
                             " is not what its release " + std::to_string(place.releases.size()) +
                             " showed; take the backup");
}

// None is added when the last release held the same.
NewRelease finish(Place place, const ReleaseRequest &request, const ReleaseSummary &summary) {
  const SphereCloud cloud = publishedCloud(place, request.key);
  const MapId id = idOf(place, place.points.size(), request.key);
  NewRelease made = {std::move(place), encodeMap(cloud, id), summary};
  made.summary.is_same = !made.place.releases.empty() && made.place.releases.back().map_id == id;
  if (!made.summary.is_same)
    made.place.releases.push_back({id, crc32(0, made.file.data(), made.file.size()),
                                   static_cast<uint32_t>(made.place.points.size()), request.time_s});
  return made;
}

std::vector<const Recognition *> allBut(const Recognition *one, const std::vector<Recognition> &own,
                                        const std::vector<Recognition> &foreign) {
  std::vector<const Recognition *> all;
  for (const auto *recognitions : {&own, &foreign})
    for (const Recognition &r : *recognitions)
      if (&r != one) all.push_back(&r);
  return all;
}

void toPlace(const Similarity &place_from_world, std::vector<ModelPoint> *points) {
  for (ModelPoint &point : *points) {
    point.position_m = place_from_world * point.position_m;
    point.sigma_m *= place_from_world.scale;
  }
}

}  // namespace

SphereCloud publishedCloud(const Place &place, const SecretKey &key) {
  SecretRandom random(derivedKey(key, "order of place " + std::to_string(place.number)));
  // Each point draws its rank once, so that those of earlier releases keep their order.
  std::vector<uint64_t> ranks;
  for (size_t i = 0; i < place.points.size(); ++i) ranks.push_back(random.next());
  std::vector<size_t> order(place.points.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return ranks[a] < ranks[b]; });
  SphereCloud cloud;
  cloud.band = place.band;
  for (size_t i : order) {
    const Direction d = unpackDirection(place.points[i].direction);
    cloud.points.push_back({Eigen::Vector3f(d.x, d.y, d.z).cast<double>(), place.points[i].descriptor});
  }
  return cloud;
}

NewRelease makeRelease(const PointModel &all, const ReleaseRequest &request) {
  checkModel(all, request);
  const PointModel model = request.merge ? withoutNearDuplicates(all, kReleaseNearDuplicates) : all;
  ReleaseSummary summary;
  summary.near_duplicates = all.points.size() - model.points.size();
  const bool blind = request.understood;
  const auto own = recognizeAll(blind ? std::vector<Place>() : request.own, model);
  const auto foreign = recognizeAll(blind ? std::vector<Place>() : request.foreign, model);
  if (!request.new_place) refuseForeign(samePlace(foreign, model), model);
  const Recognition *here = request.new_place ? nullptr : samePlace(own, model);
  if (!here && !blind)
    for (const auto *places : {&request.own, &request.foreign}) refuseOtherScale(*places, model);
  std::vector<ModelPoint> fresh = freshPoints(model, here, allBut(here, own, foreign), &summary);
  if (request.new_place) refuseLittleNew(fresh.size(), model, summary);
  Place place;
  if (here) {
    place = request.own[static_cast<size_t>(here - own.data())];
    checkIsAsReleased(place, request.key);
    refuseChange(place, model.band, request);
    summary.is_update = true;
    summary.place_from_world = here->place_from_model.front();
    toPlace(summary.place_from_world, &fresh);
    if (fresh.size() < kLeastBatch || realOf(fresh.size(), place.eta) == 0) summary.held_back = fresh.size();
  } else {
    place = newPlace(fresh, model.band, request);
  }
  if (!summary.held_back && !(here && fresh.empty())) summary.added = publish(std::move(fresh), request, &place);
  return finish(std::move(place), request, summary);
}

}  // namespace sphc::host
