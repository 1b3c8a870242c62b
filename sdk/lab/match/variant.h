// One matcher among those that are measured.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lab/match/case.h"

namespace sphc::host {

// What a matcher says of a query; distances of descriptors, not squared.
struct TopTwo {
  int64_t index = -1;  // -1: nobody
  double best = 0, second = 0;
};

// A map made ready for a matcher.
class MatchSearch {
 public:
  virtual ~MatchSearch() = default;
  virtual double seconds() = 0;              // of one search for all queries: CPU time
  virtual std::vector<TopTwo> answer() = 0;  // not timed
};

struct MatchVariant {
  std::string name;
  double cone_degrees = 0;  // guided: looks in a cone of this half angle; 0: in the whole map
  size_t largest_map = SIZE_MAX;
  std::function<std::unique_ptr<MatchSearch>(const MatchCase &)> prepare;  // empty: absent
  std::string absent;                                                      // then: why, and the cure
};

extern const char kExactName[];
std::vector<MatchVariant> ourMatchVariants();
// cv::BFMatcher and cv::flann, linked in.
std::vector<MatchVariant> openCvMatchPeers();
// faiss and hnswlib; run in `python` (a path or a name in PATH).
std::vector<MatchVariant> pythonMatchPeers(const std::string &python);

// Seconds of this thread on its core.
double cpuSeconds();

}  // namespace sphc::host
