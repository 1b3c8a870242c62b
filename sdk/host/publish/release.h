// The one way from private points to a map, with release discipline: whatever is published of a place over time
// shows no entry that its last map does not show, and tells beside it only which release each entry came with.
// docs/release.md says how and why.  A map that never leaves the house needs no ledger: a request with a key and
// nothing else.
#pragma once
#include <optional>
#include <vector>

#include "host/publish/fakes/strategy.h"
#include "host/publish/place.h"
#include "host/publish/secret_random.h"
#include "host/publish/similarity.h"
#include "host/publish/sphere_cloud.h"

namespace sphc::host {

struct ReleaseRequest {
  std::vector<Place> own;                  // of the ledger that the release goes into
  std::vector<Place> foreign;              // what others released
  SecretKey key = {};                      // the ledger's
  const FakeStrategy *strategy = nullptr;  // null: of a new place the default, of a known one its own
  std::optional<double>
      eta;  // share of points that stay real: of a new place 1/3, of a known one its own and no other
  bool new_place = false;   // not a further release of a known place: a map of what was never published
  bool understood = false;  // publish anew what was published before, which exposes it
  bool merge = true;        // near-duplicates first; false for a model of a wanted size
  int64_t time_s = 0;       // since 1970
};

struct ReleaseSummary {
  bool is_update = false;  // of a place in `own`
  bool is_same = false;    // the last release over again
  Similarity place_from_world;
  size_t near_duplicates = 0;  // of other points of the recording, merged
  // What became of the others.
  size_t known = 0, ambiguous = 0, elsewhere = 0, held_back = 0, added = 0;
};

struct NewRelease {
  Place place;  // to be recorded before the file is handed out
  std::vector<uint8_t> file;
  ReleaseSummary summary;
};

// Throws std::runtime_error, with cause and cure, when the model cannot make a map or the release would expose
// points.
NewRelease makeRelease(const PointModel &model, const ReleaseRequest &request);

// The map of all points of a place, in a secret order.
SphereCloud publishedCloud(const Place &place, const SecretKey &key);

}  // namespace sphc::host
