// Releases of made-up rooms, as attackers see them and as the owner knows them.
#pragma once
#include "host/audit/attack/published.h"
#include "host/audit/score/truth.h"
#include "tests/support/made_up_model.h"
#include "tests/support/release_request.h"

namespace sphc::test {

struct MadeUpRelease {
  host::Place place;
  std::vector<uint8_t> file;
  host::Published map;
  std::vector<host::EntryTruth> truth;
};

inline MadeUpRelease released(const host::PointModel &model, uint8_t key, double eta,
                              const std::vector<host::Place> &own = {},
                              const host::FakeStrategy *strategy = nullptr) {
  host::ReleaseRequest request = releaseRequest(own, key);
  request.eta = eta;
  if (strategy) request.strategy = strategy;
  host::NewRelease made = host::makeRelease(model, request);
  MadeUpRelease release = {std::move(made.place), std::move(made.file), {}, {}};
  release.map = host::publishedIn(release.file);
  release.truth = host::truthOf(release.map, release.place);
  return release;
}

}  // namespace sphc::test
