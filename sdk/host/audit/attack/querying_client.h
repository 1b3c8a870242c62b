// A client with a depth camera: where it was localized, it knows which entries were right, and how far they are.
#pragma once
#include <optional>
#include <vector>

#include "host/audit/attack/published.h"

namespace sphc::host {

// A keypoint of the client's own frame, brought to the map's frame by its own depth and the pose that it was given.
struct OwnPoint {
  Vector3 position_m;  // from the centre
  Descriptor descriptor;
};

class QueryingClient {
 public:
  explicit QueryingClient(const Published &map) : map_(map), learned_(map.directions.size()) {}

  void query(const std::vector<OwnPoint> &frame);
  // Where the client holds each entry to be; none for those it has not seen.
  const std::vector<std::optional<Vector3>> &learned() const { return learned_; }

 private:
  const Published &map_;
  std::vector<std::optional<Vector3>> learned_;
};

}  // namespace sphc::host
