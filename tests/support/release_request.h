// What an owner asks for in tests: the paper's fakes, under a key that is known.
#pragma once
#include <utility>
#include <vector>

#include "host/publish/release.h"

namespace sphc::test {

inline host::ReleaseRequest releaseRequest(std::vector<host::Place> own = {}, uint8_t key = 1) {
  static const auto strategy = host::gaussianFakes();
  host::ReleaseRequest request;
  request.own = std::move(own);
  request.key = {key};
  request.strategy = strategy.get();
  return request;
}

}  // namespace sphc::test
